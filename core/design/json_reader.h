#pragma once

#include <nlohmann/json.hpp>

#include "core/expected.h"
#include "core/model/surface.h"

namespace rhombloom {

//! \brief One JSON object being read: typed access by key, errors with the JSON path, and no key left unread.
//! \details After a failed read the first error sticks and later reads return their defaults; ask finish() at the end.
class ObjectReader
{
public:
    ObjectReader(const nlohmann::json& value, std::string path);

    bool has(const std::string& key) const;

    double number(const std::string& key, double fallback, double min, double max);
    int integer(const std::string& key, int fallback, int min, int max);
    bool flag(const std::string& key, bool fallback);
    std::string text(const std::string& key, const std::string& fallback);
    Vec3 point(const std::string& key, const Vec3& fallback);

    //! The value itself, marked as read; null when the key is absent.
    const nlohmann::json* take(const std::string& key);

    //! Record a refusal: "PATH.key: what".
    void fail(const std::string& key, const std::string& what);
    void fail(const Error& error);
    //! Demand a key: refused when it is absent.
    void require(const std::string& key);

    const std::string& path() const { return path_; }
    std::string path(const std::string& key) const { return path_ + "." + key; }

    //! The first error, or a refusal of the first key that nobody asked for.
    Expected<void> finish();

private:
    const nlohmann::json* find(const std::string& key);

    const nlohmann::json& value_;
    std::string path_;
    std::vector<std::string> known_;
    Expected<void> state_;
};

//! \brief Parse JSON text; refuses duplicate keys, NaN, numbers beyond a double, deep nesting, with line and column.
Expected<nlohmann::json> parse_json(std::string_view text);

//! \brief What a value is, for messages: "the text \"x\"", "the number 3", "a list", ...
std::string describe(const nlohmann::json& value);

//! \brief A byte of a UTF-8 character, and not its first.
bool continues_character(char byte);

} // namespace rhombloom
