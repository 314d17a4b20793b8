#pragma once

#include <string>
#include <utility>

#include "core/text.h"

namespace rhombloom::dxf_file {

inline std::string hex(int value)
{
    std::string text;
    for (; value > 0; value /= 16) {
        text.insert(text.begin(), "0123456789ABCDEF"[value % 16]);
    }
    return text.empty() ? "0" : text;
}

//! Appends group codes and their values, a line each.
class Groups
{
public:
    Groups& text(int code, const std::string& value)
    {
        const std::string digits = std::to_string(code);
        text_ += std::string(digits.size() < 3 ? 3 - digits.size() : 0, ' ') + digits + "\n" + value + "\n";
        return *this;
    }
    Groups& integer(int code, int value) { return text(code, std::to_string(value)); }
    Groups& reference(int code, int handle) { return text(code, hex(handle)); }
    Groups& real(int code, double value, int decimals = 5)
    {
        const std::string digits = to_fixed(value, decimals);
        return text(code, digits.find('.') == std::string::npos ? digits + ".0" : digits);
    }
    //! The group codes of y and z are those of x plus 10 and 20.
    Groups& xy(int code, double x, double y) { return real(code, x).real(code + 10, y); }
    Groups& xyz(int code, double x, double y, double z = 0) { return xy(code, x, y).real(code + 20, z); }
    Groups& subclass(const char* name) { return text(100, name); }
    //! The start of an object that has a handle and an owner.
    Groups& object(const char* type, int handle, int owner)
    {
        return text(0, type).reference(5, handle).reference(330, owner);
    }
    Groups& table(const char* name, int handle, int count)
    {
        text(0, "TABLE").text(2, name);
        return reference(5, handle).reference(330, 0).subclass("AcDbSymbolTable").integer(70, count);
    }
    Groups& record(const char* type, int handle, int table, const char* subclass_name, const std::string& name)
    {
        object(type, handle, table).subclass("AcDbSymbolTableRecord").subclass(subclass_name);
        return text(2, name).integer(70, 0);
    }
    Groups& section(const char* name) { return text(0, "SECTION").text(2, name); }
    Groups& end_section() { return text(0, "ENDSEC"); }
    Groups& end_table() { return text(0, "ENDTAB"); }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

} // namespace rhombloom::dxf_file
