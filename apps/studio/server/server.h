#pragma once

#include <functional>

#include "apps/studio/server/studio.h"
#include "exporters/save.h"

namespace rhombloom::studio {

struct ServerOptions
{
    int port = 0;  //!< 0: any free one
    FileSet pages; //!< the page's files by name: index.html, studio.js, studio.css
    std::string token;
    //! Told the address with the token once requests are taken.
    std::function<void(const std::string&)> listening;
};

//! \brief Serve the studio on 127.0.0.1 until the program is stopped.
//! \details Every request passes the Guard first; bodies of at most 8 MB, five seconds of silence while a request arrives.
Expected<void> serve(Studio& studio, const ServerOptions& options);

//! \brief The page's files from \p folder; the refusal says how to build them.
Expected<FileSet> load_pages(const std::string& folder);

} // namespace rhombloom::studio
