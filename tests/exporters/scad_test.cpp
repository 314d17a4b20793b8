#include "exporters/scad.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/text.h"
#include "exporters/scad_presets.h"

namespace rhombloom {

namespace {

const std::string templates = RHOMBLOOM_SOURCE_DIR "/templates/";

std::string template_text(const std::string& file)
{
    return load_file(templates + file, 1 << 20).value();
}

//! The part of a template between two lines, without them.
std::string block(const std::string& text, const std::string& first, const std::string& last)
{
    const std::size_t begin = text.find("\n// ---- " + first);
    const std::size_t end = text.find("\n// ---- " + last, begin);
    EXPECT_NE(begin, std::string::npos) << first;
    EXPECT_NE(end, std::string::npos) << last;
    return text.substr(begin, end - begin);
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

//! The section headings, captions, names, defaults and sliders, as the Customizer reads them.
std::string customizer_lines(const Parameter& row)
{
    const std::string value = scad_literal(row, *piece_parameters(Element{}));
    return "\n// " + row.help + "\n" + row.name + " = " + value + "; // [" + to_text(row.min) + ":" +
           to_text(row.step) + ":" + to_text(row.max) + "]\n";
}

//! The names set before the hidden part of a template.
std::vector<std::string> customizer_names(const std::string& text)
{
    std::vector<std::string> names;
    const std::string shown = text.substr(0, text.find("/* [Hidden] */"));
    for (std::size_t line = 0; line < shown.size(); line = shown.find('\n', line) + 1) {
        const std::size_t equals = shown.find(" = ", line);
        if (equals < shown.find('\n', line) && shown.compare(line, 2, "//") != 0) {
            names.push_back(shown.substr(line, equals - line));
        }
    }
    return names;
}

//! A rule of the table in the names that templates use for resolved values.
std::string resolved_rule(const Parameter& row)
{
    std::string rule = to_text(row.rule);
    for (const Parameter& other : parameter_table()) {
        const bool has_symbol = other.section == "Hook" && other.name != "slit_clearance";
        for (std::size_t found = 0; has_symbol && (found = rule.find(other.name)) != std::string::npos;) {
            rule.replace(found, other.name.size(), other.symbol);
        }
    }
    return rule;
}

} // namespace

TEST(CleanTitle, KeepsOnlyWhatCannotEndACommentOrAString)
{
    EXPECT_EQ(clean_title("Ball 30_v1.2-b"), "Ball 30_v1.2-b");
    EXPECT_EQ(clean_title("a\n\"; */ cube(9); //\\\xc3\xa9"), "a  cube9 ");
    EXPECT_EQ(clean_title(std::string(200, 'x')).size(), 60u);
}

TEST(WithLiteral, ReplacesOneLiteralAndKeepsItsComment)
{
    EXPECT_EQ(*with_literal("x\nla = 80; // [20:300]\nlab = 1;\n", "la", "61.5"),
              "x\nla = 61.5; // [20:300]\nlab = 1;\n");
}

TEST(WithLiteral, RefusesNoneOrTwo)
{
    EXPECT_FALSE(with_literal("x\nlb = 80;\n", "la", "1"));
    EXPECT_FALSE(with_literal("x\nla = 80;\nla = 81;\n", "la", "1"));
}

TEST(ScadTemplates, ShowTheParametersOfTheTable)
{
    for (const ScadTemplate& scad : scad_templates()) {
        const std::string text = template_text(scad.name + ".scad");
        for (const Parameter& row : scad_parameters(scad.part)) {
            EXPECT_TRUE(contains(text, customizer_lines(row))) << scad.name << ".scad: " << customizer_lines(row);
        }
    }
}

TEST(ScadTemplates, ShowNoHookParameterTheTableDoesNotHave)
{
    std::vector<std::string> expected = {"output"};
    for (const Parameter& row : parameter_table()) {
        expected.push_back(row.name);
    }
    expected.insert(expected.end(), {"hook_sizes", "layer_height", "segments"});
    auto shown = customizer_names(template_text("element.scad"));
    std::sort(expected.begin(), expected.end());
    std::sort(shown.begin(), shown.end());
    EXPECT_EQ(shown, expected);
}

TEST(ScadTemplates, HaveTheLimitsAndRulesOfTheTable)
{
    const std::string text = template_text("element.scad");
    for (const Parameter& row : parameter_table()) {
        const std::string limits = "need_number(\"" + row.name + "\", " + row.name + ", " + to_text(row.min) + ", " +
                                   to_text(row.max) + ", \"" + row.unit + "\")";
        EXPECT_TRUE(contains(text, limits)) << limits;
        if (row.section == "Hook" && row.name != "slit_clearance") {
            const std::string rule =
                "\n" + row.symbol + " = automatic ? " + resolved_rule(row) + " : " + row.name + ";\n";
            EXPECT_TRUE(contains(text, rule)) << rule;
        }
    }
}

TEST(ScadTemplates, AreDescribedWithTheTable)
{
    EXPECT_TRUE(contains(template_text("README.md"), "\n" + parameter_table_markdown() + "\n"));
}

TEST(ScadTemplates, ShareTheirBlocksWordForWord)
{
    const std::string element = template_text("element.scad");
    const std::string limits = block(element, "limits", "end of limits");
    for (const ScadTemplate& scad : scad_templates()) {
        EXPECT_EQ(block(template_text(scad.name + ".scad"), "limits", "end of limits"), limits) << scad.name;
    }
    EXPECT_EQ(block(template_text("fit_coupon.scad"), "outline", "end of sheet"),
              block(element, "outline", "end of sheet"));
    EXPECT_EQ(block(template_text("connectors.scad"), "profiles", "end of profiles"),
              block(template_text("lamp_parts.scad"), "profiles", "end of profiles"));
}

TEST(ScadTemplates, ArePlainAsciiWithUnixLines)
{
    for (const ScadTemplate& scad : scad_templates()) {
        for (const char c : template_text(scad.name + ".scad")) {
            ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << scad.name << ": " << int(c);
        }
    }
}

// Set RHOMBLOOM_WRITE_PRESETS=1 to write the files anew after a change of materials or of the table.
TEST(ScadPresets, AreThoseInTheCheckout)
{
    const auto known = materials();
    ASSERT_TRUE(known) << known.error().message;
    for (const ScadTemplate& scad : scad_templates()) {
        const std::string file = preset_file(scad_presets(scad, *known));
        if (std::getenv("RHOMBLOOM_WRITE_PRESETS")) {
            ASSERT_TRUE(save_file(templates + scad.name + ".json", file));
        }
        EXPECT_EQ(template_text(scad.name + ".json"), file) << scad.name;
    }
}

TEST(ScadPresets, TakeTheProjectAsFirst)
{
    const ScadPreset project{"This project", {{"la", "61.25"}}};
    const auto file = with_preset(preset_file({{"other", {{"la", "80"}}}}), project);
    ASSERT_TRUE(file);
    EXPECT_LT(file->find("This project"), file->find("other"));
    EXPECT_FALSE(with_preset("[]", project));
}

TEST(HookFiles, CarryTheDesignsValuesAndItsFingerprint)
{
    Element element;
    element.la = 61.25;
    element.lb = 70;
    const auto files = hook_files(hook_parameters(element), "Ball\"; cube(9); //");
    ASSERT_TRUE(files) << files.error().message;
    const std::string& scad = files->at("hooks/element.scad");
    EXPECT_TRUE(contains(scad, "\nla = 61.25; // [40:1:200]\n"));
    EXPECT_TRUE(contains(scad, "\nalpha = 63.435; // ["));
    EXPECT_TRUE(contains(scad, "\nhook_sizes = \"automatic\"; // ["));
    EXPECT_TRUE(contains(scad, "project_values = [61.25, 70, 63.435, 0.5, "));
    EXPECT_EQ(scad.find("// Project: Ball cube9 \n"), 0u);
    EXPECT_EQ(files->size(), 2 * scad_templates().size() + 1);
}

TEST(HookFiles, WidenTheSlidersForUnusualElements)
{
    Element element;
    element.la = 250;
    element.lb = 260;
    const auto files = hook_files(hook_parameters(element), "");
    ASSERT_TRUE(files) << files.error().message;
    EXPECT_TRUE(contains(files->at("hooks/element.scad"), "\nla = 250; // [40:1:250]\n"));
    EXPECT_TRUE(contains(files->at("hooks/connectors.scad"), "need_number(\"la\", la, 40, 250,"));
}

TEST(HookFiles, SayWhenHookSizesAreTheMakersOwn)
{
    HookParameters own = hook_parameters({});
    own.finger_length += 1;
    EXPECT_TRUE(contains(hook_files(own, "")->at("hooks/element.scad"), "\nhook_sizes = \"given\"; // ["));
}

TEST(HookFiles, CarryTheKerfUnlessItClosesTheSlit)
{
    const auto kerf_of = [](double kerf) {
        const std::string scad = hook_files({hook_parameters({}), {kerf, kerf}}, "")->at("hooks/element.scad");
        return scad.substr(scad.find("\nkerf = ") + 8, 3);
    };
    EXPECT_EQ(kerf_of(0.2), "0.2");
    EXPECT_EQ(kerf_of(0.8), "0; ");
}

TEST(HookFiles, RefuseWhatHasNoOutline)
{
    HookParameters impossible = hook_parameters({});
    impossible.lip_rounding = impossible.lip + 1;
    EXPECT_FALSE(hook_files(impossible, ""));
}

} // namespace rhombloom
