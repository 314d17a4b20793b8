#include <memory>

#include <libdeflate.h>

#include "core/expected.h"
#include "core/form/parallel.h"
#include "exporters/pdf_objects.h"

namespace rhombloom {

namespace {

constexpr int level = 12; // the tightest

std::string packed(const std::string& text)
{
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    expects(compressor != nullptr, "deflated: memory");
    std::string bytes(libdeflate_zlib_compress_bound(compressor.get(), text.size()), '\0');
    bytes.resize(libdeflate_zlib_compress(compressor.get(), text.data(), text.size(), bytes.data(), bytes.size()));
    return bytes;
}

} // namespace

std::vector<std::string> deflated(const std::vector<std::string>& texts)
{
    std::vector<std::string> result(texts.size());
    parallel_tasks(default_threads(), static_cast<int>(texts.size()), [&](int i) { result[i] = packed(texts[i]); });
    return result;
}

} // namespace rhombloom
