#include "exporters/crop.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"

namespace rhombloom {

namespace {

double height_over(const CropLine& line, const Vec2& p)
{
    const Vec2 to = p - line.point;
    return line.direction.x() * to.y() - line.direction.y() * to.x();
}

//! Part [from, to] of a segment, as shares of its length.
struct Part
{
    double from;
    double to;
};

//! Where the segment is, at a share of its length.
Vec2 point_at(const PathVertex& start, const Vec2& end, double share)
{
    const Vec2 chord = end - start.point;
    if (start.bulge == 0) {
        return start.point + share * chord;
    }
    const double sweep = 4 * std::atan(start.bulge);
    // The chord to an intermediate point turns by half the rest of the sweep.
    const double turn = -sweep * (1 - share) / 2;
    const double scale = std::sin(sweep * share / 2) / std::sin(sweep / 2);
    return start.point + scale * Vec2(std::cos(turn) * chord.x() - std::sin(turn) * chord.y(),
                                      std::sin(turn) * chord.x() + std::cos(turn) * chord.y());
}

//! Shares of the segment's length at which it crosses the line.
std::vector<double> crossings(const PathVertex& start, const Vec2& end, const CropLine& line)
{
    const double a = height_over(line, start.point);
    const double b = height_over(line, end);
    if (start.bulge == 0) {
        return (a < 0) != (b < 0) ? std::vector<double>{a / (a - b)} : std::vector<double>{};
    }
    // Height over the line along the arc is offset + radius * cos(angle - up).
    const double sweep = 4 * std::atan(start.bulge);
    const Vec2 chord = end - start.point;
    const Vec2 centre = (start.point + end) / 2 + Vec2(-chord.y(), chord.x()) / (2 * std::tan(sweep / 2));
    const Vec2 radial = start.point - centre;
    const double cosine = -height_over(line, centre) / radial.norm();
    std::vector<double> shares;
    if (std::abs(cosine) < 1) {
        const double up = std::atan2(line.direction.x(), -line.direction.y());
        for (const double sign : {-1.0, 1.0}) {
            const double angle = up + sign * std::acos(cosine) - std::atan2(radial.y(), radial.x());
            const double turned = std::remainder(angle - sweep / 2, two_pi) + sweep / 2;
            if (const double share = turned / sweep; share > 0 && share <= 1) {
                shares.push_back(share);
            }
        }
        std::sort(shares.begin(), shares.end());
    }
    return shares;
}

//! The parts of one segment that lie left of the line.
std::vector<Part> parts_left_of(const PathVertex& start, const Vec2& end, const CropLine& line)
{
    std::vector<double> ends = crossings(start, end, line);
    ends.insert(ends.begin(), 0);
    ends.push_back(1);
    std::vector<Part> parts;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = (ends[i] + ends[i + 1]) / 2;
        if (ends[i + 1] > ends[i] && height_over(line, point_at(start, end, middle)) >= 0) {
            parts.push_back({ends[i], ends[i + 1]});
        }
    }
    return parts;
}

} // namespace

Expected<Path> cropped(const Path& contour, const CropLine& line)
{
    // Chains of kept segments: a new one starts wherever the contour comes back over the line.
    std::vector<std::vector<PathVertex>> chains;
    bool inside = false;
    const std::size_t n = contour.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        const PathVertex& start = contour.vertices[i];
        const Vec2& end = contour.vertices[(i + 1) % n].point;
        const double sweep = 4 * std::atan(start.bulge);
        double reached = 0;
        for (const Part& part : parts_left_of(start, end, line)) {
            if (!inside || part.from > reached) {
                chains.push_back({{point_at(start, end, part.from), 0}});
            }
            chains.back().back().bulge = start.bulge == 0 ? 0 : std::tan(sweep * (part.to - part.from) / 4);
            chains.back().push_back({point_at(start, end, part.to), 0});
            inside = true;
            reached = part.to;
        }
        inside = inside && reached == 1;
    }
    if (chains.size() == 2 && inside) { // the contour's first vertex is inside: both chains are one
        chains[1].pop_back();
        chains[1].insert(chains[1].end(), chains[0].begin(), chains[0].end());
        chains.erase(chains.begin());
    }
    if (chains.size() != 1 || chains[0].size() < 2) {
        return refuse("the cropping line does not cross the contour exactly twice: move it");
    }
    return Path{chains[0], true};
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
