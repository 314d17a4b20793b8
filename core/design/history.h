#pragma once

#include "core/design/design.h"
#include "core/form/embedding.h"

namespace rhombloom {

//! \brief The surface after one operation, embedded. Elements keep their serial for as long as they exist.
struct Stage
{
    std::string operation; //!< what was done, for people: "place ball-30 as body"
    Surface surface;
};

struct Replay
{
    Surface surface;           //!< the last stage's, embedded; all parts joined
    EmbedReport embedding;     //!< of that surface
    std::vector<Stage> stages; //!< in the order of the operations
};

struct ReplayOptions
{
    EmbedOptions embedding;
    //! Called before each operation with its number, the count and its text; return false to stop.
    std::function<bool(int, int, const std::string&)> progress;
};

//! \brief Carry out the design's operations in order. Deterministic: the same design gives the same bytes.
//! \details Refuses with the operation's JSON path ("operations[2]") and the reason.
Expected<Replay> replay(const Design& design, const ReplayOptions& options = {});

} // namespace rhombloom
