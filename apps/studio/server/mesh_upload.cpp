#include "apps/studio/server/mesh_upload.h"

#include <charconv>

#include "apps/studio/server/answers.h"
#include "core/design/design_file.h"
#include "core/design/mesh_import/mesh_import.h"
#include "exporters/mesh_reader.h"

namespace rhombloom::studio {

namespace {

Expected<long> number(const Request& request, const std::string& name, long least, long most)
{
    const auto found = request.query.find(name);
    const std::string text = found == request.query.end() ? "" : found->second;
    long value = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size() || value < least || value > most) {
        return refuse(name + " is \"" + text.substr(0, 20) + "\": expected a whole number from " +
                      std::to_string(least) + " to " + std::to_string(most));
    }
    return value;
}

} // namespace

Reply import_upload(Session& session, const Request& request)
{
    const auto revision = number(request, "revision", 0, 2'000'000'000);
    const auto elements = number(request, "elements", 6, 3000);
    const auto name = request.query.find("name");
    if (!revision || !elements || name == request.query.end()) {
        return error_reply(!revision ? revision.error() : !elements ? elements.error() : Error{"name is missing"});
    }
    const auto file = read_mesh(name->second, request.body);
    if (!file) {
        return error_reply(file.error());
    }
    ImportOptions options;
    options.element = session.snapshot()->design.element;
    options.size.elements = static_cast<int>(*elements);
    const auto made = import_mesh(file->mesh, options);
    if (!made) {
        return error_reply(made.error());
    }
    Design design;
    design.title = title_of(name->second.substr(0, name->second.rfind('.')));
    design.element = made->element;
    design.operations = {made->operation};
    return outcome_reply(session, session.replace(*revision, design));
}

} // namespace rhombloom::studio
