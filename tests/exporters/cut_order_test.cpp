#include "exporters/cut_order.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

Path square(double x, double y, double size)
{
    return {{{Vec2(x, y), 0}, {Vec2(x + size, y), 0}, {Vec2(x + size, y + size), 0}, {Vec2(x, y + size), 0}}, true};
}

std::vector<Path> grid(int columns, int rows)
{
    std::vector<Path> pieces;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            pieces.push_back(square(12 * x, 12 * y, 10));
        }
    }
    return pieces;
}

std::vector<Vec2> starts(const std::vector<Path>& pieces)
{
    std::vector<Vec2> points;
    for (const Path& piece : pieces) {
        points.push_back(piece.vertices.front().point);
    }
    return points;
}

double travel(const std::vector<Vec2>& points, const std::vector<std::size_t>& order)
{
    double sum = points[order[0]].norm();
    for (std::size_t i = 1; i < order.size(); ++i) {
        sum += (points[order[i]] - points[order[i - 1]]).norm();
    }
    return sum;
}

TEST(Neighbours, AreThePiecesWithinReach)
{
    const Neighbours beside = neighbours(grid(3, 3), 3);
    EXPECT_TRUE(beside[0][1]);
    EXPECT_TRUE(beside[4][1]);
    EXPECT_FALSE(beside[0][2]);
    EXPECT_TRUE(beside[0][4]); // corner to corner: 2.8 mm
    EXPECT_FALSE(beside[0][0]);
}

TEST(CuttingOrder, VisitsEveryPieceOnce)
{
    const auto pieces = grid(7, 5);
    auto order = cutting_order(starts(pieces), neighbours(pieces, 3), Vec2::Zero());
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> all(pieces.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(order, all);
}

TEST(CuttingOrder, NoPieceFollowsItsNeighbour)
{
    const auto pieces = grid(7, 5);
    const Neighbours beside = neighbours(pieces, 3);
    const auto order = cutting_order(starts(pieces), beside, Vec2::Zero());
    for (std::size_t i = 1; i < order.size(); ++i) {
        EXPECT_FALSE(beside[order[i - 1]][order[i]]) << i;
    }
}

TEST(CuttingOrder, TravelIsNotMuchLongerThanTheShortestStepsThatSkipNeighbours)
{
    const auto pieces = grid(8, 6);
    const auto points = starts(pieces);
    const auto order = cutting_order(points, neighbours(pieces, 3), Vec2::Zero());
    EXPECT_LT(travel(points, order), 1.15 * 24 * static_cast<double>(pieces.size())); // 24: two columns on
}

TEST(CuttingOrder, IsTheShortestWayWhenNothingWarps)
{
    const auto pieces = grid(6, 4);
    const auto points = starts(pieces);
    const Neighbours none(pieces.size(), std::vector<bool>(pieces.size(), false));
    EXPECT_LT(travel(points, cutting_order(points, none, Vec2::Zero())), 1.1 * 12 * 23);
}

TEST(CuttingOrder, OfNothingIsNothing)
{
    EXPECT_TRUE(cutting_order({}, {}, Vec2::Zero()).empty());
}

} // namespace
} // namespace rhombloom
