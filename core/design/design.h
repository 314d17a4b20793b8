#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/design/reference.h"
#include "core/design/symmetry.h"

namespace rhombloom {

//! \brief Put a base shape into the scene, as a new part named \p id.
struct Place
{
    std::string id;
    std::string shape;
    Vec3 position = Vec3::Zero();     //!< mm
    Vec3 rotation_deg = Vec3::Zero(); //!< about x, then y, then z
};

//! \brief Join the part \p with to the part \p on where they intersect (Sec. 4.2); the result is called \p on.
struct Merge
{
    std::string on;
    std::string with;
    int candidate = 0;      //!< rank among the candidates that settle near the union of the parts
    bool symmetric = false; //!< join the images of \p with as well
};

//! \brief Sweep a brush from a vertex (Sec. 4.3).
struct Extrude
{
    std::string id; //!< of the new elements' component; empty: numbered
    std::string on;
    Reference apex;
    std::string brush;
    Vec3 by = Vec3::Zero(); //!< mm
    int candidate = 0;      //!< rank of the choice made for the first period
    bool symmetric = false;
};

//! \brief Take elements out: a lamp holder's opening, a cable, a bulb hatch.
struct Open
{
    std::string on;
    std::vector<Reference> elements;
    std::string purpose; //!< "lamp holder", "bulb hatch", ...: free text
    bool symmetric = false;
};

//! \brief Turn one element over.
struct Flip
{
    std::string on;
    Reference element;
    bool symmetric = false;
};

//! \brief One element drawn in the plane (Sec. 4.4).
struct LayoutElement
{
    Eigen::Vector2d at = Eigen::Vector2d::Zero(); //!< its centre, mm
    double rotation_deg = 0;
    Facing facing = Facing::Front;
};

//! \brief Side \p side (0..3) of element \p element hooked to side \p to_side of element \p to, long to short.
//! \details Sides 0 and 2 are long.
struct LayoutJoin
{
    int element = 0;
    int side = 0;
    int to = 0;
    int to_side = 0;
};

//! \brief Elements drawn and joined in the plane become a new part named \p id.
struct Layout
{
    std::string id;
    std::vector<LayoutElement> elements;
    std::vector<LayoutJoin> joins;
    Vec3 position = Vec3::Zero();     //!< of the drawing's origin, mm
    Vec3 rotation_deg = Vec3::Zero(); //!< about x, then y, then z, of the unfolded part
};

//! \brief How far an imported network was from its target when it was made, mm: root mean square and largest.
struct ImportDistance
{
    double to_target_rms = 0; //!< from points spread evenly over the elements
    double to_target_max = 0;
    double from_target_rms = 0; //!< from points spread evenly over the target
    double from_target_max = 0;
};

//! \brief A network of elements made from a mesh (mesh_import.h) becomes a new part named \p id.
//! \details The network is stored, not the recipe: a replay needs neither the target nor the remeshing.
struct Import
{
    std::string id;
    std::string target;          //!< file beside the design with the repaired target in mm; empty: none
    std::string target_sha256;   //!< of that file
    std::optional<ImportDistance> distance;
    std::vector<Vec3> positions; //!< mm
    std::vector<Quad> quads;     //!< counter-clockwise seen from outside; the first side is long
    std::vector<int> flipped;    //!< the elements that are turned over
};

using Operation = std::variant<Place, Merge, Extrude, Open, Flip, Layout, Import>;

//! \brief The document: an element and a history of operations (DESIGN.md section 4). The surface is its replay.
struct Design
{
    static constexpr int version = 1;

    std::string title;
    Element element;
    Symmetry symmetry;
    std::vector<Operation> operations;
};

//! \brief What an operation does, for people: "place ball-30 as body".
std::string describe(const Operation& operation);

} // namespace rhombloom
