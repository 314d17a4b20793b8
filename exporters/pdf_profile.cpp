#include <array>
#include <cmath>
#include <cstdint>

#include "exporters/pdf_finish.h"

// An ICC profile by the published layout (ICC.1:2001-04): a header of 128 bytes, a table of tags, the tags' data.

namespace rhombloom {

namespace {

std::string u16(unsigned value)
{
    return {static_cast<char>(value >> 8 & 0xFFU), static_cast<char>(value & 0xFFU)};
}

std::string u32(std::uint32_t value)
{
    return u16(value >> 16) + u16(value & 0xFFFFU);
}

std::string fixed(double value)
{
    return u32(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536))));
}

std::string xyz(double x, double y, double z)
{
    return "XYZ " + u32(0) + fixed(x) + fixed(y) + fixed(z);
}

//! The sRGB transfer function (IEC 61966-2-1) at 1024 points.
std::string tone_curve()
{
    constexpr int points = 1024;
    std::string data = "curv" + u32(0) + u32(points);
    for (int i = 0; i < points; ++i) {
        const double v = i / (points - 1.0);
        const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        data += u16(static_cast<unsigned>(std::lround(linear * 65535)));
    }
    return data;
}

std::string description(const std::string& text)
{
    const auto length = static_cast<std::uint32_t>(text.size() + 1);
    return "desc" + u32(0) + u32(length) + text + std::string(1 + 4 + 4 + 2 + 1 + 67, '\0');
}

std::string padded(std::string data)
{
    data.resize((data.size() + 3) / 4 * 4, '\0');
    return data;
}

std::string header(std::uint32_t size)
{
    std::string h = u32(size) + std::string(4, '\0') + u32(0x02100000) + "mntrRGB XYZ ";
    h += u16(2000) + u16(1) + u16(1) + u16(0) + u16(0) + u16(0) + "acsp" + std::string(4 * 4, '\0') + u32(0);
    h += std::string(8, '\0') + u32(0) + fixed(0.9642) + fixed(1) + fixed(0.8249);
    h.resize(128, '\0');
    return h;
}

} // namespace

std::string srgb_profile()
{
    const std::string curve = padded(tone_curve());
    // Primaries adapted to D50, as the standard's own profile states them.
    const std::array<std::pair<std::string, std::string>, 9> tags = {{
        {"desc", padded(description("sRGB"))},
        {"cprt", padded("text" + u32(0) + "No copyright, use freely" + std::string(1, '\0'))},
        {"wtpt", xyz(0.9505, 1, 1.0891)},
        {"rXYZ", xyz(0.43607, 0.22249, 0.01392)},
        {"gXYZ", xyz(0.38515, 0.71687, 0.09708)},
        {"bXYZ", xyz(0.14307, 0.06061, 0.71410)},
        {"rTRC", curve},
        {"gTRC", ""},
        {"bTRC", ""},
    }};
    std::string table = u32(tags.size());
    std::string data;
    const auto start = static_cast<std::uint32_t>(128 + 4 + 12 * tags.size());
    std::uint32_t curve_at = 0;
    for (const auto& [signature, bytes] : tags) {
        const auto here = static_cast<std::uint32_t>(start + data.size());
        curve_at = signature == "rTRC" ? here : curve_at;
        table += signature + u32(bytes.empty() ? curve_at : here);
        table += u32(static_cast<std::uint32_t>(bytes.empty() ? curve.size() : bytes.size()));
        data += bytes;
    }
    return header(static_cast<std::uint32_t>(start + data.size())) + table + data;
}

} // namespace rhombloom
