#pragma once

#include <nlohmann/json.hpp>

#include "apps/studio/server/reply.h"
#include "apps/studio/session/session.h"
#include "core/design/json_reader.h"

namespace rhombloom::studio {

Reply json_reply(const nlohmann::ordered_json& value, int status = 200);

//! \brief 422 for what the user can mend, 500 for the machine.
Reply error_reply(const Error& error);

//! \brief {"error": ...} with that status.
Reply error_reply(int status, const std::string& message);

Reply binary_reply(std::string bytes);

//! \brief The document as the page shows it.
nlohmann::ordered_json state_json(const Session& session, const Snapshot& snapshot);

//! \brief The reply to a change: 200 with the new state, 409 with the present one, 422 or 500 with the reason.
Reply outcome_reply(const Session& session, const Outcome& outcome);

//! \brief The body of a request as a JSON object; at most \p max_bytes.
Expected<nlohmann::json> read_body(const Request& request);

} // namespace rhombloom::studio
