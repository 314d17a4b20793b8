#include "exporters/crop.h"

#include <algorithm>
#include <vector>

#include "exporters/segment.h"

namespace rhombloom {

namespace {

using Chain = std::vector<Segment>;

double height_over(const CropLine& line, const Vec2& p)
{
    const Vec2 to = p - line.point;
    return line.direction.x() * to.y() - line.direction.y() * to.x();
}

//! As much of the line as passes the contour.
Segment across(const Path& contour, const CropLine& line)
{
    const Box box = bounds(contour);
    const double reach = (box.max - box.min).norm() + (line.point - box.min).norm();
    return {line.point - reach * line.direction, line.point + reach * line.direction, 0};
}

//! The parts of one segment that lie left of the line.
Chain parts_left_of(const Segment& segment, const CropLine& line, const Segment& cut)
{
    std::vector<double> ends = {0, 1};
    for (const auto& [here, there] : crossings(segment, cut)) {
        ends.push_back(std::clamp(here, 0.0, 1.0));
    }
    std::sort(ends.begin(), ends.end());
    Chain parts;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const bool left = height_over(line, point(segment, (ends[i] + ends[i + 1]) / 2)) >= 0;
        if (left && ends[i + 1] - ends[i] > 1e-9) {
            parts.push_back(part(segment, ends[i], ends[i + 1]));
        }
    }
    return parts;
}

bool joined(const Chain& chain, const Segment& next)
{
    return (chain.back().b - next.a).norm() < 1e-6;
}

//! Kept segments, a new chain wherever the contour comes back over the line.
std::vector<Chain> kept_chains(const Path& contour, const CropLine& line)
{
    const Segment cut = across(contour, line);
    std::vector<Chain> chains;
    for (const Segment& segment : segments(contour)) {
        for (const Segment& kept : parts_left_of(segment, line, cut)) {
            if (chains.empty() || !joined(chains.back(), kept)) {
                chains.emplace_back();
            }
            chains.back().push_back(kept);
        }
    }
    if (chains.size() > 1 && joined(chains.back(), chains.front().front())) { // across the contour's first vertex
        chains.back().insert(chains.back().end(), chains.front().begin(), chains.front().end());
        chains.erase(chains.begin());
    }
    return chains;
}

} // namespace

Expected<Path> cropped(const Path& contour, const CropLine& line)
{
    const std::vector<Chain> chains = kept_chains(contour, line);
    if (chains.size() != 1 || joined(chains[0], chains[0].front())) {
        return refuse("the cropping line does not cross the contour exactly twice: move it");
    }
    Chain closed = chains[0];
    closed.push_back({closed.back().b, closed.front().a, 0});
    return closed_path(closed);
}

Path notched(const Path& contour, int count, double width)
{
    Path result = contour;
    const Vec2 from = contour.vertices.back().point;
    const Vec2 edge = contour.vertices.front().point - from;
    const Vec2 along = edge.normalized();
    const Vec2 inward(-along.y(), along.x());
    for (int i = 0; i < count; ++i) {
        const Vec2 middle = from + edge / 2 + along * (2 * width * (i - (count - 1) / 2.0));
        result.vertices.push_back({middle - along * width / 2, 0});
        result.vertices.push_back({middle + inward * width * 0.75, 0});
        result.vertices.push_back({middle + along * width / 2, 0});
    }
    return result;
}

} // namespace rhombloom
