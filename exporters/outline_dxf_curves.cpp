#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "exporters/outline_dxf_entity.h"

namespace rhombloom::reading {

namespace {

//! A rational B-spline.
struct Spline
{
    int degree = 3;
    std::vector<double> knots;
    std::vector<Eigen::Vector3d> poles; //!< x w, y w, w
};

//! De Boor's algorithm; \p span is the index of the knot at or before \p t.
Vec2 at(const Spline& spline, std::size_t span, double t)
{
    const auto p = static_cast<std::size_t>(spline.degree);
    std::vector<Eigen::Vector3d> d(p + 1);
    for (std::size_t j = 0; j <= p; ++j) {
        d[j] = spline.poles[span - p + j];
    }
    for (std::size_t r = 1; r <= p; ++r) {
        for (std::size_t j = p; j >= r; --j) {
            const double low = spline.knots[j + span - p], high = spline.knots[j + 1 + span - r];
            const double f = high > low ? (t - low) / (high - low) : 0;
            d[j] = (1 - f) * d[j - 1] + f * d[j];
        }
    }
    return d[p].head<2>() / d[p].z();
}

//! Halves the stretch until its chords are near enough; the end is added, the start is not.
template <class Curve>
void add_chords(Path& path, const Curve& curve, double from, double to, double tolerance, int depth)
{
    const Vec2 a = curve(from), b = curve(to), middle = curve(0.5 * (from + to));
    // Three places, since an S may cross its chord in the middle.
    double worst = (middle - 0.5 * (a + b)).norm();
    for (const double f : {0.25, 0.75}) {
        worst = std::max(worst, (curve(from + f * (to - from)) - (a + f * (b - a))).norm());
    }
    if (depth > 0 && worst > tolerance) {
        add_chords(path, curve, from, 0.5 * (from + to), tolerance, depth - 1);
        add_chords(path, curve, 0.5 * (from + to), to, tolerance, depth - 1);
        return;
    }
    path.vertices.push_back({b, 0});
}

constexpr int most_halvings = 12;

Expected<Spline> spline_of(const DxfEntity& entity)
{
    Spline spline;
    std::vector<double> weights;
    for (const DxfGroup& g : entity.groups) {
        if (g.code == 40) {
            spline.knots.push_back(dxf_number(g));
        } else if (g.code == 41) {
            weights.push_back(dxf_number(g));
        } else if (g.code == 10) {
            spline.poles.emplace_back(dxf_number(g), 0, 1);
        } else if (g.code == 20 && !spline.poles.empty()) {
            spline.poles.back().y() = dxf_number(g);
        }
    }
    const double degree = dxf_value(entity, 71, 3);
    spline.degree = degree >= 1 && degree <= 20 ? static_cast<int>(degree) : 0;
    const std::size_t order = static_cast<std::size_t>(spline.degree) + 1;
    if (spline.poles.empty()) {
        return refuse("the DXF holds a SPLINE without control points; convert it to polylines or arcs");
    }
    if (spline.degree == 0 || spline.poles.size() < order || spline.knots.size() != spline.poles.size() + order ||
        !std::is_sorted(spline.knots.begin(), spline.knots.end())) {
        return refuse("the DXF holds a SPLINE whose degree, knots and control points do not agree");
    }
    for (std::size_t i = 0; i < spline.poles.size() && weights.size() == spline.poles.size(); ++i) {
        spline.poles[i] *= weights[i];
        spline.poles[i].z() = weights[i];
    }
    return spline;
}

} // namespace

Expected<Path> dxf_ellipse(const DxfEntity& entity, double tolerance)
{
    const Vec2 centre = dxf_point(entity, 10), major = dxf_point(entity, 11);
    const double ratio = dxf_value(entity, 40, 1) * (dxf_value(entity, 230, 1) < 0 ? -1 : 1);
    const Vec2 minor = ratio * Vec2(-major.y(), major.x());
    const double start = dxf_value(entity, 41, 0), end = dxf_value(entity, 42, two_pi);
    if (!std::isfinite(start) || !std::isfinite(end) || !centre.allFinite() || !major.allFinite() ||
        !std::isfinite(ratio) || std::abs(start) > 1e6 || std::abs(end) > 1e6) {
        return refuse("the DXF holds an ELLIPSE with a number that is none");
    }
    double sweep = std::fmod(end - start, two_pi);
    sweep += sweep < 1e-9 ? two_pi : 0;
    const auto curve = [&](double t) { return Vec2(centre + std::cos(t) * major + std::sin(t) * minor); };
    Path path{{{curve(start), 0}}, false, {}};
    for (int quarter = 0; quarter < 4; ++quarter) {
        add_chords(path, curve, start + sweep * quarter / 4, start + sweep * (quarter + 1) / 4, tolerance,
                   most_halvings);
    }
    return path;
}

Expected<Path> dxf_spline(const DxfEntity& entity, double tolerance)
{
    const auto spline = spline_of(entity);
    if (!spline) {
        return tl::make_unexpected(spline.error());
    }
    Path path{{}, false, {}};
    for (auto span = static_cast<std::size_t>(spline->degree); span < spline->poles.size(); ++span) {
        const double from = spline->knots[span], to = spline->knots[span + 1];
        if (!(to > from)) {
            continue;
        }
        const auto curve = [&](double t) { return at(*spline, span, t); };
        if (path.vertices.empty()) {
            path.vertices.push_back({curve(from), 0});
        }
        add_chords(path, curve, from, to, tolerance, most_halvings);
    }
    return path;
}

} // namespace rhombloom::reading
