#include "exporters/parameter_table.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "table_elements.h"

namespace rhombloom {

TEST(ParameterTable, EveryRowReadsBackWhatItSets)
{
    for (const Parameter& row : parameter_table()) {
        auto piece = *piece_parameters(Element{});
        row.set(piece, row.max);
        EXPECT_NEAR(row.get(piece), row.max, 1e-12) << row.name;
    }
}

TEST(ParameterTable, RowsHaveTheirOwnNamesSymbolsAndSaneRanges)
{
    std::set<std::string> seen;
    for (const Parameter& row : parameter_table()) {
        EXPECT_TRUE(seen.insert(row.name).second) << row.name;
        EXPECT_LT(row.min, row.max) << row.name;
        EXPECT_GT(row.step, 0) << row.name;
        EXPECT_FALSE(row.help.empty()) << row.name;
        EXPECT_TRUE(row.unit == "mm" || row.unit == "deg") << row.name;
    }
}

TEST(ParameterTable, RulesReferToEarlierRowsOnly)
{
    std::set<std::string> earlier;
    for (const Parameter& row : parameter_table()) {
        for (const auto& terms : {row.rule.terms, row.rule.cap}) {
            for (const ParameterTerm& term : terms) {
                EXPECT_TRUE(earlier.count(term.name)) << row.name << " needs " << term.name;
            }
        }
        earlier.insert(row.name);
    }
}

TEST(ParameterTable, DefaultsLieWithinTheirRanges)
{
    for (const Element& element : tests::table_elements()) {
        const auto piece = *piece_parameters(element);
        for (const Parameter& row : parameter_table()) {
            EXPECT_GE(row.get(piece), row.min - 1e-9) << row.name << " at la " << element.la;
            EXPECT_LE(row.get(piece), row.max + 1e-9) << row.name << " at la " << element.la;
        }
    }
}

TEST(ParameterTable, AWiderFingerCarriesItsHookAlong)
{
    const HookParameters p = piece_parameters(Element{}, {{"finger_width", 6}})->hook;
    EXPECT_DOUBLE_EQ(p.hole_radius, 7.2);
    EXPECT_DOUBLE_EQ(p.finger_length, 9.6);
    EXPECT_DOUBLE_EQ(p.lip, 0.4 + 4.5);
    EXPECT_DOUBLE_EQ(p.scoop_depth, 8);
}

TEST(ParameterTable, LaterSettingsOverrideRules)
{
    const auto piece = *piece_parameters(Element{}, {{"barb", 0.8}, {"kerf", 0.2}, {"finger_turn", 3}});
    EXPECT_EQ(piece.hook.barb, 0.8);
    EXPECT_EQ(piece.kerf.x, 0.2);
    EXPECT_EQ(piece.kerf.y, 0.2);
    EXPECT_DOUBLE_EQ(piece.hook.finger_turn, radians(3));
}

TEST(ParameterTable, RulesReadAsExpressions)
{
    std::string all;
    for (const Parameter& row : parameter_table()) {
        all += row.name + " = " + to_text(row.rule) + "\n";
    }
    EXPECT_NE(all.find("lb = 1.1 * la\n"), std::string::npos) << all;
    EXPECT_NE(all.find("finger_width = max(3, 0.055 * la)\n"), std::string::npos) << all;
    EXPECT_NE(all.find("lip = min(0.5 * thickness + 0.5 * slit_clearance + 0.75 * finger_width, hole_radius * "
                       "sin(alpha) + finger_width * sin(alpha) - finger_width * cos(alpha) - 0.5 * thickness * "
                       "cos(alpha) - 0.5 * slit_clearance * cos(alpha) - 0.31)\n"),
              std::string::npos)
        << all;
    EXPECT_NE(all.find("kerf_y = kerf\n"), std::string::npos) << all;
    EXPECT_NE(all.find("finger_turn = 0\n"), std::string::npos) << all;
}

TEST(ParameterTable, RefusesUnknownNamesAndValuesOutOfRange)
{
    const auto unknown = piece_parameters(Element{}, {{"fingerwidth", 4}});
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("finger_width"), std::string::npos);
    for (const double bad : {-1.0, 26.0, std::nan(""), HUGE_VAL}) {
        const auto refused = piece_parameters(Element{}, {{"finger_width", bad}});
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().message.find("from 2 to 25 mm"), std::string::npos) << refused.error().message;
    }
}

TEST(ParameterTable, ManualsTableHasOneLineARow)
{
    const std::string text = parameter_table_markdown();
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), parameter_table().size() + 2);
}

} // namespace rhombloom
