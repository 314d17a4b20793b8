#pragma once

#include "core/model/surface.h"
#include "exporters/bent_element_patch.h"
#include "exporters/bent_element_sheet.h"

namespace rhombloom {

//! \brief One element of a surface as a bent sheet.
struct BentElement
{
    Outward outward = Outward::Front;
    std::array<int, 4> corners{}; //!< the surface's vertices at the piece's corners v0..v3
    BentPatch patch;              //!< middle surface, hooks apart
    std::vector<Vec3> points;     //!< middle surface at the flat sheet's points, fingers laid over the neighbours, mm
    std::vector<Vec3> normals;    //!< unit, outward
};

struct BendingReport
{
    double max_length_distortion = 0; //!< |bent/flat - 1|, worst segment of the flat sheet away from the hooks
    double p99_length_distortion = 0; //!< of all segments, hooks included
    double max_hook_distortion = 0;   //!< worst segment of the hooks, which climb over the neighbours in a few mm
    double max_rim_distortion = 0;    //!< |bent/flat - 1| of a whole outline
    double max_corner_error_mm = 0;   //!< of a corner to its vertex
    double mean_bow_mm = 0;           //!< height of the long sides' middles over their chords
};

//! \brief Every element of a surface, bent.
struct BentSurface
{
    FlatSheet sheet;
    std::vector<BentElement> elements; //!< by face number
    BendingReport report;
};

//! \brief Bend all elements of \p surface between its vertices: thin sheets with their true outline, long sides bowed
//! outward, each finger outside the neighbour that it holds (hook notes 4.4).
//! \details The corners lie on the vertices. A finger's zone is measured from the node along the shared edge and laid
//! on the neighbour's sheet at the same distances; fingers at open boundaries continue their own sheet.
//! Deterministic; uses two threads. Refuses what element_outline() refuses.
Expected<BentSurface> bent_surface(const Surface& surface, const Element& element);

//! \brief The same for hooks that were changed.
Expected<BentSurface> bent_surface(const Surface& surface, const Element& element, const HookParameters& hooks);

//! \brief Only the elements \p faces; all others are left without patch and points. No report.
Expected<BentSurface> bent_faces(const Surface& surface, const Element& element, const HookParameters& hooks,
                                 const std::vector<int>& faces);

//! \brief The piece's corners v0..v3 as vertices of face \p f, so that v0-v1 is a long side and v0 acute.
std::array<int, 4> piece_corners(const Surface& surface, Face f);

} // namespace rhombloom
