#include "exporters/machines.h"

#include <set>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

TEST(Machines, AreFoundByNameWhateverTheCaseAndTheSpaces)
{
    for (const Machine& machine : machines()) {
        EXPECT_EQ(find_machine(machine.name)->width, machine.width);
    }
    EXPECT_EQ(find_machine("Trotec  Speedy_100")->name, "trotec-speedy-100");
    EXPECT_EQ(find_machine("A4")->height, 297);
    EXPECT_EQ(find_machine("Cameo")->name, "silhouette-cameo-12x12");
}

TEST(Machines, NamesAreUniqueAndSizesPossible)
{
    std::set<std::string_view> names;
    for (const Machine& machine : machines()) {
        EXPECT_TRUE(names.insert(machine.name).second) << machine.name;
        EXPECT_GT(std::min(machine.width, machine.height), 150) << machine.name;
        EXPECT_LT(std::max(machine.width, machine.height), 1500) << machine.name;
        EXPECT_GT(machine.speeds.cut, 0) << machine.name;
    }
}

TEST(Machines, AnUnknownNameIsRefusedWithTheList)
{
    const auto machine = find_machine("glowforg");
    ASSERT_FALSE(machine);
    for (const Machine& known : machines()) {
        EXPECT_NE(machine.error().message.find(known.name), std::string::npos) << known.name;
    }
}

TEST(ParseSheet, ReadsMillimetresAndInches)
{
    EXPECT_EQ(parse_sheet("600x400")->width, 600);
    EXPECT_EQ(parse_sheet("600.5X400mm")->width, 600.5);
    EXPECT_NEAR(parse_sheet("24x12in")->height, 304.8, 1e-9);
}

TEST(ParseSheet, RefusesWhatIsNoSheet)
{
    for (const char* text : {"", "x", "600", "600x", "x400", "-600x400", "600x-400", "0x0", "1e9x400", "nanxnan",
                             "infx400", "600x400x3", "600 x 400", "49x400", "600x5001", "60000x400", "600x400cm"}) {
        EXPECT_FALSE(parse_sheet(text)) << text;
    }
}

TEST(Colours, CutsAndEngravingsDiffer)
{
    for (const char* name : {"lightburn", "trotec", "uls", "epilog", "k40", "ponoko", "glowforge", "boxes"}) {
        const auto preset = parse_colours(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_NE(cut_colour(*preset, LayerUse::Engrave), cut_colour(*preset, LayerUse::CutOuter)) << name;
        EXPECT_NE(cut_colour(*preset, LayerUse::Sheet), cut_colour(*preset, LayerUse::CutOuter)) << name;
    }
    EXPECT_FALSE(parse_colours("pink"));
}

} // namespace
} // namespace rhombloom
