#pragma once

#include "core/form/embedding.h"

namespace rhombloom {

//! \brief surface.json (DESIGN.md section 7): everything another program needs to recompute the embedding.
std::string surface_json(const Surface& surface, const Element& element, const EmbedReport& embedding);

//! \brief Wavefront OBJ: vertices in mm, quads, one group per component.
std::string surface_obj(const Surface& surface);

//! \brief Geomview OFF: vertices in mm, quads.
std::string surface_off(const Surface& surface);

//! \brief Stanford PLY (ascii): vertices in mm, quads with a `back` flag.
std::string surface_ply(const Surface& surface);

//! \brief The writer for a file name's ending (.json, .obj, .off, .ply); the refusal lists them.
Expected<std::string> surface_file(const std::string& path, const Surface& surface, const Element& element,
                                   const EmbedReport& embedding);

} // namespace rhombloom
