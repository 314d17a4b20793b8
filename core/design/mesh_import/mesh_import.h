#pragma once

#include <functional>
#include <optional>

#include "core/design/design.h"
#include "core/design/mesh_import/mesh_distance.h"
#include "core/form/embedding.h"

namespace rhombloom {

inline constexpr int most_import_elements = 10000;

//! \brief How large the design becomes: at most two of the three; the third follows from the target's area.
//! \details Without height: the target is scaled to fit. Without la: the element's proportions are kept and its size
//! follows. None: 600 elements of the given size.
struct ImportSize
{
    std::optional<int> elements;
    std::optional<double> la;     //!< mm
    std::optional<double> height; //!< of the target along z, mm
};

struct ImportOptions
{
    Element element;
    ImportSize size;
    double mm_per_unit = 1; //!< of the file; counts only when nothing but la is given
    std::string id = "body";
    EmbedOptions embedding;
    //! Told what is being done; false stops. Empty: nobody listens.
    std::function<bool(const std::string&)> progress;
};

//! \brief How well the network follows its target.
struct ImportReport
{
    int elements = 0;
    int elements_asked = 0;
    int flipped = 0;
    Distance distance; //!< mm
    double la = 0;     //!< mm, for distances in la
    EmbedReport embedding;
    DefectRange defects;  //!< radians
    int hard_nodes = 0;   //!< where more than five acute corners meet, or a defect is within 10 degrees of its limit
    bool crosses = false; //!< elements cross each other
    std::vector<std::string> repairs;
    std::vector<std::string> warnings; //!< what the maker should know, with the remedy
    double scale = 1;                  //!< the target in mm is scale * file coordinates + shift
    Vec3 shift = Vec3::Zero();         //!< mm
};

struct ImportedMesh
{
    Import operation; //!< without the target's file name and hash
    Element element;
    TriangleMesh target; //!< repaired, in mm, where the network is
    ImportReport report;
};

//! \brief From a mesh to a network of elements that settles near it (inverse design).
//! \details Route A: an isotropic triangulation of the target whose edges have the length of an element's long
//! diagonal, one element per edge, embedded; then the triangulation is changed where the result is away from the
//! target. Deterministic. Refuses meshes that no closed surface can be made of, with the reason.
Expected<ImportedMesh> import_mesh(const TriangleMesh& mesh, const ImportOptions& options);

} // namespace rhombloom
