#include "exporters/materials.h"

#include <fstream>

#include <gtest/gtest.h>

namespace rhombloom {

TEST(Materials, AllPresetsHaveWhatTheKitStates)
{
    const auto list = materials();
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_GE(list->size(), 6u);
    for (const Material& m : *list) {
        EXPECT_TRUE(m.thickness >= 0.2 && m.thickness <= 0.8) << m.name;
        EXPECT_TRUE(m.density > 0.3 && m.density < 2) << m.name;
        EXPECT_TRUE(m.strain_limit >= 0.005 && m.strain_limit <= 0.05) << m.name;
        EXPECT_TRUE(m.finger_strain_limit >= m.strain_limit && m.finger_strain_limit <= 0.05) << m.name;
        EXPECT_FALSE(m.title.empty() || m.heat.empty()) << m.name;
        EXPECT_FALSE(m.laser.empty() && m.knife.empty()) << m.name;
    }
}

TEST(Materials, DefaultPieceOfPolypropyleneWeighsThreeGrams)
{
    EXPECT_NEAR(mass(*material("pp-0.5"), 6520), 2.95, 0.01);
}

TEST(Materials, AnUnknownNameIsRefusedWithTheKnownOnes)
{
    const auto refused = material("pp");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("\"pp\" is unknown"), std::string::npos);
    EXPECT_NE(refused.error().message.find("veneer-0.5"), std::string::npos);
}

TEST(Materials, AMissingOrBrokenFileIsRefusedWithItsPath)
{
    const std::string path = testing::TempDir() + "materials_broken.json";
    EXPECT_NE(materials(path + ".none").error().message.find(path), std::string::npos);
    std::ofstream(path) << R"({"materials": [{"name": 5}]})";
    EXPECT_NE(materials(path).error().message.find(path), std::string::npos);
}

} // namespace rhombloom
