#pragma once

#include <functional>

#include "apps/studio/session/scene_cache.h"

namespace rhombloom::studio {

//! \brief The document as every tab sees it at one revision; never changes.
struct Snapshot
{
    long revision = 0; //!< grows with every change: a change names the revision that it was made on
    Design design;
    ScenePointer scene;
    bool can_undo = false;
    bool can_redo = false;
};

using SnapshotPointer = std::shared_ptr<const Snapshot>;

//! \brief What became of a change.
struct Outcome
{
    enum class Status
    {
        Done,
        Stale,   //!< made on an older revision: nothing changed, look at the present one first
        Refused, //!< the change is at fault: nothing changed, \c message says why
        Failed   //!< the machine is: nothing changed
    };
    Status status = Status::Done;
    std::string message;
    int operation = -1;       //!< Refused: the operation that does not fit, -1 when it is none in particular
    SnapshotPointer snapshot; //!< the present document
};

//! \brief One document being edited: open, change, undo, autosave. No GUI type, may be called from several threads.
//! \details Every change is carried out, then saved whole (temporary file, fsync, rename), and only then seen: a
//! killed program leaves the last change that was reported done, or the one under way. Undo has no limit and covers
//! every change, also of the symmetry or an earlier operation; after opening it takes back the operations one by one.
//! What another program writes into the file is never overwritten unseen: the next change is Stale and shows it.
class Session
{
public:
    using Change = std::function<Expected<Design>(const Design&)>;

    //! Open the design file at \p path; a file that does not exist becomes an empty document, written with the first
    //! change. Refuses a malformed design and one whose operations cannot be carried out.
    static Expected<std::unique_ptr<Session>> open(const std::string& path);

    const std::string& path() const { return path_; }
    SnapshotPointer snapshot() const;

    Outcome change(long revision, const Change& change);
    Outcome apply(long revision, const Operation& operation);
    Outcome edit(long revision, int index, const Operation& operation);
    Outcome remove(long revision, int index);
    Outcome undo(long revision);
    Outcome redo(long revision);

    //! Replace the whole document (new, open), undoable like any change.
    Outcome replace(long revision, const Design& design);

private:
    using DesignPointer = std::shared_ptr<const Design>;

    Session(std::string path, const Design& design);
    Outcome show(std::vector<DesignPointer> past, std::size_t cursor);
    void publish(std::vector<DesignPointer> past, std::size_t cursor, ScenePointer scene);
    std::vector<DesignPointer> followed_by(Design design) const;
    std::optional<Outcome> take_foreign();
    std::optional<Outcome> obstacle(long revision);
    Outcome refused(const std::string& message, int operation = -1) const;

    std::string path_;
    SceneCache cache_;
    mutable std::mutex mutex_; //!< of the snapshot pointer
    std::mutex changing_;      //!< one change at a time
    SnapshotPointer snapshot_;
    std::vector<DesignPointer> past_;    //!< all versions, oldest first
    std::size_t cursor_ = 0;             //!< the present one
    std::optional<std::string> written_; //!< the file as last read or written; nothing while there is none
};

//! \brief Read a document: a design, or one without operations as yet.
Expected<Design> parse_document(const std::string& text);

} // namespace rhombloom::studio
