#pragma once

#include <string>

#include "exporters/nesting.h"
#include "exporters/outline_reader.h"
#include "exporters/save.h"

namespace rhombloom {

//! \brief Nest an outline of lines and arcs.
//! \details Gaps and margins hold for the true arcs, not for chords; where the reader had to flatten other curves, the
//! spacing and the margin grow by what they may stray.
Expected<Nesting> nest(const ReadOutline& outline, const NestOptions& options);

//! \brief sheet-01.svg and .dxf, ..., and nesting.json with every placement.
FileSet nesting_files(const ReadOutline& outline, const NestOptions& options, const Nesting& nesting);

//! \brief What a person wants to know, e.g. "7 sheets of 600 x 400 mm, 27 on a full one, 188 copies".
std::string summary(const Nesting& nesting, const NestOptions& options);

} // namespace rhombloom
