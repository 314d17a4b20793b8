#include "exporters/pdf_content.h"

#include <charconv>
#include <cmath>

namespace rhombloom {

void add_integer(std::string& out, long long value)
{
    char digits[24];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    out.append(digits, end);
}

void add_number(std::string& out, double value)
{
    const long long thousandths = std::llround(value * 1000);
    const long long size = std::abs(thousandths);
    if (thousandths < 0) {
        out += '-';
    }
    if (size >= 1000 || size == 0) {
        add_integer(out, size / 1000);
    }
    if (size % 1000 != 0) {
        const char digits[] = {static_cast<char>('0' + size / 100 % 10), static_cast<char>('0' + size / 10 % 10),
                               static_cast<char>('0' + size % 10)};
        out += '.';
        out.append(digits, size % 10 != 0 ? 3 : size % 100 != 0 ? 2 : 1);
    }
    out += ' ';
}

void add_glyph(std::string& out, unsigned id)
{
    for (const unsigned byte : {id >> 8 & 0xFFU, id & 0xFFU}) {
        const char c = static_cast<char>(byte);
        if (c == '(' || c == ')' || c == '\\') {
            out += '\\';
        }
        if (c == '\r') {
            out += "\\r";
        } else {
            out += c;
        }
    }
}

} // namespace rhombloom
