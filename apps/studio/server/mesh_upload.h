#pragma once

#include "apps/studio/server/reply.h"
#include "apps/studio/session/session.h"

namespace rhombloom::studio {

//! \brief POST /api/import?revision=N&elements=N&name=FILE with the mesh file as the body: the document becomes a
//! design near that mesh, undoable. \details Of the name only the ending counts: it says which format the bytes have.
Reply import_upload(Session& session, const Request& request);

} // namespace rhombloom::studio
