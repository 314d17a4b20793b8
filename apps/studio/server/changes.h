#pragma once

#include "apps/studio/server/reply.h"
#include "apps/studio/session/session.h"

namespace rhombloom::studio {

//! \brief Requests that change the document: /api/apply, edit, remove, undo, redo, move, delete, document, replace.
//! \details Each body names the `revision` it was made on.
Reply change_document(Session& session, const Request& request);

//! \brief Is \p path one of them?
bool changes_document(const std::string& path);

} // namespace rhombloom::studio
