#include "exporters/bent_element.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "core/form/parallel.h"
#include "exporters/bent_element_bend.h"

namespace rhombloom {

namespace {

//! A point of a hook: which end of which short side, and where in that side's frame.
struct HookPoint
{
    int point = 0;     //!< of the flat sheet
    int node = 0;      //!< the piece's corner at that end
    int far = 0;       //!< and at the other
    double along = 0;  //!< mm from the node along the side
    double beyond = 0; //!< mm outside the nominal side; negative on the element
    double share = 0;  //!< how far it belongs to the neighbour's sheet, 0..1
};

//! The element's own frame: x along the long sides, z outward, left-handed when it is turned over.
struct Frame
{
    Vec3 origin;
    Eigen::Matrix3d axes; //!< columns

    Vec3 inside(const Vec3& p) const { return axes.transpose() * (p - origin); }
    Vec3 outside(const Vec3& p) const { return origin + axes * p; }
};

struct Context
{
    const Surface& surface;
    const Element& element;
    HookParameters hooks;
    FlatSheet sheet;
    std::vector<HookPoint> hook_points;
    std::map<std::pair<int, int>, std::array<int, 2>> faces_of_edge; //!< sorted vertices -> faces, -1: none
};

double smooth_step(double t)
{
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

//! The finger belongs wholly to the neighbour's sheet, the root climbs from one to the other, the rim stays.
double neighbour_share(const HookParameters& hooks, double along, double beyond)
{
    const double climb = hooks.finger_width;
    const double pivot = pivot_radius(hooks);
    if (along > pivot + 0.5 * hooks.slit && beyond > 0) {
        return 1;
    }
    const double rise = smooth_step((beyond + climb) / climb);
    const double rim = smooth_step((along - pivot) / climb);
    return rise * (beyond > 0 ? 1 : 1 - rim);
}

std::vector<HookPoint> find_hook_points(const FlatSheet& sheet, const Element& element, const HookParameters& hooks)
{
    const std::array<Vec2, 4> corners = flat_corners(element);
    const double reach = pivot_radius(hooks) + hooks.slit + hooks.finger_length + hooks.finger_width;
    std::vector<HookPoint> found;
    for (int i = 0; i < static_cast<int>(sheet.points.size()); ++i) {
        for (const int side : {1, 3}) {
            const Vec2 origin = corners[side];
            const Vec2 d = (corners[(side + 1) % 4] - origin).normalized();
            const Vec2 r = sheet.points[i] - origin;
            const bool first = r.dot(d) < element.la / 2;
            HookPoint h{i, first ? side : (side + 1) % 4, first ? (side + 1) % 4 : side, 0, 0, 0};
            h.along = first ? r.dot(d) : element.la - r.dot(d);
            h.beyond = r.x() * d.y() - r.y() * d.x();
            h.share = neighbour_share(hooks, h.along, h.beyond);
            if (h.along < reach && h.along > 0 && h.share > 0) {
                found.push_back(h);
            }
        }
    }
    return found;
}

std::map<std::pair<int, int>, std::array<int, 2>> find_edges(const Surface& surface)
{
    std::map<std::pair<int, int>, std::array<int, 2>> edges;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        for (int k = 0; k < 4; ++k) {
            const auto key = std::minmax(q[k], q[(k + 1) % 4]);
            const auto [place, fresh] = edges.try_emplace({key.first, key.second}, std::array<int, 2>{f.idx(), -1});
            if (!fresh) {
                place->second[1] = f.idx();
            }
        }
    }
    return edges;
}

std::array<Vec3, 4> corner_positions(const Surface& surface, const std::array<int, 4>& corners)
{
    std::array<Vec3, 4> positions;
    for (int k = 0; k < 4; ++k) {
        positions[k] = surface.point(Vertex(corners[k]));
    }
    return positions;
}

Frame frame_of(const std::array<Vec3, 4>& c, Outward outward)
{
    const Vec3 x = (c[1] - c[0] + c[2] - c[3]).normalized();
    const Vec3 normal = (c[2] - c[0]).cross(c[3] - c[1]) * sign(outward);
    const Vec3 n = (normal - normal.dot(x) * x).normalized();
    Frame frame;
    frame.origin = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    frame.axes << x, n.cross(x) * sign(outward), n;
    return frame;
}

std::array<Vec3, 4> inside(const Frame& frame, const std::array<Vec3, 4>& corners)
{
    return {frame.inside(corners[0]), frame.inside(corners[1]), frame.inside(corners[2]), frame.inside(corners[3])};
}

BentPatch outside(const Frame& frame, BentPatch patch)
{
    for (int i = 0; i < BentPatch::controls; ++i) {
        patch.control.col(i) = frame.outside(patch.control.col(i));
    }
    return patch;
}

//! The mean of all elements' corners in their own frames.
std::array<Vec3, 4> mean_corners(const std::vector<std::array<Vec3, 4>>& corners)
{
    std::array<Vec3, 4> mean = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (const auto& c : corners) {
        for (int k = 0; k < 4; ++k) {
            mean[k] += c[k] / static_cast<double>(corners.size());
        }
    }
    return mean;
}

//! The element on the other side of the edge from corner \p a to corner \p b of element \p i; null at a boundary.
const BentElement* neighbour(const Context& context, const std::vector<BentElement>& elements, std::size_t i, int a,
                             int b)
{
    const auto key = std::minmax(elements[i].corners[a], elements[i].corners[b]);
    const std::array<int, 2>& faces = context.faces_of_edge.at({key.first, key.second});
    const int other = faces[0] == static_cast<int>(i) ? faces[1] : faces[0];
    return other < 0 ? nullptr : &elements[other];
}

int corner_at(const BentElement& element, int vertex)
{
    return static_cast<int>(std::find(element.corners.begin(), element.corners.end(), vertex) -
                            element.corners.begin());
}

//! Every element starts from the same solved patch: the result does not depend on the order.
void bend_all(const Context& context, std::vector<BentElement>& elements)
{
    std::vector<Frame> frames;
    std::vector<std::array<Vec3, 4>> corners;
    for (const BentElement& e : elements) {
        const std::array<Vec3, 4> c = corner_positions(context.surface, e.corners);
        frames.push_back(frame_of(c, e.outward));
        corners.push_back(inside(frames.back(), c));
    }
    const SheetMechanics mechanics = sheet_mechanics(context.element, context.hooks, mean_corners(corners));
    parallel_tasks(default_threads(), static_cast<int>(elements.size()),
                   [&](int i) { elements[i].patch = outside(frames[i], bend(mechanics, corners[i])); });
}

//! Where a hook's point lies on the neighbour's flat piece: as far from the node, as far inside its long side.
Vec2 on_neighbour(const Context& context, const BentElement& self, const BentElement& other, const HookPoint& h)
{
    const std::array<Vec2, 4> corners = flat_corners(context.element);
    const int node = corner_at(other, self.corners[h.node]);
    const int far = corner_at(other, self.corners[h.far]);
    const Vec2 inward(0, node < 2 ? 1 : -1);
    return corners[node] + (corners[far] - corners[node]).normalized() * h.along + inward * h.beyond;
}

//! Lay the hooks over the neighbours: sheet over sheet with a little air, so that nothing touches nor flickers.
void lay_hooks(const Context& context, const std::vector<BentElement>& elements, std::size_t i, BentElement& e)
{
    const double lift = 1.4 * context.element.thickness;
    for (const HookPoint& h : context.hook_points) {
        const BentElement* other = neighbour(context, elements, i, h.node, h.far);
        if (other == nullptr) {
            continue;
        }
        const Vec2 q = on_neighbour(context, e, *other, h);
        const Vec3 normal = bent_normal(other->patch, q, other->outward);
        const Vec3 over = bent_position(other->patch, q) + lift * normal;
        e.points[h.point] += h.share * (over - e.points[h.point]);
        e.normals[h.point] = ((1 - h.share) * e.normals[h.point] + h.share * normal).normalized();
    }
}

void shape_element(const Context& context, const std::vector<BentElement>& elements, std::size_t i, BentElement& e)
{
    e.points.reserve(context.sheet.points.size());
    for (const Vec2& p : context.sheet.points) {
        e.points.push_back(bent_position(e.patch, p));
        e.normals.push_back(bent_normal(e.patch, p, e.outward));
    }
    lay_hooks(context, elements, i, e);
}

//! \name Measuring
//! \{

struct Segment
{
    int a;
    int b;
    bool hook;
};

std::vector<Segment> segments(const Context& context)
{
    std::vector<bool> hook(context.sheet.points.size(), false);
    for (const HookPoint& h : context.hook_points) {
        hook[h.point] = true;
    }
    std::vector<Segment> list;
    for (const auto& t : context.sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            list.push_back({t[k], t[(k + 1) % 3], hook[t[k]] || hook[t[(k + 1) % 3]]});
        }
    }
    return list;
}

double bow(const Element& element, const BentElement& e, const std::array<Vec3, 4>& c)
{
    const std::array<Vec2, 4> flat = flat_corners(element);
    const Vec3 low = bent_position(e.patch, 0.5 * (flat[0] + flat[1])) - 0.5 * (c[0] + c[1]);
    const Vec3 high = bent_position(e.patch, 0.5 * (flat[2] + flat[3])) - 0.5 * (c[2] + c[3]);
    return 0.5 * (low.norm() + high.norm());
}

void measure_element(const Context& context, const std::vector<Segment>& list, const BentElement& e,
                     std::vector<double>& all, BendingReport& report)
{
    const FlatSheet& sheet = context.sheet;
    for (const Segment& s : list) {
        const double flat = (sheet.points[s.b] - sheet.points[s.a]).norm();
        const double distortion = std::abs((e.points[s.b] - e.points[s.a]).norm() / flat - 1);
        all.push_back(distortion);
        double& worst = s.hook ? report.max_hook_distortion : report.max_length_distortion;
        worst = std::max(worst, distortion);
    }
    double rim = 0;
    for (std::size_t i = 0; i < sheet.rim; ++i) {
        rim += (e.points[(i + 1) % sheet.rim] - e.points[i]).norm();
    }
    report.max_rim_distortion = std::max(report.max_rim_distortion, std::abs(rim / rim_length(sheet) - 1));
    const std::array<Vec3, 4> corners = corner_positions(context.surface, e.corners);
    const std::array<Vec2, 4> flat = flat_corners(context.element);
    for (int k = 0; k < 4; ++k) {
        const double error = (bent_position(e.patch, flat[k]) - corners[k]).norm();
        report.max_corner_error_mm = std::max(report.max_corner_error_mm, error);
    }
    report.mean_bow_mm += bow(context.element, e, corners);
}

BendingReport measure_bending(const Context& context, const std::vector<BentElement>& elements)
{
    BendingReport report;
    const std::vector<Segment> list = segments(context);
    std::vector<double> all;
    for (const BentElement& e : elements) {
        measure_element(context, list, e, all, report);
    }
    report.mean_bow_mm /= static_cast<double>(elements.size());
    const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
    std::nth_element(all.begin(), p99, all.end());
    report.p99_length_distortion = *p99;
    return report;
}

//! \}

} // namespace

std::array<int, 4> piece_corners(const Surface& surface, Face f)
{
    const Quad q = quad(surface, f);
    const int first = surface.data(Vertex(q[0])).side == Side::Long ? 0 : 1;
    const auto at = [&](int k) { return q[(first + k) % 4]; };
    // Turned over, the piece runs clockwise: the long side that leaves a Long vertex ends at the acute corner.
    if (surface.data(f).facing == Facing::Front) {
        return {at(0), at(1), at(2), at(3)};
    }
    return {at(1), at(0), at(3), at(2)};
}

Expected<BentSurface> bent_surface(const Surface& surface, const Element& element, const FlatSheetOptions& options)
{
    const HookParameters hooks = hook_parameters(element);
    const Expected<Path> outline = element_outline(hooks);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    Context context{surface, element, hooks, flat_sheet(*outline, options), {}, {}};
    context.hook_points = find_hook_points(context.sheet, element, hooks);
    context.faces_of_edge = find_edges(surface);

    std::vector<BentElement> elements(surface.n_faces());
    for (const Face f : surface.faces()) {
        elements[f.idx()].outward = surface.data(f).facing == Facing::Front ? Outward::Front : Outward::Back;
        elements[f.idx()].corners = piece_corners(surface, f);
    }
    bend_all(context, elements);
    parallel_tasks(default_threads(), static_cast<int>(elements.size()),
                   [&](int i) { shape_element(context, elements, i, elements[i]); });
    const BendingReport report = measure_bending(context, elements);
    return BentSurface{std::move(context.sheet), std::move(elements), report};
}

} // namespace rhombloom
