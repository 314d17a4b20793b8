#include "exporters/bent_element.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/form/parallel.h"
#include "exporters/bent_element_bend.h"
#include "exporters/bent_element_hooks.h"
#include "exporters/bent_element_relax.h"
#include "exporters/bent_element_report.h"

namespace rhombloom {

namespace {

using Corners = std::array<Vec3, 4>;

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
    FlatSheet sheet;
    PatchSamples samples; //!< at the sheet's points
    Hooks hooks;
    std::map<std::pair<int, int>, std::array<int, 2>> faces_of_edge; //!< sorted vertices -> faces, -1: none
};

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

Corners corner_positions(const Surface& surface, const std::array<int, 4>& corners)
{
    Corners positions;
    for (int k = 0; k < 4; ++k) {
        positions[k] = surface.point(Vertex(corners[k]));
    }
    return positions;
}

Frame frame_of(const Corners& c, Outward outward)
{
    const Vec3 x = (c[1] - c[0] + c[2] - c[3]).normalized();
    const Vec3 normal = (c[2] - c[0]).cross(c[3] - c[1]) * sign(outward);
    const Vec3 n = (normal - normal.dot(x) * x).normalized();
    Frame frame;
    frame.origin = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    frame.axes << x, n.cross(x) * sign(outward), n;
    return frame;
}

Corners inside(const Frame& frame, const Corners& corners)
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

//! \name Bending
//! \{

double squared_distance(const Corners& a, const Corners& b)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        sum += (a[k] - b[k]).squaredNorm();
    }
    return sum;
}

//! The mean of all elements' corners in their own frames.
Corners mean_corners(const std::vector<Corners>& corners)
{
    Corners mean = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (const Corners& c : corners) {
        for (int k = 0; k < 4; ++k) {
            mean[k] += c[k] / static_cast<double>(corners.size());
        }
    }
    return mean;
}

//! Few elements that are like all others, and which of them each is like most.
struct Representatives
{
    std::vector<std::size_t> chosen;
    std::vector<std::size_t> of; //!< index into chosen, by element
};

//! Farthest-point sampling: the next one chosen is the one least like those before.
Representatives representatives(const std::vector<Corners>& corners, const Corners& mean, std::size_t most,
                                double near_mm)
{
    std::vector<double> distance;
    for (const Corners& c : corners) {
        distance.push_back(1e6 + squared_distance(c, mean));
    }
    Representatives result;
    result.of.resize(corners.size());
    while (result.chosen.size() < most) {
        const auto far = std::max_element(distance.begin(), distance.end());
        if (*far < near_mm * near_mm) {
            break;
        }
        const auto next = static_cast<std::size_t>(far - distance.begin());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const double d = squared_distance(corners[i], corners[next]);
            if (d < distance[i]) {
                distance[i] = d;
                result.of[i] = result.chosen.size();
            }
        }
        result.chosen.push_back(next);
    }
    return result;
}

//! Representatives are bent from the mean element's shape, all others from their representative's: the result depends
//! neither on the order nor on the number of threads.
void bend_all(const Context& context, const HookParameters& hooks, const std::vector<int>& faces,
              std::vector<BentElement>& elements)
{
    constexpr std::size_t most_representatives = 64;
    std::vector<Frame> frames;
    std::vector<Corners> corners;
    for (const int f : faces) {
        const BentElement& e = elements[f];
        const Corners c = corner_positions(context.surface, e.corners);
        frames.push_back(frame_of(c, e.outward));
        corners.push_back(inside(frames.back(), c));
    }
    const Corners mean = mean_corners(corners);
    const SheetMechanics mechanics = sheet_mechanics(context.element, hooks, mean);
    const Representatives like = representatives(corners, mean, most_representatives, 1e-4 * context.element.la);
    std::vector<BentPatch> solved(like.chosen.size());
    parallel_tasks(default_threads(), static_cast<int>(solved.size()), [&](int i) {
        solved[i] = bend(mechanics, corners[like.chosen[i]], mechanics.mean, {100, 1e-5});
    });
    parallel_tasks(default_threads(), static_cast<int>(faces.size()), [&](int i) {
        const BentPatch& start = solved[like.of[i]];
        const bool same = squared_distance(corners[i], corners[like.chosen[like.of[i]]]) < 1e-20;
        elements[faces[i]].patch = outside(frames[i], same ? start : bend(mechanics, corners[i], start, {20, 1e-4}));
    });
}

//! \}

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

//! Lay the hooks over the neighbours: sheet over sheet with a little air, so that nothing touches nor flickers.
void lay_hooks(const Context& context, const std::vector<BentElement>& elements, std::size_t i, BentElement& e)
{
    const double lift = 1.4 * context.element.thickness;
    for (std::size_t k = 0; k < context.hooks.points.size(); ++k) {
        const HookPoint& h = context.hooks.points[k];
        const BentElement* other = neighbour(context, elements, i, h.node, h.far);
        if (other == nullptr) {
            continue;
        }
        const PatchSamples& there = context.hooks.on_neighbour[corner_at(*other, e.corners[h.node])];
        const Vec3 normal = there.normal(other->patch, static_cast<int>(k), other->outward);
        const Vec3 over = there.position(other->patch, static_cast<int>(k)) + lift * normal;
        e.points[h.point] += h.share * (over - e.points[h.point]);
        e.normals[h.point] = ((1 - h.share) * e.normals[h.point] + h.share * normal).normalized();
    }
}

void shape_element(const Context& context, const std::vector<BentElement>& elements, const SheetRelaxation& relaxation,
                   std::size_t i, BentElement& e)
{
    const int count = static_cast<int>(context.sheet.points.size());
    for (int k = 0; k < count; ++k) {
        e.points.push_back(context.samples.position(e.patch, k));
        e.normals.push_back(context.samples.normal(e.patch, k, e.outward));
    }
    lay_hooks(context, elements, i, e);
    SheetRelaxation::Rows rows(count, 3);
    for (int k = 0; k < count; ++k) {
        rows.row(k) = e.points[k];
    }
    rows = relaxation.relaxed(rows, corner_positions(context.surface, e.corners));
    for (int k = 0; k < count; ++k) {
        e.points[k] = rows.row(k);
    }
}

//! \p faces and all that share an edge with one of them, ascending.
std::vector<int> with_neighbours(const Context& context, const std::vector<int>& faces)
{
    std::vector<bool> chosen(context.surface.n_faces(), false);
    for (const int f : faces) {
        chosen[f] = true;
        for (const Face other : context.surface.ff_range(Face(f))) {
            chosen[other.idx()] = true;
        }
    }
    std::vector<int> list;
    for (int f = 0; f < static_cast<int>(chosen.size()); ++f) {
        if (chosen[f]) {
            list.push_back(f);
        }
    }
    return list;
}

std::vector<BentElement> unbent_elements(const Surface& surface)
{
    std::vector<BentElement> elements(surface.n_faces());
    for (const Face f : surface.faces()) {
        elements[f.idx()].outward = surface.data(f).facing == Facing::Front ? Outward::Front : Outward::Back;
        elements[f.idx()].corners = piece_corners(surface, f);
    }
    return elements;
}

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

Expected<BentSurface> bent_surface(const Surface& surface, const Element& element)
{
    return bent_surface(surface, element, hook_parameters(element));
}

Expected<BentSurface> bent_surface(const Surface& surface, const Element& element, const HookParameters& hooks)
{
    std::vector<int> faces(surface.n_faces());
    std::iota(faces.begin(), faces.end(), 0);
    Expected<BentSurface> bent = bent_faces(surface, element, hooks, faces);
    if (bent) {
        bent->report = measure_bending(*bent, surface, element, hooks);
    }
    return bent;
}

Expected<BentSurface> bent_faces(const Surface& surface, const Element& element, const HookParameters& hooks,
                                 const std::vector<int>& faces)
{
    const Expected<Path> outline = element_outline(hooks);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    const FlatSheet sheet = flat_sheet(*outline, sheet_options(element));
    const Context context{surface,
                          element,
                          sheet,
                          PatchSamples(sheet.points, rhomboid(element).inverse()),
                          find_hooks(sheet, element, hooks),
                          find_edges(surface)};
    BentSurface bent{sheet, unbent_elements(surface), {}};
    bend_all(context, hooks, with_neighbours(context, faces), bent.elements);
    const SheetRelaxation relaxation(sheet, element, hooks, context.hooks);
    parallel_tasks(default_threads(), static_cast<int>(faces.size()), [&](int i) {
        shape_element(context, bent.elements, relaxation, faces[i], bent.elements[faces[i]]);
    });
    return bent;
}

} // namespace rhombloom
