#include "exporters/dxf.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

using Groups = std::vector<std::pair<int, std::string>>;

Groups groups(const std::string& text)
{
    Groups result;
    std::istringstream in(text);
    std::string code;
    std::string value;
    while (std::getline(in, code) && std::getline(in, value)) {
        result.emplace_back(std::stoi(code), value);
    }
    return result;
}

Drawing sample()
{
    const Path closed = {{{Vec2(10, 10), 1}, {Vec2(30, 10), 0}, {Vec2(20, 30), -0.25}}, true};
    const Path open = {{{Vec2(1, 2), 0}, {Vec2(3, 4), 0}}, false};
    return {100,
            50,
            {{"ENGRAVE", LayerUse::Engrave, 0x000000, {open, open}},
             {"CUT_OUTER", LayerUse::CutOuter, 0xFF0000, {closed}},
             {"SHEET", LayerUse::Sheet, 0xF36926, {closed}}},
            {"two\nlines \xc3\xa4"}};
}

int count(const Groups& all, int code, const std::string& value)
{
    return static_cast<int>(std::count(all.begin(), all.end(), std::pair(code, value)));
}

std::string variable(const Groups& all, const std::string& name)
{
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        if (all[i] == std::pair(9, name)) {
            return all[i + 1].second;
        }
    }
    return "";
}

TEST(Dxf, R2000HasPolylinesWithBulges)
{
    const Groups all = groups(dxf(sample()));
    EXPECT_EQ(variable(all, "$ACADVER"), "AC1015");
    EXPECT_EQ(variable(all, "$INSUNITS"), "4");
    EXPECT_EQ(count(all, 0, "LWPOLYLINE"), 4);
    EXPECT_EQ(count(all, 0, "POLYLINE"), 0);
    EXPECT_EQ(count(all, 42, "-0.25"), 2);
    EXPECT_EQ(count(all, 8, "CUT_OUTER"), 1);
}

TEST(Dxf, R12HasNothingOfLaterVersions)
{
    const Groups all = groups(dxf(sample(), DxfVersion::R12));
    EXPECT_EQ(variable(all, "$ACADVER"), "AC1009");
    EXPECT_EQ(count(all, 0, "POLYLINE"), 4);
    EXPECT_EQ(count(all, 0, "SEQEND"), 4);
    EXPECT_EQ(count(all, 0, "VERTEX"), 3 + 3 + 2 + 2);
    for (const auto& [code, value] : all) {
        EXPECT_NE(code, 100) << value;
        EXPECT_NE(code, 330) << value;
        EXPECT_NE(value, "LWPOLYLINE");
    }
}

TEST(Dxf, HandlesAreUniqueAndBelowTheSeed)
{
    const Groups all = groups(dxf(sample()));
    std::set<int> handles;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool seed = i > 0 && all[i - 1] == std::pair(9, std::string("$HANDSEED"));
        if ((all[i].first == 5 || all[i].first == 105) && !seed) {
            EXPECT_TRUE(handles.insert(std::stoi(all[i].second, nullptr, 16)).second) << all[i].second;
        }
    }
    EXPECT_LT(*handles.rbegin(), std::stoi(variable(all, "$HANDSEED"), nullptr, 16));
    // Whatever is pointed at exists.
    for (const auto& [code, value] : all) {
        if (code == 330 || code == 340 || code == 350 || code == 390) {
            const int target = std::stoi(value, nullptr, 16);
            EXPECT_TRUE(target == 0 || handles.count(target) == 1) << code << " " << value;
        }
    }
}

TEST(Dxf, NotesAreOneLineOfAsciiBeforeTheFirstSection)
{
    const Groups all = groups(dxf(sample()));
    EXPECT_EQ(all[0], std::pair(999, std::string("two lines ?")));
    EXPECT_EQ(count(all, 999, all[0].second), 1);
}

TEST(Dxf, EachUseHasItsOwnColour)
{
    const std::string text = dxf(sample());
    const Groups all = groups(text);
    std::map<std::string, std::string> colours;
    for (std::size_t i = 0; i + 2 < all.size(); ++i) {
        if (all[i].first == 2 && all[i + 2].first == 62) {
            colours[all[i].second] = all[i + 2].second;
        }
    }
    EXPECT_EQ(colours["ENGRAVE"], "7");
    EXPECT_EQ(colours["CUT_OUTER"], "1");
    EXPECT_EQ(colours["SHEET"], "30");
}

} // namespace
} // namespace rhombloom
