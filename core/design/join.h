#pragma once

#include "core/design/correspondence.h"

namespace rhombloom {

//! \brief A change of a surface, ready to be applied: some elements go, some are added, loop vertices move.
//! \details New vertices are numbered from the surface's n_vertices on. Because it is data, the same change can be
//! carried over to the mirrored or rotated image of the place where it was found (symmetry.h).
struct Graft
{
    std::vector<int> removed;                    //!< elements
    std::vector<std::pair<int, Quad>> rewritten; //!< elements that get other corners (an opened apex)
    std::vector<std::pair<int, int>> zipped;     //!< vertices made one
    std::vector<std::pair<int, Vec3>> moved;     //!< new positions of old vertices, mm
    std::vector<Vec3> positions;                 //!< of the new vertices, mm
    std::vector<Quad> quads;                     //!< the added elements
    std::vector<char> acute_first;               //!< of each: is its first corner acute?
    std::vector<int> serials;                    //!< of each; -1: give it a fresh one
    std::vector<int> components;                 //!< of each: index into \c component_names
    std::vector<std::string> component_names;    //!< of the added elements
    std::vector<int> tips;                       //!< vertices to keep track of
};

//! \brief A surface and how it was cut.
struct CutPart
{
    const Surface& surface;
    const Cut& cut;
};

//! \brief One loop of the fixed part and the loop of the moving part that it is glued to.
struct Seam
{
    int fixed = 0; //!< index into Cut::loops
    int moving = 0;
    Correspondence match;
};

//! \brief Glue what is left of \p moving, moved by \p pose, to what is left of \p fixed (Sec. 4.1).
//! \param tips vertices of the moving part to keep track of.
//! \pre each loop is in exactly one seam and matched loops have the same size.
Graft graft(const CutPart& fixed, const CutPart& moving, const std::vector<Seam>& seams, const Eigen::Isometry3d& pose,
            const std::vector<Vertex>& tips = {});

struct Grafted
{
    Surface surface;
    std::vector<std::vector<Vertex>> tips; //!< one list per graft: its tips' numbers now
    std::vector<int> number;               //!< of each old vertex now, -1 when it is gone
};

//! \brief Apply changes that do not touch the same elements. The tags adapt: corner angles are kept, sides and facings
//! follow from them and from the sides of \p surface.
//! \details Refuses when the result could not be built: an odd ring, an edge with more than two elements, two fans.
//! Fresh serials start at \p next_serial, which is advanced.
Expected<Grafted> apply_grafts(const Surface& surface, const std::vector<Graft>& grafts, int& next_serial);

//! \brief Would every edge that \p change touches have at most two elements, and every element four corners?
//! \details What a single seam between two parts leaves to be seen of apply_grafts; costs what the change costs.
bool edges_fit(const Surface& surface, const Graft& change);

//! \brief Is corner \p k (0..3) of element \p f the acute kind, whatever the tags are called?
bool is_acute(const Surface& surface, Face f, int k);

//! \brief Sides and facings for \p quads whose first corners are acute or not as given; \p first is the side of the
//! lowest-numbered vertex. Refuses a ring of odd length.
Expected<void> retag(SurfaceLists& lists, const std::vector<char>& acute_first, Side first);

} // namespace rhombloom
