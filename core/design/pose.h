#pragma once

#include "core/form/embedding.h"
#include "core/model/surface.h"

namespace rhombloom {

//! \brief Embed \p surface and move it back rigidly so that its vertices stay, on the whole, where \p before had them.
//! \param number for each vertex of \p before its number in \p surface, -1 when it is gone.
//! \details The embedding leaves the rigid motion free; a design needs a pose that does not drift.
EmbedReport embed_in_place(Surface& surface, const Surface& before, const std::vector<int>& number,
                           const Element& element, const EmbedOptions& options);

//! \brief The same, kept where its own vertices are now.
EmbedReport embed_in_place(Surface& surface, const Element& element, const EmbedOptions& options);

//! \brief The mean position of \p vertices, mm.
Vec3 middle(const Surface& surface, const std::vector<Vertex>& vertices);

//! \brief Converged, and no side or diagonal stretched by more than 2 percent.
bool settled(const EmbedReport& report);

} // namespace rhombloom
