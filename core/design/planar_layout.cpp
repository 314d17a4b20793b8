// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Section 4.4.
#include "core/design/planar_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <Eigen/Eigenvalues>

#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr int max_layout_elements = 1000; // drawn by hand; the modes below are dense

std::array<Vec3, 4> drawn_corners(const LayoutElement& drawn, const Element& element)
{
    const double angle = drawn.facing == Facing::Front ? element.alpha : beta(element);
    const Vec3 along = element.lb * Vec3::UnitX();
    const Vec3 across = element.la * Vec3(std::cos(angle), std::sin(angle), 0);
    const Eigen::AngleAxisd turn(radians(drawn.rotation_deg), Vec3::UnitZ());
    const Vec3 at(drawn.at.x(), drawn.at.y(), 0);
    const Vec3 middle = (along + across) / 2;
    return {at + turn * Vec3(-middle), at + turn * Vec3(along - middle), at + turn * middle,
            at + turn * Vec3(across - middle)};
}

std::string port_name(int element, int side)
{
    return "side " + std::to_string(side) + " of element " + std::to_string(element);
}

Expected<void> check_port(const Layout& layout, int element, int side, std::set<std::pair<int, int>>& used)
{
    if (element < 0 || element >= static_cast<int>(layout.elements.size()) || side < 0 || side > 3) {
        return refuse("there is no " + port_name(element, side) + ": the layout has " +
                      std::to_string(layout.elements.size()) + " elements with sides 0 to 3");
    }
    if (!used.insert({element, side}).second) {
        return refuse(port_name(element, side) + " is joined twice");
    }
    return {};
}

Expected<void> check_joins(const Layout& layout)
{
    std::set<std::pair<int, int>> used;
    for (const LayoutJoin& join : layout.joins) {
        for (const auto& [element, side] : {std::pair{join.element, join.side}, std::pair{join.to, join.to_side}}) {
            if (auto ok = check_port(layout, element, side, used); !ok) {
                return ok;
            }
        }
        if (join.side % 2 == join.to_side % 2) {
            return refuse(port_name(join.element, join.side) + " and " + port_name(join.to, join.to_side) +
                          " are both " + (join.side % 2 == 0 ? "long" : "short") +
                          ": a long side goes into a short one");
        }
    }
    return {};
}

//! For corner k of element e, at 4 e + k: the lowest corner it is one vertex with.
std::vector<int> merged_corners(const Layout& layout)
{
    std::vector<int> same(4 * layout.elements.size());
    std::iota(same.begin(), same.end(), 0);
    const auto join = [&](int a, int b) {
        const auto [low, high] = std::pair(std::min(same[a], same[b]), std::max(same[a], same[b]));
        std::replace(same.begin(), same.end(), high, low);
    };
    for (const LayoutJoin& j : layout.joins) {
        join(4 * j.element + j.side, 4 * j.to + (j.to_side + 1) % 4);
        join(4 * j.element + (j.side + 1) % 4, 4 * j.to + j.to_side);
    }
    return same;
}

SurfaceLists drawn_lists(const Layout& layout, const Element& element)
{
    const std::vector<int> same = merged_corners(layout);
    std::vector<int> number(same.size(), -1);
    std::vector<int> corners;
    SurfaceLists out;
    out.components = {layout.id};
    for (int e = 0; e < static_cast<int>(layout.elements.size()); ++e) {
        const auto points = drawn_corners(layout.elements[e], element);
        Quad q{};
        for (int k = 0; k < 4; ++k) {
            int& v = number[same[4 * e + k]];
            if (v < 0) {
                v = static_cast<int>(out.positions.size());
                out.positions.push_back(Vec3::Zero());
                out.sides.push_back(k % 2 == 0 ? Side::Long : Side::Short);
                corners.push_back(0);
            }
            out.positions[v] += points[k];
            ++corners[v];
            q[k] = v;
        }
        out.quads.push_back(q);
        out.facing.push_back(layout.elements[e].facing);
        out.component.push_back(0);
        out.serial.push_back(e);
    }
    for (std::size_t v = 0; v < corners.size(); ++v) {
        out.positions[v] /= corners[v];
    }
    return out;
}

using Positions = std::vector<Vec3>;

Positions positions(const Surface& surface)
{
    Positions result;
    for (const Vertex v : surface.vertices()) {
        result.push_back(surface.point(v));
    }
    return result;
}

Vec3 mean(const Positions& points)
{
    return std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) / static_cast<double>(points.size());
}

//! The drawing as a shallow dome: the outside is up.
Positions bulged(const Surface& surface)
{
    Positions points = positions(surface);
    const Vec3 middle = mean(points);
    double radius = 1e-9;
    for (const Vec3& p : points) {
        radius = std::max(radius, (p - middle).norm());
    }
    for (Vec3& p : points) {
        p.z() -= 0.3 * (p - middle).squaredNorm() / radius;
    }
    return points;
}

Eigen::MatrixXd laplacian(const Surface& surface)
{
    const auto n = static_cast<Eigen::Index>(surface.n_vertices());
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    for (const Halfedge h : surface.halfedges()) {
        const int a = surface.from_vertex_handle(h).idx();
        const int b = surface.to_vertex_handle(h).idx();
        L(a, b) -= 1;
        L(a, a) += 1;
    }
    return L;
}

//! The three lowest modes of the mesh as coordinates, edges la long on average: a closed surface comes out round.
Positions low_modes(const Surface& surface, const Element& element)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(laplacian(surface));
    const auto n = static_cast<Eigen::Index>(surface.n_vertices());
    Positions points(surface.n_vertices(), Vec3::Zero());
    for (Eigen::Index k = 1; k <= std::min<Eigen::Index>(3, n - 1); ++k) {
        // The sign of an eigenvector is arbitrary: fix it by its largest entry.
        Eigen::Index largest = 0;
        solver.eigenvectors().col(k).cwiseAbs().maxCoeff(&largest);
        const double sign = solver.eigenvectors()(largest, k) < 0 ? -1 : 1;
        for (Eigen::Index v = 0; v < n; ++v) {
            points[v][k - 1] = sign * solver.eigenvectors()(v, k);
        }
    }
    double length = 0;
    for (const Edge e : surface.edges()) {
        const Halfedge h = surface.halfedge_handle(e, 0);
        length += (points[surface.from_vertex_handle(h).idx()] - points[surface.to_vertex_handle(h).idx()]).norm();
    }
    for (Vec3& p : points) {
        p *= element.la * static_cast<double>(surface.n_edges()) / length;
    }
    return points;
}

Positions mirrored(Positions points)
{
    for (Vec3& p : points) {
        p.z() = -p.z();
    }
    return points;
}

bool closed(const Surface& surface)
{
    for (const Halfedge h : surface.halfedges()) {
        if (surface.is_boundary(h)) {
            return false;
        }
    }
    return true;
}

std::vector<Positions> starts(const Surface& surface, const Element& element)
{
    std::vector<Positions> result;
    if (!closed(surface)) {
        result.push_back(bulged(surface));
    }
    if (surface.n_vertices() > 4) {
        const Positions modes = low_modes(surface, element);
        result.push_back(modes);
        result.push_back(mirrored(modes));
    }
    return result;
}

//! Back to where the drawing was, as well as a rigid motion can.
void return_to(const Positions& drawing, Surface& surface)
{
    Eigen::Matrix3Xd from(3, drawing.size());
    Eigen::Matrix3Xd to(3, drawing.size());
    for (std::size_t v = 0; v < drawing.size(); ++v) {
        from.col(v) = surface.point(Vertex(static_cast<int>(v)));
        to.col(v) = drawing[v];
    }
    Eigen::Isometry3d pose;
    pose.matrix() = Eigen::umeyama(from, to, false);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, pose * surface.point(v));
    }
}

} // namespace

Expected<Surface> planar_layout(const Layout& layout, const Element& element)
{
    if (layout.elements.empty() || layout.elements.size() > max_layout_elements) {
        return refuse("a layout has 1 to " + std::to_string(max_layout_elements) + " elements, not " +
                      std::to_string(layout.elements.size()));
    }
    if (auto ok = check_joins(layout); !ok) {
        return tl::make_unexpected(ok.error());
    }
    auto surface = make_surface(drawn_lists(layout, element));
    if (!surface) {
        return surface;
    }
    if (const Validity validity = validate(*surface, element); !validity.ok()) {
        return refuse(validity.problems.front());
    }
    return surface;
}

EmbedReport unfold(Surface& surface, const Element& element, const EmbedOptions& options)
{
    const Positions drawing = positions(surface);
    Surface best;
    EmbedReport best_report;
    for (const Positions& start : starts(surface, element)) {
        Surface trial = surface;
        for (const Vertex v : trial.vertices()) {
            trial.set_point(v, start[v.idx()]);
        }
        const EmbedReport report = embed(trial, element, options);
        const auto key = [](const EmbedReport& r) { return std::pair(!r.converged, r.energy); };
        if (best.n_vertices() == 0 || key(report) < key(best_report)) {
            best = std::move(trial);
            best_report = report;
        }
    }
    surface = std::move(best);
    return_to(drawing, surface);
    return best_report;
}

} // namespace rhombloom
