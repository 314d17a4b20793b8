#include "core/building/viewpoints.h"

#include <algorithm>
#include <cmath>

#include "core/building/build_history.h"

namespace rhombloom {

namespace {

constexpr int raster = 128;

Viewpoint viewpoint(double azimuth, double height)
{
    Viewpoint view;
    view.toward = Vec3(std::cos(height) * std::sin(azimuth), -std::cos(height) * std::cos(azimuth), std::sin(height));
    view.right = Vec3(std::cos(azimuth), std::sin(azimuth), 0);
    view.up = view.toward.cross(view.right);
    return view;
}

std::vector<Viewpoint> make_viewpoints()
{
    std::vector<Viewpoint> views;
    for (const double height : {radians(25), radians(60), radians(-35)}) {
        for (int i = 0; i < azimuth_count; ++i) {
            views.push_back(viewpoint(two_pi * i / azimuth_count, height));
        }
    }
    return views;
}

struct Triangle
{
    std::array<Vec3, 3> corner; // pixels across, pixels up, depth toward the eye
};

template <class Visit>
void rasterise(const Triangle& t, const Visit& visit)
{
    const auto& [a, b, c] = t.corner;
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area == 0) {
        return;
    }
    const auto low = [&](int i) { return std::max(0, static_cast<int>(std::floor(std::min({a[i], b[i], c[i]})))); };
    const auto high = [&](int i) {
        return std::min(raster - 1, static_cast<int>(std::ceil(std::max({a[i], b[i], c[i]}))));
    };
    for (int y = low(1); y <= high(1); ++y) {
        for (int x = low(0); x <= high(0); ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            const double v = ((px - a.x()) * (c.y() - a.y()) - (py - a.y()) * (c.x() - a.x())) / area;
            const double w = ((b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x())) / area;
            if (v >= 0 && w >= 0 && v + w <= 1) {
                visit(y * raster + x, a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z()));
            }
        }
    }
}

double radius_about(const Surface& surface, const Vec3& centre)
{
    double radius = 1e-9;
    for (const Vertex v : surface.vertices()) {
        radius = std::max(radius, (surface.point(v) - centre).norm());
    }
    return radius;
}

Vec3 middle(const Surface& surface)
{
    Vec3 low = Vec3::Constant(1e300);
    Vec3 high = Vec3::Constant(-1e300);
    for (const Vertex v : surface.vertices()) {
        low = low.cwiseMin(surface.point(v));
        high = high.cwiseMax(surface.point(v));
    }
    return (low + high) / 2;
}

std::array<Vec3, 4> corners(const Surface& surface, Face f)
{
    const Quad q = quad(surface, f);
    return {surface.point(Vertex(q[0])), surface.point(Vertex(q[1])), surface.point(Vertex(q[2])),
            surface.point(Vertex(q[3]))};
}

} // namespace

const std::vector<Viewpoint>& viewpoints()
{
    static const std::vector<Viewpoint> views = make_viewpoints();
    return views;
}

Vec3 element_normal(const Surface& surface, Face f)
{
    const auto [a, b, c, d] = corners(surface, f);
    const Vec3 normal = (c - a).cross(d - b);
    return normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero());
}

Vec3 element_centre(const Surface& surface, Face f)
{
    const auto [a, b, c, d] = corners(surface, f);
    return (a + b + c + d) / 4;
}

Coverage::Coverage(const Surface& surface)
{
    const Vec3 centre = middle(surface);
    const double radius = radius_about(surface, centre);
    const double scale = 0.49 * raster / radius;
    tolerance_ = static_cast<float>(0.02 * radius * scale);
    const auto faces = static_cast<int>(surface.n_faces());
    const auto views = static_cast<int>(viewpoints().size());
    pixels_.resize(static_cast<std::size_t>(faces) * views);
    for (const Face f : surface.faces()) {
        normal_.push_back(element_normal(surface, f));
        for (int view = 0; view < views; ++view) {
            const Viewpoint& eye = viewpoints()[view];
            std::array<Vec3, 4> p = corners(surface, f);
            for (Vec3& corner : p) {
                const Vec3 x = (corner - centre) * scale;
                corner = Vec3(x.dot(eye.right) + 0.5 * raster, x.dot(eye.up) + 0.5 * raster, x.dot(eye.toward));
            }
            auto& pixels = pixels_[static_cast<std::size_t>(view) * faces + f.idx()];
            const auto add = [&](int i, double z) { pixels.push_back({i, static_cast<float>(z)}); };
            rasterise({{p[0], p[1], p[2]}}, add);
            rasterise({{p[0], p[2], p[3]}}, add);
        }
    }
}

std::shared_ptr<const Coverage> StageCoverage::operator()(int stage)
{
    const std::scoped_lock lock(making_);
    auto& made = made_[stage];
    if (!made) {
        made = std::make_shared<Coverage>(stage_surface(replay_, stage));
    }
    return made;
}

Sight::Sight(std::shared_ptr<const Coverage> coverage)
    : coverage_(std::move(coverage)), depth_(viewpoints().size(), std::vector<float>(raster * raster))
{
    clear();
}

void Sight::place(Face f)
{
    for (std::size_t view = 0; view < depth_.size(); ++view) {
        for (const Coverage::Pixel& p : coverage_->pixels(f, static_cast<int>(view))) {
            depth_[view][p.index] = std::max(depth_[view][p.index], p.depth);
        }
    }
}

void Sight::clear()
{
    for (auto& view : depth_) {
        std::fill(view.begin(), view.end(), -1e30F);
    }
}

double Sight::visible(Face f, int viewpoint) const
{
    const auto& pixels = coverage_->pixels(f, viewpoint);
    if (pixels.empty() || coverage_->normal(f).dot(viewpoints()[viewpoint].toward) < 0.3) {
        return 0;
    }
    const auto seen = std::count_if(pixels.begin(), pixels.end(), [&](const Coverage::Pixel& p) {
        return depth_[viewpoint][p.index] <= p.depth + coverage_->tolerance();
    });
    return static_cast<double>(seen) / static_cast<double>(pixels.size());
}

namespace {

//! For each step, how well each viewpoint shows its element.
std::vector<std::vector<double>> visibilities(const Replay& replay, const AssemblyPlan& plan, StageCoverage& coverage)
{
    std::vector<std::vector<double>> result;
    std::vector<char> present(replay.surface.n_faces() + plan.temporary.size(), 0);
    std::optional<Sight> sight;
    std::vector<int> face;
    int stage = -1;
    for (const Step& step : plan.steps) {
        const bool fresh = step.stage != stage || step.kind != StepKind::Insert;
        if (step.stage != stage) {
            stage = step.stage;
            sight.emplace(coverage(stage));
            face = faces_of_elements(replay, plan, stage);
        }
        if (fresh) {
            sight->clear();
            for (std::size_t e = 0; e < present.size(); ++e) {
                if (present[e] && static_cast<int>(e) != step.element && face[e] >= 0) {
                    sight->place(Face(face[e]));
                }
            }
        }
        const Face f(face[step.element]);
        result.emplace_back();
        for (std::size_t view = 0; view < viewpoints().size(); ++view) {
            result.back().push_back(sight->visible(f, static_cast<int>(view)));
        }
        present[step.element] = step.kind != StepKind::Remove;
        if (present[step.element]) {
            sight->place(f);
        }
    }
    return result;
}

//! From step \p first on: how many steps \p view can be held, and how well it shows them.
std::pair<int, double> hold(const std::vector<std::vector<double>>& visible, std::size_t first, std::size_t view)
{
    int length = 0;
    double total = 0;
    for (std::size_t k = first; k < visible.size() && visible[k][view] >= well_visible; ++k) {
        ++length;
        total += visible[k][view];
    }
    return {length, total};
}

int longest_hold(const std::vector<std::vector<double>>& visible, std::size_t first, int& length)
{
    int best = 0;
    double best_total = -1;
    length = 0;
    for (std::size_t view = 0; view < viewpoints().size(); ++view) {
        const auto [steps, total] = hold(visible, first, view);
        if (steps > length || (steps == length && total > best_total + 1e-12)) {
            length = steps;
            best = static_cast<int>(view);
            best_total = total;
        }
    }
    if (length == 0) { // nothing shows it well: the best there is, for this step alone
        const auto& row = visible[first];
        best = static_cast<int>(std::max_element(row.begin(), row.end()) - row.begin());
        length = 1;
    }
    return best;
}

} // namespace

std::vector<int> held_views(const Replay& replay, const AssemblyPlan& plan)
{
    StageCoverage coverage(replay);
    return held_views(replay, plan, coverage);
}

std::vector<int> held_views(const Replay& replay, const AssemblyPlan& plan, StageCoverage& coverage)
{
    const auto visible = visibilities(replay, plan, coverage);
    std::vector<int> views;
    while (views.size() < visible.size()) {
        int length = 0;
        const int view = longest_hold(visible, views.size(), length);
        views.insert(views.end(), length, view);
    }
    return views;
}

int count_turns(const std::vector<int>& views)
{
    int turns = 0;
    for (std::size_t k = 1; k < views.size(); ++k) {
        turns += views[k] != views[k - 1];
    }
    return turns;
}

} // namespace rhombloom
