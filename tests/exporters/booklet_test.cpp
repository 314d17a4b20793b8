#include "exporters/booklet.h"

#include <gtest/gtest.h>

#include "exporters/booklet_layout.h"
#include "tests/core/building/replays.h"

namespace rhombloom {

namespace {

Expected<BookletFiles> booklet(const Replay& replay, const BookletOptions& options = {})
{
    const Design design;
    return booklet_files(design, replay, assembly_plan(replay, design.element, Order::Best), options);
}

} // namespace

TEST(Booklet, HasTheSameBytesTwice)
{
    const Replay replay = replays::chain("ball-30", 2);
    EXPECT_EQ(booklet(replay)->files, booklet(replay)->files);
}

// Also when the last page is not full, and with fewer steps than cells.
TEST(Booklet, GivesEachStepACellOfItsOwnOnEveryGrid)
{
    for (const char* name : {"sheet-1x1", "sheet-1x2", "sheet-1x5", "sheet-1x7", "sheet-2x4", "sheet-3x3"}) {
        const Replay replay = replays::single(name);
        const AssemblyPlan plan = assembly_plan(replay, Element{}, Order::Best);
        for (const int grid : {0, 1, 2, 4, 6}) {
            BookletOptions options;
            options.steps_per_page = grid;
            const BookletLayout layout = booklet_layout(replay, plan, options);
            ASSERT_EQ(layout.places.size(), replay.surface.n_faces()) << name;
            for (std::size_t k = 0; k < layout.places.size(); ++k) {
                const int cells = layout.chapters[0].rows * layout.chapters[0].columns;
                EXPECT_TRUE(grid == 0 || cells == grid) << name << grid;
                EXPECT_EQ(layout.places[k].cell, static_cast<int>(k) % cells) << name << grid;
                EXPECT_EQ(layout.places[k].page, front_pages + 2 + static_cast<int>(k) / cells) << name << grid;
            }
            EXPECT_EQ(layout.last_page, layout.places.back().page + 1);
        }
    }
}

// Thin elements, wide cells: what the circle shows is larger than in the figure, never smaller.
TEST(Booklet, MagnifiesInEveryDetail)
{
    for (const char* name : {"sheet-1x2", "ball-90", "dome-5x3"}) {
        const Replay replay = replays::single(name);
        for (const int grid : {0, 1, 6}) {
            BookletOptions options;
            options.steps_per_page = grid;
            for (const StepPlace& place :
                 booklet_layout(replay, assembly_plan(replay, Element{}, Order::Best), options).places) {
                EXPECT_TRUE(!place.inset || place.inset->camera.scale > 1.39 * place.camera.scale) << name << grid;
            }
        }
    }
}

TEST(Booklet, IsMadeAlsoWhenAPurposeCannotBeWritten)
{
    Design design;
    design.operations = {Place{"body", "ball-30"}, Open{"body", {}, "\u96FB\u7403"}};
    const Replay replay = replays::opened(replays::single("ball-30"), 7);
    const AssemblyPlan plan = assembly_plan(replay, design.element, Order::Best);
    EXPECT_TRUE(booklet_files(design, replay, plan).has_value());
}

TEST(Booklet, RefusesCharactersThatItsFontLacks)
{
    BookletOptions options;
    options.title = "\u30E9\u30F3\u30D7";
    const auto refused = booklet(replays::single("rhombic-6"), options);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("U+30E9"), std::string::npos) << refused.error().message;
}

// Asked before the design is replayed.
TEST(Booklet, RefusesNamesInScriptsItCannotWrite)
{
    Design design;
    design.operations = {Place{"body", "ball-30"}};
    EXPECT_TRUE(check_booklet_names(design).has_value());
    for (const char* title : {"\u30E9\u30F3\u30D7", "Lamp \U0001F430", "\u05DE\u05E0", "\u0645\u0635", "two\nlines"}) {
        design.title = title;
        EXPECT_FALSE(check_booklet_names(design).has_value()) << title;
    }
    design.title = "Lamp";
    design.operations.push_back(Place{"\u5934", "ball-30"});
    const auto refused = check_booklet_names(design);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("$.operations[1].id has the character U+5934"), std::string::npos);
}

TEST(Booklet, SetsLatinGreekAndCyrillicTitles)
{
    BookletOptions options;
    options.title = "L\u00E1mpara \u039B\u03AC\u03BC\u03C0\u03B1 \u041B\u0430\u043C\u043F\u0430";
    EXPECT_TRUE(booklet(replays::single("rhombic-6"), options).has_value());
}

} // namespace rhombloom
