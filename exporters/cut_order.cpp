#include "exporters/cut_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rhombloom {

namespace {

using Order = std::vector<std::size_t>;

bool boxes_within(const Box& a, const Box& b, double reach)
{
    return (a.min.array() - reach <= b.max.array()).all() && (b.min.array() - reach <= a.max.array()).all();
}

//! Costs of going from one stop to the next; stop n is home, where the way begins but does not end.
class Costs
{
public:
    Costs(const std::vector<Vec2>& starts, const Neighbours& beside, const Vec2& home)
        : starts_(starts), beside_(beside), home_(home)
    {
        Box box;
        for (const Vec2& p : starts) {
            box.min = box.min.cwiseMin(p);
            box.max = box.max.cwiseMax(p);
        }
        detour_ = starts.empty() ? 0 : 2 * (box.max - box.min).norm();
    }
    double first(std::size_t to) const { return (starts_[to] - home_).norm(); }
    double step(std::size_t from, std::size_t to) const
    {
        return (starts_[from] - starts_[to]).norm() + (beside_[from][to] ? detour_ : 0);
    }
    //! The step into position i of the order, 0 behind its end.
    double into(const Order& order, std::size_t i) const
    {
        if (i >= order.size()) {
            return 0;
        }
        return i == 0 ? first(order[0]) : step(order[i - 1], order[i]);
    }

private:
    const std::vector<Vec2>& starts_;
    const Neighbours& beside_;
    Vec2 home_;
    double detour_ = 0;
};

Order nearest_next(const Costs& costs, std::size_t count)
{
    Order order;
    std::vector<bool> used(count, false);
    while (order.size() < count) {
        std::size_t best = count;
        double least = 1e300;
        for (std::size_t i = 0; i < count; ++i) {
            const double cost = used[i] ? 1e300 : order.empty() ? costs.first(i) : costs.step(order.back(), i);
            if (cost < least) {
                least = cost;
                best = i;
            }
        }
        used[best] = true;
        order.push_back(best);
    }
    return order;
}

//! What reversing positions i..j would save.
double reversal_gain(const Costs& costs, const Order& order, std::size_t i, std::size_t j)
{
    const double before = costs.into(order, i) + costs.into(order, j + 1);
    const double head = i == 0 ? costs.first(order[j]) : costs.step(order[i - 1], order[j]);
    const double tail = j + 1 == order.size() ? 0 : costs.step(order[i], order[j + 1]);
    return before - head - tail;
}

bool reverse_stretches(const Costs& costs, Order& order)
{
    bool improved = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            if (reversal_gain(costs, order, i, j) > 1e-9) {
                std::reverse(order.begin() + static_cast<long>(i), order.begin() + static_cast<long>(j) + 1);
                improved = true;
            }
        }
    }
    return improved;
}

double total(const Costs& costs, const Order& order)
{
    double sum = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        sum += costs.into(order, i);
    }
    return sum;
}

//! Move one stop elsewhere when that shortens the way.
bool move_stops(const Costs& costs, Order& order)
{
    bool improved = false;
    for (std::size_t from = 0; from < order.size(); ++from) {
        const std::size_t stop = order[from];
        Order rest = order;
        rest.erase(rest.begin() + static_cast<long>(from));
        const double now = total(costs, order) - total(costs, rest);
        double least = now - 1e-9;
        std::size_t best = order.size();
        for (std::size_t to = 0; to <= rest.size(); ++to) {
            const double head = to == 0 ? costs.first(stop) : costs.step(rest[to - 1], stop);
            const double tail = to == rest.size() ? 0 : costs.step(stop, rest[to]);
            if (const double added = head + tail - costs.into(rest, to); added < least) {
                least = added;
                best = to;
            }
        }
        if (best < order.size()) {
            rest.insert(rest.begin() + static_cast<long>(best), stop);
            order = rest;
            improved = true;
        }
    }
    return improved;
}

} // namespace

double gap(const std::vector<Vec2>& points, const std::vector<Vec2>& polygon)
{
    double least = 1e300;
    for (const Vec2& p : points) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2& from = polygon[i];
            const Vec2 along = polygon[(i + 1) % polygon.size()] - from;
            const double t = std::clamp((p - from).dot(along) / std::max(along.squaredNorm(), 1e-30), 0.0, 1.0);
            least = std::min(least, (p - from - t * along).squaredNorm());
        }
    }
    return std::sqrt(least);
}

Neighbours neighbours(const std::vector<Path>& pieces, double reach)
{
    std::vector<std::vector<Vec2>> polygons;
    std::vector<Box> boxes;
    for (const Path& piece : pieces) {
        polygons.push_back(flatten(piece, 0.5));
        boxes.push_back(bounds(piece));
    }
    Neighbours result(pieces.size(), std::vector<bool>(pieces.size(), false));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const bool near = boxes_within(boxes[i], boxes[j], reach) &&
                              std::min(gap(polygons[i], polygons[j]), gap(polygons[j], polygons[i])) <= reach;
            result[i][j] = result[j][i] = near;
        }
    }
    return result;
}

std::vector<std::size_t> cutting_order(const std::vector<Vec2>& starts, const Neighbours& beside, const Vec2& home)
{
    const Costs costs(starts, beside, home);
    Order order = nearest_next(costs, starts.size());
    for (int round = 0; round < 50; ++round) {
        const bool reversed = reverse_stretches(costs, order);
        const bool moved = move_stops(costs, order);
        if (!reversed && !moved) {
            break;
        }
    }
    return order;
}

} // namespace rhombloom
