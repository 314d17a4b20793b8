#include "core/design/design_file.h"

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

std::string refusal(const std::string& json)
{
    const auto design = parse_design(json);
    return design ? "accepted" : design.error().message;
}

constexpr const char* ball = R"("operations": [{"op": "place", "id": "body", "shape": "ball-30"}])";

std::string with_element(const std::string& element)
{
    return std::string(R"({"rhombloom": 1, "element": )") + element + ", " + ball + "}";
}

TEST(DesignFile, EverythingButVersionAndOperationsHasADefault)
{
    const auto design = parse_design(std::string(R"({"rhombloom": 1, )") + ball + "}");
    ASSERT_TRUE(design.has_value()) << design.error().message;
    EXPECT_EQ(design->element.la, 80);
    EXPECT_EQ(std::get<Place>(design->operations[0]).shape, "ball-30");
}

TEST(DesignFile, WritingAndReadingGivesTheSameBytes)
{
    const auto design = parse_design(with_element(R"({"la_mm": 61.7, "lb_mm": 67.9, "alpha_deg": 63.435})"));
    ASSERT_TRUE(design.has_value());
    const std::string once = write_design(*design);
    EXPECT_EQ(write_design(*parse_design(once)), once);
    EXPECT_NE(once.find("63.435"), std::string::npos);
}

struct Bad
{
    const char* json;
    const char* place; //!< must occur in the message
};

class BadDesign : public testing::TestWithParam<Bad>
{
};

TEST_P(BadDesign, IsRefusedWithItsPlace)
{
    EXPECT_NE(refusal(GetParam().json).find(GetParam().place), std::string::npos) << refusal(GetParam().json);
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, BadDesign,
    testing::Values(
        Bad{"", "line 1"}, Bad{"nonsense", "line 1"}, Bad{"[]", "$ is a list"}, Bad{"{}", "$.rhombloom"},
        Bad{R"({"rhombloom": 2, "operations": [1]})", "$.rhombloom is 2"},
        Bad{R"({"rhombloom": "1", "operations": [1]})", "$.rhombloom is the text"},
        Bad{R"({"rhombloom": 1})", "$.operations is missing"},
        Bad{R"({"rhombloom": 1, "operations": []})", "$.operations is a list of 0"},
        Bad{R"({"rhombloom": 1, "operations": {}})", "$.operations is an object"},
        Bad{R"({"rhombloom": 1, "operations": [5]})", "$.operations[0] is the number 5"},
        Bad{R"({"rhombloom": 1, "operations": [{"op": "explode"}]})", "$.operations[0].op"},
        Bad{R"({"rhombloom": 1, "operations": [{"op": "place"}]})", "$.operations[0].shape is missing"},
        Bad{R"({"rhombloom": 1, "rhombloom": 1})", "twice"},
        Bad{R"({"rhombloom": 1, "colour": 1, "operations": [{"op": "place", "shape": "ball-30"}]})", "\"colour\""},
        Bad{R"({"rhombloom": 1, "operations": [{"op": "place", "shape": "ball-30", "position_mm": [1, 2]}]})",
            "$.operations[0].position_mm"},
        Bad{R"({"rhombloom": 1, "operations": [{"op": "place", "shape": "ball-30", "position_mm": [1, 2, 1e300]}]})",
            "$.operations[0].position_mm"},
        Bad{R"({"rhombloom": NaN})", "line 1"}, Bad{R"({"rhombloom": 1e999})", "too large"}));

TEST(DesignFile, RefusesImpossibleElementsWithTheKey)
{
    EXPECT_NE(refusal(with_element(R"({"la_mm": -80})")).find("la_mm is -80"), std::string::npos);
    EXPECT_NE(refusal(with_element(R"({"la_mm": 1e308})")).find("la_mm"), std::string::npos);
    EXPECT_NE(refusal(with_element(R"({"la_mm": 88, "lb_mm": 80})")).find("lb_mm is 80"), std::string::npos);
    EXPECT_NE(refusal(with_element(R"({"la_mm": 80, "lb_mm": 80})")).find("lb_mm is 80"), std::string::npos);
    for (const char* alpha : {"0", "90", "180", "-60", "1e308"}) {
        EXPECT_NE(refusal(with_element(std::string(R"({"alpha_deg": )") + alpha + "}")).find("alpha_deg"),
                  std::string::npos);
    }
}

// 243.3 / 162.2 is a little more than 1.5 in a computer's numbers.
TEST(DesignFile, TheLongSideMayBeExactlyOneAndAHalfTimesTheShort)
{
    for (const char* element : {R"({"la_mm": 162.2, "lb_mm": 243.3})", R"({"la_mm": 117.6, "lb_mm": 176.4})"}) {
        EXPECT_EQ(refusal(with_element(element)), "accepted");
    }
    EXPECT_NE(refusal(with_element(R"({"la_mm": 162.2, "lb_mm": 243.4})")), "accepted");
}

// The name of a mesh may be any bytes: a design is made of it nevertheless, and can be read again.
TEST(DesignFile, ATitleFromAFileNameCanAlwaysBeReadAgain)
{
    std::string many;
    for (int k = 0; k < 100; ++k) {
        many += "\u6708";
    }
    for (const std::string& name : {std::string("l\xE4mp"), std::string(300, 'n'), many, std::string("a\tb\"c\\"),
                                    std::string("cut \xE6\x9C"), std::string()}) {
        Design design;
        design.title = title_of(name);
        design.operations = {Place{"body", "ball-30"}};
        const auto read = parse_design(write_design(design));
        ASSERT_TRUE(read.has_value()) << read.error().message;
        EXPECT_EQ(read->title, design.title);
    }
    EXPECT_EQ(title_of("l\xE4mp"), "l\uFFFDmp");
    EXPECT_EQ(title_of("B\u00FCste"), "B\u00FCste");
    EXPECT_EQ(title_of("a\tb"), "a b");
    EXPECT_EQ(title_of(many), many.substr(0, 240));
}

// Characters, not bytes; and no half character is shown.
TEST(DesignFile, TitlesHaveUpToTwoHundredCharactersOfAnyScript)
{
    const auto titled = [](int count) {
        std::string title = "x";
        for (int k = 1; k < count; ++k) {
            title += "\u706F";
        }
        return refusal(R"({"rhombloom": 1, "title": ")" + title + R"(", )" + ball + "}");
    };
    EXPECT_EQ(titled(200), "accepted");
    EXPECT_NE(titled(201).find("\u706F...\": expected a text of at most 200 characters"), std::string::npos)
        << titled(201);
}

TEST(DesignFile, DeepNestingIsRefusedWithoutRecursion)
{
    EXPECT_NE(refusal(std::string(1 << 22, '[')).find("nested"), std::string::npos);
    EXPECT_NE(refusal("{\"a\":" + std::string(100000, '[')).find("nested"), std::string::npos);
}

} // namespace
} // namespace rhombloom
