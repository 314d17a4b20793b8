#include "exporters/words.h"

#include <gtest/gtest.h>

namespace rhombloom {

TEST(Words, MinutesBecomeHoursFromNinetyOn)
{
    EXPECT_EQ(duration(0.4, 1), "about 1 minute");
    EXPECT_EQ(duration(12.2, 1), "about 13 minutes");
    EXPECT_EQ(duration(12.2, 5), "about 15 minutes");
    EXPECT_EQ(duration(96, 1), "about 1.5 hours");
    EXPECT_EQ(duration(2022, 5), "about 34 hours");
}

} // namespace rhombloom
