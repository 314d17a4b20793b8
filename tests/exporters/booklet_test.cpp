#include "exporters/booklet.h"

#include <gtest/gtest.h>

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

TEST(Booklet, RefusesCharactersThatItsFontLacks)
{
    BookletOptions options;
    options.title = "\u30E9\u30F3\u30D7";
    const auto refused = booklet(replays::single("rhombic-6"), options);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("U+30E9"), std::string::npos) << refused.error().message;
}

TEST(Booklet, SetsLatinGreekAndCyrillicTitles)
{
    BookletOptions options;
    options.title = "L\u00E1mpara \u039B\u03AC\u03BC\u03C0\u03B1 \u041B\u0430\u043C\u043F\u0430";
    EXPECT_TRUE(booklet(replays::single("rhombic-6"), options).has_value());
}

} // namespace rhombloom
