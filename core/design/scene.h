#pragma once

#include <map>

#include "core/design/design.h"
#include "core/form/embedding.h"
#include "core/model/base_shapes.h"

namespace rhombloom {

struct ScenePart
{
    std::string id;
    Surface surface; //!< embedded
    EmbedReport embedding;
};

//! \brief What a history has made so far: parts that are not joined yet, in the order in which they came.
struct Scene
{
    std::vector<ScenePart> parts;
    int next_serial = 0;
    int operations = 0;                       //!< carried out so far
    std::map<std::string, BaseShape> brushes; //!< embedded, by name
};

//! \brief Carry out one operation. The refusal gives the reason, without the JSON path.
Expected<void> carry_out(const Operation& operation, const Design& design, const EmbedOptions& embedding, Scene& scene);

//! \brief All parts as one surface.
Expected<Surface> whole(const Scene& scene);

} // namespace rhombloom
