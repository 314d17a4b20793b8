#include "exporters/bent_element_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rhombloom {

namespace {

using Triangle = std::array<int, 3>;

//! Twice the signed area of a, b, c.
double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 d = b - a;
    const double t = std::clamp((p - a).dot(d) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
    return (p - a - t * d).norm();
}

//! Douglas-Peucker between two kept points: marks in \p keep what must stay.
void simplify(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance,
              std::vector<bool>& keep)
{
    std::size_t far = first;
    double worst = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double d = distance_to_segment(points[i], points[first], points[last % points.size()]);
        if (d > worst) {
            worst = d;
            far = i;
        }
    }
    if (far != first) {
        keep[far] = true;
        simplify(points, first, far, tolerance, keep);
        simplify(points, far, last, tolerance, keep);
    }
}

//! The contour with the fewest points that \p options allow, its long segments divided.
std::vector<Vec2> rim_points(const Path& outline, const FlatSheetOptions& options)
{
    const std::vector<Vec2> fine = flatten(outline, options.tolerance / 5);
    std::vector<bool> keep(fine.size(), false);
    // The two halves are congruent: start them at opposite points, so that their rims are too.
    const std::size_t half = fine.size() / 2;
    keep[0] = keep[half] = true;
    simplify(fine, 0, half, 0.8 * options.tolerance, keep);
    simplify(fine, half, fine.size(), 0.8 * options.tolerance, keep);
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        if (keep[i]) {
            corners.push_back(fine[i]);
        }
    }
    std::vector<Vec2> rim;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2& a = corners[i];
        const Vec2& b = corners[(i + 1) % corners.size()];
        const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / options.rim_step - 1e-9)));
        for (int k = 0; k < pieces; ++k) {
            rim.push_back(a + (b - a) * (static_cast<double>(k) / pieces));
        }
    }
    return rim;
}

bool inside(const std::vector<Vec2>& loop, const Vec2& p)
{
    bool odd = false;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Vec2& a = loop[j];
        const Vec2& b = loop[i];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
            odd = !odd;
        }
    }
    return odd;
}

double distance_to_loop(const std::vector<Vec2>& loop, const Vec2& p)
{
    double best = 1e300;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        best = std::min(best, distance_to_segment(p, loop[j], loop[i]));
    }
    return best;
}

//! A staggered grid that keeps clear of the rim.
std::vector<Vec2> inner_points(const std::vector<Vec2>& rim, const FlatSheetOptions& options)
{
    Box box;
    for (const Vec2& p : rim) {
        box.min = box.min.cwiseMin(p);
        box.max = box.max.cwiseMax(p);
    }
    const Vec2 middle = 0.5 * (box.min + box.max);
    const Vec2 size = box.max - box.min;
    const int columns = static_cast<int>(std::ceil(size.x() / options.along / 2)) + 1;
    const int rows = static_cast<int>(std::ceil(size.y() / options.across / 2)) + 1;
    std::vector<Vec2> points;
    for (int r = -rows; r <= rows; ++r) {
        for (int c = -columns; c <= columns; ++c) {
            const Vec2 p = middle + Vec2((c + (r % 2 != 0 ? 0.5 : 0)) * options.along, r * options.across);
            if (inside(rim, p) && distance_to_loop(rim, p) > 0.45 * options.along) {
                points.push_back(p);
            }
        }
    }
    return points;
}

bool contains(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p)
{
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

bool is_ear(const std::vector<Vec2>& points, const std::vector<int>& loop, std::size_t i)
{
    const int a = loop[(i + loop.size() - 1) % loop.size()];
    const int b = loop[i];
    const int c = loop[(i + 1) % loop.size()];
    if (turn(points[a], points[b], points[c]) <= 1e-9) {
        return false;
    }
    return std::none_of(loop.begin(), loop.end(), [&](int v) {
        return v != a && v != b && v != c && contains(points[a], points[b], points[c], points[v]);
    });
}

//! Ear clipping; the Delaunay flips afterwards do not mind its slivers.
std::vector<Triangle> clip_ears(const std::vector<Vec2>& points, std::size_t rim)
{
    std::vector<int> loop(rim);
    for (std::size_t i = 0; i < rim; ++i) {
        loop[i] = static_cast<int>(i);
    }
    std::vector<Triangle> triangles;
    std::size_t i = 0;
    for (std::size_t idle = 0; loop.size() > 3 && idle <= loop.size(); ++idle, ++i) {
        i %= loop.size();
        if (is_ear(points, loop, i)) {
            triangles.push_back({loop[(i + loop.size() - 1) % loop.size()], loop[i], loop[(i + 1) % loop.size()]});
            loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
            idle = 0;
        }
    }
    expects(loop.size() == 3, "flat_sheet: the outline is simple and counter-clockwise");
    triangles.push_back({loop[0], loop[1], loop[2]});
    return triangles;
}

//! Split the triangle that holds point \p p into three.
void insert_point(const std::vector<Vec2>& points, int p, std::vector<Triangle>& triangles)
{
    const auto holder = std::find_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
        return contains(points[t[0]], points[t[1]], points[t[2]], points[p]);
    });
    expects(holder != triangles.end(), "flat_sheet: inner points lie inside");
    const Triangle t = *holder;
    *holder = {t[0], t[1], p};
    triangles.push_back({t[1], t[2], p});
    triangles.push_back({t[2], t[0], p});
}

double in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 ad = a - d;
    const Vec2 bd = b - d;
    const Vec2 cd = c - d;
    return ad.squaredNorm() * (bd.x() * cd.y() - bd.y() * cd.x()) -
           bd.squaredNorm() * (ad.x() * cd.y() - ad.y() * cd.x()) +
           cd.squaredNorm() * (ad.x() * bd.y() - ad.y() * bd.x());
}

//! Where an edge stands: the triangle and its corner opposite.
struct EdgeUse
{
    int triangle;
    int corner;
};

//! Flip the edge between two triangles when that makes them Delaunay; true when flipped.
bool flip(const std::vector<Vec2>& points, std::vector<Triangle>& triangles, EdgeUse one, EdgeUse two)
{
    Triangle& s = triangles[one.triangle];
    Triangle& t = triangles[two.triangle];
    const int apex = s[one.corner];
    const int a = s[(one.corner + 1) % 3];
    const int b = s[(one.corner + 2) % 3];
    const int far = t[two.corner];
    const double scale = std::pow((points[a] - points[b]).squaredNorm(), 2);
    const bool convex =
        turn(points[apex], points[a], points[far]) > 1e-9 && turn(points[apex], points[far], points[b]) > 1e-9;
    const bool sliver =
        turn(points[apex], points[a], points[b]) <= 1e-9 || turn(points[a], points[far], points[b]) <= 1e-9;
    if (!convex || (!sliver && in_circle(points[apex], points[a], points[b], points[far]) <= 1e-9 * scale)) {
        return false;
    }
    s = {apex, a, far};
    t = {apex, far, b};
    return true;
}

//! One round of flips, each triangle at most once; how many were made.
int flip_round(const std::vector<Vec2>& points, std::vector<Triangle>& triangles)
{
    std::map<std::pair<int, int>, EdgeUse> uses;
    std::vector<bool> touched(triangles.size(), false);
    int flips = 0;
    for (int f = 0; f < static_cast<int>(triangles.size()); ++f) {
        for (int k = 0; k < 3; ++k) {
            uses[{triangles[f][(k + 1) % 3], triangles[f][(k + 2) % 3]}] = {f, k};
        }
    }
    for (const auto& [edge, use] : uses) {
        const auto other = uses.find({edge.second, edge.first});
        if (edge.first < edge.second && other != uses.end() && !touched[use.triangle] &&
            !touched[other->second.triangle] && flip(points, triangles, use, other->second)) {
            touched[use.triangle] = touched[other->second.triangle] = true;
            ++flips;
        }
    }
    return flips;
}

void make_delaunay(const std::vector<Vec2>& points, std::vector<Triangle>& triangles)
{
    for (int round = 0; round < 200 && flip_round(points, triangles) > 0; ++round) {
    }
}

} // namespace

FlatSheetOptions sheet_options(const Element& element)
{
    const FlatSheetOptions usual;
    const double share = element.la / 80;
    return {share * usual.tolerance, share * usual.rim_step, share * usual.along, share * usual.across};
}

FlatSheet flat_sheet(const Path& outline, const FlatSheetOptions& options)
{
    FlatSheet sheet;
    sheet.points = rim_points(outline, options);
    sheet.rim = sheet.points.size();
    const std::vector<Vec2> inner = inner_points(sheet.points, options);
    sheet.triangles = clip_ears(sheet.points, sheet.rim);
    for (const Vec2& p : inner) {
        sheet.points.push_back(p);
        insert_point(sheet.points, static_cast<int>(sheet.points.size()) - 1, sheet.triangles);
        make_delaunay(sheet.points, sheet.triangles);
    }
    make_delaunay(sheet.points, sheet.triangles);
    return sheet;
}

double rim_length(const FlatSheet& sheet)
{
    double sum = 0;
    for (std::size_t i = 0; i < sheet.rim; ++i) {
        sum += (sheet.points[(i + 1) % sheet.rim] - sheet.points[i]).norm();
    }
    return sum;
}

} // namespace rhombloom
