#pragma once

#include "apps/studio/server/kit_job.h"
#include "apps/studio/server/library.h"
#include "apps/studio/server/previews.h"
#include "apps/studio/server/reply.h"
#include "apps/studio/session/session.h"
#include "apps/studio/session/shelf.h"

namespace rhombloom::studio {

//! \brief Everything the page can ask for, without any network: one document, its previews, its kit.
//! \details Paths under /api/ are answered from JSON bodies; /kit/ID/... and nothing else names a file, and that file
//! is a part of the last kit, held in memory: no path from the page reaches the file system. Never throws; safe to be
//! called from several threads.
class Studio
{
public:
    Studio(std::unique_ptr<Session> session, Shelf shelf, std::string program_version);

    Reply handle(const Request& request);

private:
    Reply answer(const Request& request);
    Reply layouts();
    Reply keep_layouts(const Request& request);

    std::unique_ptr<Session> session_;
    Shelf shelf_;
    std::mutex shelf_mutex_;
    Library library_;
    Previews previews_;
    KitJob kit_;
};

} // namespace rhombloom::studio
