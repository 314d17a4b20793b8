#include "core/design/json_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/text.h"

namespace rhombloom {

using nlohmann::json;

namespace {

constexpr int max_depth = 32; // a design needs 5

std::string position(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? before.size() : before.size() - newline - 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(1, column));
}

//! Builds the document and stops at what nlohmann::json would let pass: duplicate keys and bottomless nesting.
class StrictBuilder : public nlohmann::json_sax<json>
{
public:
    explicit StrictBuilder(json& root) : dom_(root, false) {}

    bool null() override { return dom_.null(); }
    bool boolean(bool value) override { return dom_.boolean(value); }
    bool number_integer(number_integer_t value) override { return dom_.number_integer(value); }
    bool number_unsigned(number_unsigned_t value) override { return dom_.number_unsigned(value); }
    bool number_float(number_float_t value, const string_t& text) override { return dom_.number_float(value, text); }
    bool string(string_t& value) override { return dom_.string(value); }
    bool binary(binary_t& value) override { return dom_.binary(value); }
    bool start_object(std::size_t size) override
    {
        keys_.emplace_back();
        return enter() && dom_.start_object(size);
    }
    bool key(string_t& value) override
    {
        if (!keys_.back().insert(value).second) {
            return complain("the key \"" + value.substr(0, 60) + "\" appears twice in one object; remove one");
        }
        return dom_.key(value);
    }
    bool end_object() override
    {
        keys_.pop_back();
        --depth_;
        return dom_.end_object();
    }
    bool start_array(std::size_t size) override { return enter() && dom_.start_array(size); }
    bool end_array() override
    {
        --depth_;
        return dom_.end_array();
    }
    bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) override
    {
        byte_ = byte;
        const bool number = error.id == 406; // out_of_range: a number that no double can hold
        return complain(number ? "a number is too large" : "this is not valid JSON");
    }

    const std::string& problem() const { return problem_; }
    std::size_t byte() const { return byte_; }

private:
    bool enter()
    {
        return ++depth_ <= max_depth || complain("lists and objects are nested more than 32 deep, a design needs 5");
    }
    bool complain(const std::string& what)
    {
        problem_ = what;
        return false;
    }

    nlohmann::detail::json_sax_dom_parser<json> dom_;
    std::vector<std::set<std::string>> keys_;
    int depth_ = 0;
    std::string problem_;
    std::size_t byte_ = std::string::npos;
};

} // namespace

Expected<json> parse_json(std::string_view text)
{
    json root;
    StrictBuilder builder(root);
    if (json::sax_parse(text.begin(), text.end(), &builder)) {
        return root;
    }
    const bool placed = builder.byte() != std::string::npos;
    return refuse((placed ? position(text, builder.byte()) + ": " : "") + builder.problem());
}

bool continues_character(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

namespace {

std::size_t characters(const std::string& utf8)
{
    return utf8.size() - std::count_if(utf8.begin(), utf8.end(), continues_character);
}

//! At most 60 bytes of it, and no half character.
std::string beginning(const std::string& utf8)
{
    std::size_t end = std::min<std::size_t>(utf8.size(), 60);
    while (end < utf8.size() && end > 0 && continues_character(utf8[end])) {
        --end;
    }
    return utf8.substr(0, end) + (end < utf8.size() ? "..." : "");
}

} // namespace

std::string describe(const json& value)
{
    switch (value.type()) {
    case json::value_t::object:
        return "an object";
    case json::value_t::array:
        return "a list of " + std::to_string(value.size());
    case json::value_t::string:
        return "the text \"" + beginning(value.get_ref<const std::string&>()) + "\"";
    case json::value_t::null:
        return "null";
    case json::value_t::boolean:
        return value.get<bool>() ? "true" : "false";
    default:
        return "the number " + value.dump();
    }
}

ObjectReader::ObjectReader(const json& value, std::string path) : value_(value), path_(std::move(path))
{
    if (!value_.is_object()) {
        state_ = refuse(path_ + " is " + describe(value_) + ": expected an object {...}");
    }
}

bool ObjectReader::has(const std::string& key) const
{
    return value_.is_object() && value_.contains(key);
}

const json* ObjectReader::find(const std::string& key)
{
    known_.push_back(key);
    if (!state_ || !value_.is_object()) {
        return nullptr;
    }
    const auto it = value_.find(key);
    return it == value_.end() ? nullptr : &*it;
}

const json* ObjectReader::take(const std::string& key)
{
    return find(key);
}

void ObjectReader::fail(const std::string& key, const std::string& what)
{
    if (state_) {
        state_ = refuse(path(key) + " " + what);
    }
}

void ObjectReader::fail(const Error& error)
{
    if (state_) {
        state_ = tl::make_unexpected(error);
    }
}

void ObjectReader::require(const std::string& key)
{
    if (state_ && !has(key)) {
        fail(key, "is missing");
    }
}

double ObjectReader::number(const std::string& key, double fallback, double min, double max)
{
    const json* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    const std::string range = "expected a number from " + to_text(min) + " to " + to_text(max);
    if (!value->is_number()) {
        fail(key, "is " + describe(*value) + ": " + range);
        return fallback;
    }
    const double number = value->get<double>();
    if (!(number >= min && number <= max)) {
        fail(key, "is " + to_text(number) + ": " + range);
        return fallback;
    }
    return number;
}

int ObjectReader::integer(const std::string& key, int fallback, int min, int max)
{
    const double value = number(key, fallback, min, max);
    if (value != std::floor(value)) {
        fail(key, "is " + to_text(value) + ": expected a whole number");
        return fallback;
    }
    return static_cast<int>(value);
}

bool ObjectReader::flag(const std::string& key, bool fallback)
{
    const json* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_boolean()) {
        fail(key, "is " + describe(*value) + ": expected true or false");
        return fallback;
    }
    return value->get<bool>();
}

std::string ObjectReader::text(const std::string& key, const std::string& fallback)
{
    constexpr std::size_t max_length = 200;
    const json* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_string() || characters(value->get_ref<const std::string&>()) > max_length) {
        fail(key, "is " + describe(*value) + ": expected a text of at most 200 characters");
        return fallback;
    }
    return value->get<std::string>();
}

Vec3 ObjectReader::point(const std::string& key, const Vec3& fallback)
{
    constexpr double limit = 1e6; // a kilometre
    const json* value = find(key);
    if (value == nullptr) {
        return fallback;
    }
    const auto fits = [](const json& x) { return x.is_number() && std::abs(x.get<double>()) <= limit; };
    if (!value->is_array() || value->size() != 3 || !std::all_of(value->begin(), value->end(), fits)) {
        fail(key, "is " + describe(*value) + ": expected three numbers [x, y, z], each at most 1000000 in size");
        return fallback;
    }
    return {(*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>()};
}

Expected<void> ObjectReader::finish()
{
    if (!state_) {
        return state_;
    }
    for (const auto& [key, value] : value_.items()) {
        if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
            std::string expected;
            for (const std::string& name : known_) {
                expected += (expected.empty() ? "" : ", ") + name;
            }
            return refuse(path_ + " has an unknown key \"" + key.substr(0, 60) + "\": expected one of " + expected);
        }
    }
    return {};
}

} // namespace rhombloom
