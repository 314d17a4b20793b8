#include "exporters/preview_html.h"

#include <algorithm>
#include <map>

#include "exporters/markup.h"
#include "exporters/preview_ghost.h"
#include "exporters/preview_pack.h"
#include "exporters/sha256.h"

namespace rhombloom {

namespace {

Expected<std::string> viewer_part(const std::string& name)
{
    return load_file(std::string(RHOMBLOOM_TEMPLATES) + "/" + name, 1'000'000);
}

//! Without indentation and without lines that are only a comment.
std::string lean(const std::string& text)
{
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::size_t first = std::min(text.find_first_not_of(' ', at), end);
        if (first < end && text.compare(first, 2, "//") != 0) {
            result.append(text, first, end - first);
            result.push_back('\n');
        }
        at = end + 1;
    }
    return result;
}

//! "'sha256-...'" of an inline script or style, for the content security policy.
std::string source_hash(const std::string& text)
{
    const std::string hex = sha256(text);
    std::string digest;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        digest.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    }
    return "'sha256-" + base64(digest) + "'";
}

//! The template with every "@NAME@" replaced; what is put in is not looked at again.
std::string filled(const std::string& page, const std::map<std::string, std::string>& values)
{
    std::string result;
    std::size_t at = 0;
    while (at < page.size()) {
        const std::size_t open = page.find('@', at);
        const std::size_t close = open == std::string::npos ? open : page.find('@', open + 1);
        if (close == std::string::npos) {
            break;
        }
        const auto value = values.find(page.substr(open + 1, close - open - 1));
        result.append(page, at, (value == values.end() ? close : open) - at);
        result += value == values.end() ? "" : value->second;
        at = value == values.end() ? close : close + 1;
    }
    return result.append(page, std::min(at, page.size()), std::string::npos);
}

//! The viewer's script, with what shows a target or without.
Expected<std::string> viewer_script(bool with_ghost)
{
    const std::string mark = "// @GHOST@\n";
    Expected<std::string> script = viewer_part("viewer.js");
    const Expected<std::string> ghost = viewer_part("viewer_ghost.js");
    if (!script || !ghost) {
        return script ? ghost : script;
    }
    const std::size_t at = script->find(mark);
    expects(at != std::string::npos, "viewer.js says where the target is shown");
    script->replace(at, mark.size(), with_ghost ? *ghost : "");
    return lean(*script);
}

//! The target in an element of its own; nothing when there is none.
std::string ghost_data(const TriangleMesh& ghost)
{
    return ghost.triangles.empty()
               ? ""
               : "<script id=\"ghost\" type=\"application/octet-stream\">" + packed_ghost(ghost) + "</script>\n";
}

Expected<std::string> assembled(const std::string& title, const std::string& data, const std::string& ghost)
{
    const Expected<std::string> page = viewer_part("viewer.html");
    const Expected<std::string> style = viewer_part("viewer.css");
    const Expected<std::string> script = viewer_script(!ghost.empty());
    const Expected<std::string> start = viewer_part("viewer_start.js");
    for (const auto* part : {&page, &style, &script, &start}) {
        if (!*part) {
            return tl::make_unexpected(part->error());
        }
    }
    const std::string css = lean(*style);
    const std::string& js = *script;
    const std::string first = lean(*start);
    // The viewer is unpacked by the page itself; the policy lets exactly these two scripts run.
    const std::string policy = "default-src 'none'; script-src " + source_hash(first) + " " + source_hash(js) +
                               "; style-src " + source_hash(css) + "; base-uri 'none'; form-action 'none'";
    return filled(*page, {{"POLICY", policy},
                          {"TITLE", markup_escaped(title)},
                          {"STYLE", css},
                          {"START", first},
                          {"VIEWER", packed_text(js)},
                          {"GHOST", ghost},
                          {"DATA", data}});
}

} // namespace

Expected<PreviewPage> preview_page(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                                   const PreviewOptions& options)
{
    PackedPreview packed = packed_preview(model, steps, element, options);
    const std::string title = model.title.empty() ? "rhombloom preview" : model.title;
    const Expected<std::string> html = assembled(title, packed.data, ghost_data(model.ghost));
    if (!html) {
        return tl::make_unexpected(html.error());
    }
    return PreviewPage{*html, packed.max_error_mm};
}

} // namespace rhombloom
