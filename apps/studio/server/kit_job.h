#pragma once

#include <memory>
#include <mutex>
#include <thread>

#include "apps/studio/server/reply.h"
#include "apps/studio/session/session.h"
#include "exporters/kit.h"

namespace rhombloom::studio {

//! \brief Makes the kit of a snapshot in the background and holds the last one in memory.
class KitJob
{
public:
    explicit KitJob(std::string program_version) : version_(std::move(program_version)) {}
    KitJob(const KitJob&) = delete;
    KitJob& operator=(const KitJob&) = delete;
    ~KitJob();

    //! POST /api/fabricate: {"revision", "machine", "material", "paper", "kerf_mm"}. One at a time.
    Reply start(const Session& session, const Request& request);

    //! GET /api/kit: what is being made, or the finished kit's files and figures.
    Reply state() const;

    //! GET /kit/ID/FILE: a file of the finished kit, or kit.zip. Names are looked up among the kit's, nowhere else.
    Reply file(const std::string& path) const;

private:
    struct Wish
    {
        Design design;
        long revision = 0;
        std::string material;
        KitOptions options;
        double kerf = -1;   //!< -1: the default
        std::string folder; //!< of the design file: the targets of imports are there
    };

    Expected<Wish> read(const Session& session, const Request& request) const;
    void work(const Wish& wish);
    Expected<Kit> made(const Wish& wish);
    void tell(const std::string& what);

    std::string version_;
    mutable std::mutex mutex_; //!< of everything below
    bool running_ = false;
    std::string doing_;
    std::string error_;
    long revision_ = 0; //!< that the kit was made from
    std::string id_;    //!< in the kit's addresses; nobody can guess it
    std::shared_ptr<const Kit> kit_;
    std::thread thread_;
};

//! \brief The files in one zip archive, each under \p folder; the same bytes for the same files.
Expected<std::string> zip(const FileSet& files, const std::string& folder);

} // namespace rhombloom::studio
