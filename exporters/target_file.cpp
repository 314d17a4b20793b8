#include "exporters/target_file.h"

#include <filesystem>

#include "exporters/mesh_reader.h"
#include "exporters/mesh_writer.h"
#include "exporters/save.h"
#include "exporters/sha256.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_bytes = 500'000'000;

Expected<TriangleMesh> load_target(const Import& import, const std::string& place, const std::string& folder)
{
    const std::string remedy =
        "; put the file back, import the mesh anew, or take \"target\" and \"target_sha256\" out";
    const std::filesystem::path name(import.target);
    if (name.has_parent_path() || name.filename() != name) {
        return refuse(place + ": \"" + import.target + "\" is not the name of a file beside the design");
    }
    const auto bytes = load_file((std::filesystem::path(folder) / name).string(), most_bytes);
    if (!bytes) {
        return refuse(place + ": the target " + import.target + " is not beside the design" + remedy);
    }
    if (const std::string found = sha256(*bytes); found != import.target_sha256) {
        return refuse(place + ": the target " + import.target + " was changed since the import: its SHA-256 is " +
                      found.substr(0, 16) + "..., expected " + import.target_sha256.substr(0, 16) + "..." + remedy);
    }
    auto file = read_mesh(import.target, *bytes);
    if (!file) {
        return refuse(place + ": " + file.error().message);
    }
    return std::move(file->mesh);
}

void append(const TriangleMesh& more, TriangleMesh& mesh)
{
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
    for (const Triangle& t : more.triangles) {
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
}

} // namespace

TargetFile target_file(const TriangleMesh& target)
{
    TargetFile result;
    result.bytes = write_ply(target);
    result.sha256 = sha256(result.bytes);
    result.name = "target-" + result.sha256.substr(0, 16) + ".ply";
    return result;
}

Expected<std::optional<TriangleMesh>> load_targets(const Design& design, const std::string& folder)
{
    std::optional<TriangleMesh> result;
    for (std::size_t i = 0; i < design.operations.size(); ++i) {
        const auto* import = std::get_if<Import>(&design.operations[i]);
        if (import == nullptr || import->target.empty()) {
            continue;
        }
        const auto target = load_target(*import, "operations[" + std::to_string(i) + "].target", folder);
        if (!target) {
            return tl::make_unexpected(target.error());
        }
        result = result.value_or(TriangleMesh{});
        append(*target, *result);
    }
    return result;
}

} // namespace rhombloom
