#include "exporters/mesh_reader.h"

#include <bit>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

std::string little_endian(std::uint32_t value, int bytes = 4)
{
    std::string text;
    for (int k = 0; k < bytes; ++k) {
        text.push_back(static_cast<char>(value >> 8 * k & 0xFF));
    }
    return text;
}

//! A GLB of one triangle whose points are normalised shorts, under \p node.
std::string quantised_glb(const std::string& node)
{
    std::string binary;
    for (const int value : {0, 0, 0, 32767, 0, 0, 0, -32767, 0}) {
        binary += little_endian(static_cast<std::uint16_t>(value), 2);
    }
    binary += std::string(2, '\0');
    std::string json =
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0)" + node +
        R"(}],"scenes":[{"nodes":[0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("buffers":[{"byteLength":20}],"bufferViews":[{"buffer":0,"byteLength":18}],)"
        R"("accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"}]})";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto chunk = [](const std::string& kind, const std::string& bytes) {
        return little_endian(static_cast<std::uint32_t>(bytes.size())) + kind + bytes;
    };
    const std::string chunks = chunk("JSON", json) + chunk(std::string("BIN\0", 4), binary);
    return "glTF" + little_endian(2) + little_endian(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

TEST(MeshReader, JoinsLinesOfAnObjThatEndInABackslash)
{
    const auto file = read_mesh("a.obj", "# from C:\\\nv 0 0 \\\n 0\nv 1 0 0\r\nv 0 1 \\\r\n0\nf 1 \\\n 2 \\\n 3\n");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->mesh.points.size(), 3U);
    EXPECT_EQ(file->mesh.triangles.size(), 1U);
}

TEST(MeshReader, LinesOfAnObjKeepTheirNumbersWhenTheyAreJoined)
{
    const auto file = read_mesh("a.obj", "v 0 0 \\\n 0\nv 1 0\n");
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("line 3 "), std::string::npos) << file.error().message;
}

TEST(MeshReader, TakesAnIndentedStlInCapitals)
{
    const auto file = read_mesh("a.STL", "  SOLID my part\r\nFACET NORMAL 0 0 0\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\n"
                                         "VERTEX 1 0 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\n");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->mesh.triangles.size(), 1U);
}

TEST(MeshReader, TakesABinaryStlThatBeginsWithSolidAndHasBytesLeftOver)
{
    std::string bytes = "solid by a program";
    bytes.resize(80, ' ');
    bytes += little_endian(1) + std::string(12, '\0');
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
        bytes += little_endian(std::bit_cast<std::uint32_t>(x));
    }
    const auto file = read_mesh("a.stl", bytes + std::string(2 + 10, '\0'));
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->mesh.triangles.size(), 1U);
}

TEST(MeshReader, TakesTheShortIntegersOfAQuantisedGlb)
{
    const auto file = read_mesh("a.glb", quantised_glb(R"(,"scale":[2,2,2])"));
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->mesh.points.size(), 3U);
    EXPECT_LT((file->mesh.points[1] - Vec3(2, 0, 0)).norm(), 1e-9);
    EXPECT_LT((file->mesh.points[2] - Vec3(0, 0, -2)).norm(), 1e-9); // y is up in glTF
}

TEST(MeshReader, RefusesAGlbWhoseCopiesItWouldNotSee)
{
    const auto file = read_mesh("a.glb", quantised_glb(R"(,"extensions":{"EXT_mesh_gpu_instancing":{}})"));
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("EXT_mesh_gpu_instancing"), std::string::npos);
}

} // namespace
} // namespace rhombloom
