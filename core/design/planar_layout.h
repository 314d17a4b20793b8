#pragma once

#include "core/design/design.h"
#include "core/form/embedding.h"

namespace rhombloom {

//! \brief Join elements drawn in the plane by their ports (Sec. 4.4). Element k of the layout becomes face k.
//! \details Positions are the means of the joined corners, z = 0. Refuses, with the numbers, an unknown element or
//! side, a side used twice, long joined to long or short to short, and whatever cannot be built.
Expected<Surface> planar_layout(const Layout& layout, const Element& element);

//! \brief Embed a surface that was drawn flat: it has to find the third dimension by itself.
//! \details Starts from the drawing bulged outwards and from the surface's own low vibration modes, both ways round,
//! and keeps the result of the lowest energy. The drawing's plane and middle are kept where there is a boundary.
EmbedReport unfold(Surface& surface, const Element& element, const EmbedOptions& options = {});

} // namespace rhombloom
