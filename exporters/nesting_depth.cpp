#include "exporters/nesting_depth.h"

#include <cmath>
#include <numeric>

namespace rhombloom::nesting {

namespace {

constexpr int cells_across = 96;

} // namespace

DepthField::DepthField(const Polygon& polygon, double rim) : rim_(rim)
{
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 way = polygon[(i + 1) % n] - polygon[i];
        const Vec2 before = polygon[i] - polygon[(i + n - 1) % n];
        const Vec2 along = way.normalized();
        edges_.push_back({polygon[i], along, Vec2(along.y(), -along.x()), way.norm(), cross_2d(before, way) >= 0});
    }
    const Box box = box_of(polygon);
    const Vec2 size = box.max - box.min + Vec2::Constant(2 * rim);
    corner_ = box.min - Vec2::Constant(rim);
    size_ = size.maxCoeff() / cells_across;
    columns_ = static_cast<int>(std::ceil(size.x() / size_));
    rows_ = static_cast<int>(std::ceil(size.y() / size_));
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int j = 0; j < rows_; ++j) {
        for (int i = 0; i < columns_; ++i) {
            fill(cells_[static_cast<std::size_t>(j * columns_ + i)], corner_ + size_ * Vec2(i + 0.5, j + 0.5));
        }
    }
}

void DepthField::fill(Cell& cell, const Vec2& centre)
{
    std::vector<double> distances;
    double least = 1e300;
    for (const Edge& e : edges_) {
        const Vec2 p = centre - e.from;
        distances.push_back((p - std::clamp(p.dot(e.along), 0.0, e.length) * e.along).norm());
        least = std::min(least, distances.back());
    }
    // Any point of the cell is within half a diagonal of its centre, hence this margin between two candidates.
    const double margin = std::sqrt(2.0) * size_ + 1e-9;
    cell.first = static_cast<std::uint32_t>(candidates_.size());
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        if (distances[i] <= least + margin) {
            candidates_.push_back(i);
        }
    }
    cell.last = static_cast<std::uint32_t>(candidates_.size());
    cell.depth = nearest(centre, candidates_.data() + cell.first, candidates_.data() + cell.last).depth;
    if (cell.depth < -(rim_ + margin)) {
        candidates_.resize(cell.first);
        cell.last = cell.first;
    }
}

Depth DepthField::nearest(const Vec2& p, const std::uint32_t* first, const std::uint32_t* last) const
{
    double least = 1e300;
    Depth found{-1e300, Vec2::Zero()};
    for (; first != last; ++first) {
        const Edge& e = edges_[*first];
        const Vec2 from = p - e.from;
        const double t = from.dot(e.along);
        if (t > 0 && t < e.length) {
            const double outside = from.dot(e.normal);
            if (std::abs(outside) < least) {
                least = std::abs(outside);
                found = {-outside, e.normal};
            }
        } else if (t <= 0 && from.norm() < least) {
            // Nearest to a corner: a convex one is seen from outside only, a reflex one from inside.
            least = from.norm();
            const Vec2 away = least > 1e-12 ? Vec2(from / least) : e.normal;
            found = e.convex ? Depth{-least, away} : Depth{least, -away};
        }
    }
    return found;
}

const DepthField::Cell* DepthField::cell_of(const Vec2& p) const
{
    const Vec2 q = (p - corner_) / size_;
    if (!(q.x() >= 0 && q.y() >= 0 && q.x() < columns_ && q.y() < rows_)) {
        return nullptr;
    }
    return &cells_[static_cast<std::size_t>(static_cast<int>(q.y()) * columns_ + static_cast<int>(q.x()))];
}

bool DepthField::far_from(const Vec2& p, double radius) const
{
    if (const Cell* cell = cell_of(p)) {
        return cell->depth < -(rim_ + radius + size_);
    }
    const Vec2 high = corner_ + size_ * Vec2(columns_, rows_);
    return ((p.array() + radius) < corner_.array()).any() || ((p.array() - radius) > high.array()).any();
}

Depth DepthField::at(const Vec2& p) const
{
    const Cell* cell = cell_of(p);
    if (cell == nullptr || cell->first == cell->last) {
        return {-1e300, Vec2::Zero()};
    }
    return nearest(p, candidates_.data() + cell->first, candidates_.data() + cell->last);
}

} // namespace rhombloom::nesting
