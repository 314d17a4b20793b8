#include "exporters/code_points.h"

namespace rhombloom {

std::vector<char32_t> code_points(const std::string& utf8)
{
    std::vector<char32_t> result;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto lead = static_cast<unsigned char>(utf8[i]);
        const int length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t c = length == 1 ? lead : lead & (0xFFU >> (length + 1));
        for (int k = 1; k < length && i + k < utf8.size(); ++k) {
            c = (c << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3FU);
        }
        result.push_back(c);
        i += length;
    }
    return result;
}

std::string hexadecimal(char32_t c)
{
    std::string text;
    for (int shift = 20; shift >= 0; shift -= 4) {
        const unsigned digit = (c >> shift) & 0xFU;
        if (digit != 0 || !text.empty() || shift < 16) {
            text += "0123456789ABCDEF"[digit];
        }
    }
    return text;
}

} // namespace rhombloom
