#pragma once

#include "core/design/mesh_import/triangle_mesh.h"
#include "exporters/thumbnail.h"

namespace rhombloom {

//! \brief Is the design recognised? The target in grey at the left and the elements at the right, seen by the same
//! camera, as PNG of twice the width in \p options; its camera and tint do not count.
Expected<std::string> comparison_png(const BentSurface& bent, const TriangleMesh& target,
                                     const PictureOptions& options = {});

//! \brief The same for elements that are not bent yet.
Expected<std::string> comparison_png(const Surface& surface, const Element& element, const TriangleMesh& target,
                                     const PictureOptions& options = {});

} // namespace rhombloom
