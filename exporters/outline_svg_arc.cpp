// Elliptic arcs: the formulas of SVG 1.1, appendix F.6.
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "exporters/outline_pieces.h"
#include "exporters/outline_svg_path.h"

namespace rhombloom::reading {

namespace {

//! From end points to centre, start angle and sweep.
struct Ellipse
{
    Vec2 centre, radii;
    double rotation = 0, start = 0, sweep = 0;

    Vec2 at(double t) const
    {
        const double x = radii.x() * std::cos(t), y = radii.y() * std::sin(t);
        return centre +
               Vec2(std::cos(rotation) * x - std::sin(rotation) * y, std::sin(rotation) * x + std::cos(rotation) * y);
    }
};

Ellipse ellipse_of(const Vec2& from, const Vec2& to, const SvgArc& arc)
{
    const double c = std::cos(arc.rotation), s = std::sin(arc.rotation);
    const Vec2 half = 0.5 * (from - to);
    const Vec2 p(c * half.x() + s * half.y(), -s * half.x() + c * half.y());
    Vec2 radii(std::abs(arc.rx), std::abs(arc.ry));
    const double excess = p.cwiseQuotient(radii).squaredNorm();
    radii *= std::sqrt(std::max(1.0, excess)); // radii too small for the chord are scaled up
    const double k = std::sqrt(std::max(0.0, 1 / std::min(1.0, excess) - 1)) * (arc.large == arc.sweep ? -1 : 1);
    const Vec2 q = k * Vec2(radii.x() * p.y() / radii.y(), -radii.y() * p.x() / radii.x());
    const Vec2 a = (p - q).cwiseQuotient(radii), b = (-p - q).cwiseQuotient(radii);
    Ellipse e;
    e.centre = Vec2(c * q.x() - s * q.y(), s * q.x() + c * q.y()) + 0.5 * (from + to);
    e.radii = radii;
    e.rotation = arc.rotation;
    e.start = std::atan2(a.y(), a.x());
    e.sweep = std::atan2(b.y(), b.x()) - e.start;
    if (arc.sweep && e.sweep < 0) {
        e.sweep += two_pi;
    } else if (!arc.sweep && e.sweep > 0) {
        e.sweep -= two_pi;
    }
    return e;
}

} // namespace

void add_svg_arc(Path& path, const Vec2& from, const Vec2& to, const SvgArc& arc, Pen& pen)
{
    if (from == to) {
        return;
    }
    if (arc.rx == 0 || arc.ry == 0) {
        path.vertices.push_back({pen.to_mm * to, 0});
        return;
    }
    const Ellipse e = ellipse_of(from, to, arc);
    if (std::abs(e.radii.x() - e.radii.y()) <= 1e-9 * e.radii.x() && pen.to_mm.keeps_circles()) {
        add_arc(path, pen.to_mm * to, pen.to_mm.determinant() < 0 ? -e.sweep : e.sweep);
        return;
    }
    pen.curves = true;
    const double r = e.radii.maxCoeff() * pen.to_mm.scale();
    const double step = 2 * std::acos(std::max(0.0, 1 - curve_tolerance / r));
    const int n = std::clamp(static_cast<int>(std::ceil(std::abs(e.sweep) / step)), 1, 4000);
    for (int i = 1; i <= n; ++i) {
        path.vertices.push_back({pen.to_mm * (i == n ? to : e.at(e.start + e.sweep * i / n)), 0});
    }
}

} // namespace rhombloom::reading
