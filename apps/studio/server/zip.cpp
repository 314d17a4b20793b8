#include <memory>

#include <zip.h>

#include "apps/studio/server/kit_job.h"

namespace rhombloom::studio {

namespace {

constexpr zip_int64_t nineteen_eighty = 315532800; // the format's first day: no dates in the kit

tl::unexpected<Error> failed()
{
    return machine_failure("the kit could not be packed: is the memory full?");
}

bool add(zip_t* archive, const std::string& name, const std::string& bytes)
{
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    if (source == nullptr) {
        return false;
    }
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        return false;
    }
    return zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), nineteen_eighty, 0) == 0;
}

Expected<std::string> content(zip_source_t* target)
{
    zip_stat_t stat;
    if (zip_source_stat(target, &stat) != 0 || zip_source_open(target) != 0) {
        return failed();
    }
    std::string bytes(stat.size, '\0');
    const zip_int64_t read = zip_source_read(target, bytes.data(), bytes.size());
    zip_source_close(target);
    return read == static_cast<zip_int64_t>(bytes.size()) ? Expected<std::string>(std::move(bytes)) : failed();
}

} // namespace

Expected<std::string> zip(const FileSet& files, const std::string& folder)
{
    const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> target(
        zip_source_buffer_create(nullptr, 0, 0, nullptr), zip_source_free);
    if (target == nullptr) {
        return failed();
    }
    zip_source_keep(target.get()); // the archive frees its own hold when it is closed
    zip_t* archive = zip_open_from_source(target.get(), ZIP_TRUNCATE, nullptr);
    if (archive == nullptr) {
        zip_source_free(target.get());
        return failed();
    }
    for (const auto& [name, bytes] : files) {
        if (!add(archive, folder + "/" + name, bytes)) {
            zip_discard(archive);
            return failed();
        }
    }
    if (zip_close(archive) != 0) {
        zip_discard(archive);
        return failed();
    }
    return content(target.get());
}

} // namespace rhombloom::studio
