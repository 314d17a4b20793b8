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

//! \brief A document being edited: the operations done so far and those undone, which can be done again.
//! \details The cursor stands between operations; what lies before it is the document. Adding an operation drops
//! what was undone.
class History
{
public:
    explicit History(Design design);

    //! The document: the operations before the cursor.
    Design design() const;
    int cursor() const { return cursor_; }
    int size() const { return static_cast<int>(all_.operations.size()); }

    bool can_undo() const { return cursor_ > 0; }
    bool can_redo() const { return cursor_ < size(); }
    void undo();
    void redo();
    void add(Operation operation);

    //! \brief Change an earlier operation and replay the rest.
    //! \details When a later one no longer fits, nothing changes and the refusal names the first that does not.
    Expected<Replay> edit(int index, Operation operation, const ReplayOptions& options = {});

private:
    Design all_;
    int cursor_ = 0;
};

//! \brief Carry out the design's operations in order. Deterministic: the same design gives the same bytes.
//! \details Refuses with the operation's JSON path ("$.operations[2]") and the reason, and when parts are left
//! that no merge has joined.
Expected<Replay> replay(const Design& design, const ReplayOptions& options = {});

} // namespace rhombloom
