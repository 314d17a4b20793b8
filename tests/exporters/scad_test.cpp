#include "exporters/scad.h"

#include <gtest/gtest.h>

namespace rhombloom {

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

TEST(HookFiles, CarryTheDesignsValuesAndItsFingerprint)
{
    Element element;
    element.la = 61.25;
    element.lb = 70;
    const auto files = hook_files(hook_parameters(element), "Ball\"; cube(9); //");
    ASSERT_TRUE(files) << files.error().message;
    const std::string& scad = files->at("hooks/element.scad");
    EXPECT_NE(scad.find("\nla = 61.25; // ["), std::string::npos);
    EXPECT_NE(scad.find("\nalpha = 63.435; // ["), std::string::npos);
    EXPECT_NE(scad.find("project_values = [61.25, 70, 63.435, 0.5, "), std::string::npos);
    EXPECT_EQ(scad.find("// Project: Ball cube9 \n"), 0u);
}

TEST(HookFiles, RefuseWhatHasNoOutline)
{
    HookParameters impossible = hook_parameters({});
    impossible.lip_rounding = impossible.lip + 1;
    EXPECT_FALSE(hook_files(impossible, ""));
}

} // namespace rhombloom
