#include "exporters/bulb_clearance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/design/overlap.h"
#include "core/text.h"

namespace rhombloom {

namespace {

using Triangle = std::array<Vec3, 3>;

double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 ab = b - a;
    const double square = ab.squaredNorm();
    const double t = square > 0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0;
    return (p - a - t * ab).norm();
}

//! Of two segments: at inner points of both where their common normal meets both, else at an end of one.
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    const double at_ends = std::min({point_segment_distance(a, c, d), point_segment_distance(b, c, d),
                                     point_segment_distance(c, a, b), point_segment_distance(d, a, b)});
    const Vec3 u = b - a;
    const Vec3 v = d - c;
    const Vec3 w = c - a;
    const double det = u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v);
    if (det <= 1e-12 * u.squaredNorm() * v.squaredNorm()) {
        return at_ends; // parallel
    }
    const double s = (w.dot(u) * v.squaredNorm() - w.dot(v) * u.dot(v)) / det;
    const double t = (w.dot(u) * u.dot(v) - w.dot(v) * u.squaredNorm()) / det;
    return s >= 0 && s <= 1 && t >= 0 && t <= 1 ? std::min(at_ends, (w + t * v - s * u).norm()) : at_ends;
}

//! Whether the foot of \p p in the triangle's plane lies inside the triangle.
bool foot_inside(const Vec3& p, const Triangle& t, const Vec3& normal)
{
    for (int i = 0; i < 3; ++i) {
        if (normal.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) < 0) {
            return false;
        }
    }
    return true;
}

double distance_to_inside(const Vec3& a, const Vec3& b, const Triangle& t)
{
    const Vec3 cross = (t[1] - t[0]).cross(t[2] - t[0]);
    if (cross.norm() < 1e-12) {
        return 1e300;
    }
    const Vec3 normal = cross.normalized();
    const double at_a = normal.dot(a - t[0]);
    const double at_b = normal.dot(b - t[0]);
    if (at_a * at_b < 0 && foot_inside(a + (b - a) * (at_a / (at_a - at_b)), t, normal)) {
        return 0;
    }
    return std::min(foot_inside(a, t, normal) ? std::abs(at_a) : 1e300,
                    foot_inside(b, t, normal) ? std::abs(at_b) : 1e300);
}

} // namespace

const std::vector<Bulb>& common_bulbs()
{
    static const std::vector<Bulb> bulbs = {
        {"A60", 60, 110}, {"G95", 95, 138}, {"G125", 125, 175}, {"C35", 35, 100}, {"P45", 45, 78}};
    return bulbs;
}

double segment_triangle_distance(const Vec3& a, const Vec3& b, const Triangle& triangle)
{
    double nearest = distance_to_inside(a, b, triangle);
    for (int i = 0; i < 3; ++i) {
        nearest = std::min(nearest, segment_distance(a, b, triangle[i], triangle[(i + 1) % 3]));
    }
    return nearest;
}

double bulb_clearance(const Surface& surface, const Bulb& bulb, const BulbPose& pose)
{
    expects(bulb.diameter > 0 && bulb.length >= bulb.diameter, "bulb_clearance: a bulb at least as long as wide");
    expects(std::abs(pose.direction.norm() - 1) < 1e-9, "bulb_clearance: direction is a unit vector");
    const double radius = bulb.diameter / 2;
    const Vec3 a = pose.base + radius * pose.direction;
    const Vec3 b = pose.base + (bulb.length - radius) * pose.direction;
    double nearest = 1e300;
    for (const Face f : surface.faces()) {
        std::array<Vec3, 4> p;
        const Quad corners = quad(surface, f);
        for (int i = 0; i < 4; ++i) {
            p[i] = surface.point(Vertex(corners[i]));
        }
        for (int i = 0; i < 4; ++i) {
            nearest = std::min(nearest, segment_triangle_distance(a, b, {p[i], p[(i + 1) % 4], p[(i + 2) % 4]}));
        }
    }
    return nearest - radius;
}

std::vector<BulbFit> bulbs_in_middle(const Surface& surface)
{
    Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
    for (const Vertex v : surface.vertices()) {
        low = low.cwiseMin(surface.point(v));
        high = high.cwiseMax(surface.point(v));
    }
    const Vec3 middle = 0.5 * (low + high);
    std::vector<BulbFit> fits;
    if (surface.n_faces() == 0 || winding_number(surface, middle) < 0.5) {
        return fits;
    }
    for (const Bulb& bulb : common_bulbs()) {
        const BulbPose pose{middle + Vec3(0, 0, 0.5 * bulb.length)};
        fits.push_back({bulb, bulb_clearance(surface, bulb, pose)});
    }
    return fits;
}

std::string bulbs_text(const std::vector<BulbFit>& fits)
{
    std::string fit, tight;
    for (const BulbFit& f : fits) {
        std::string& list = f.clearance >= least_bulb_clearance ? fit : tight;
        list += (list.empty() ? "" : ", ") + f.bulb.name + " (" +
                (f.clearance > 0 ? to_fixed(std::floor(f.clearance), 0) + " mm" : "touches") + ")";
    }
    return (fit.empty() ? "" : "Bulbs that have room in its middle: " + fit + ". ") +
           (tight.empty() ? "" : "Too close to the elements there: " + tight + ". ");
}

} // namespace rhombloom
