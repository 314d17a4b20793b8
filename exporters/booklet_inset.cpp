#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "exporters/booklet_steps.h"
#include "exporters/figure_hooks.h"

namespace rhombloom {

namespace {

constexpr double mm2_per_pt2 = (25.4 / 72) * (25.4 / 72);
constexpr double enough_area = 66;  // mm2; labels and thick sides take up to 40 of it
constexpr double enough_width = 17; // points, about 6 mm
constexpr double least_magnified = 1.4;
constexpr int first_steps = 6;

//! The shortest distance between opposite sides, roughly: area over the longest diagonal.
double narrowness(const Polygon& p)
{
    return 2 * polygon_area(p) / std::max({(p[2] - p[0]).norm(), (p[3] - p[1]).norm(), 1e-9});
}

double reach_of(const Polygon& p)
{
    const Vec2 middle = (p[0] + p[1] + p[2] + p[3]) / 4;
    double reach = 1e-9;
    for (const Vec2& corner : p) {
        reach = std::max(reach, (corner - middle).norm());
    }
    return reach;
}

//! The corner of the figure where a detail hides least of the model, near the element but not over it.
Vec2 free_corner(const StepPlace& place, const Vec2& at, double radius, const std::vector<Vec2>& model)
{
    const double edge = radius + 5;
    const double size = (place.box.max - place.box.min).norm();
    double least = 1e300;
    Vec2 best = Vec2::Zero();
    for (const double x : {place.box.max.x() - edge, place.box.min.x() + edge}) {
        for (const double y : {place.box.max.y() - edge, place.centre.y() - place.half.y() + radius - 1}) {
            const Vec2 corner(std::round(x), std::round(y));
            const double way = (corner - at).norm();
            const auto hidden =
                std::count_if(model.begin(), model.end(), [&](const Vec2& p) { return (p - corner).norm() < radius; });
            const double cost = static_cast<double>(hidden) / static_cast<double>(model.size()) + 0.15 * way / size +
                                (way < 1.8 * radius ? 10 - way / size : 0);
            if (cost < least - 1e-9) {
                least = cost;
                best = corner;
            }
        }
    }
    return best;
}

//! Points on the elements there and on the step's own, where they lie on the page.
std::vector<Vec2> model_on_page(const StepPlace& place, const FigureScene& scene, Face own,
                                const std::vector<Face>& others)
{
    std::vector<Vec2> points;
    const auto add = [&](Face f) {
        const Vec2 centre = place.centre + project(scene.camera, element_centre(*scene.surface, f));
        points.push_back(centre);
        for (const Vec2& corner : outline_of(scene, f)) {
            points.push_back(0.4 * centre + 0.6 * (place.centre + corner));
        }
    };
    add(own);
    std::for_each(others.begin(), others.end(), add);
    return points;
}

double inset_radius(const StepPlace& place)
{
    const Vec2 size = place.box.max - place.box.min;
    return std::clamp(0.185 * std::min(size.x(), 1.1 * size.y()), 30.0, 60.0);
}

Inset inset_at(const StepPlace& place, const Vec3& look_at, double extent, const std::vector<Vec2>& model)
{
    Inset inset;
    inset.radius = inset_radius(place);
    inset.centre = free_corner(place, place.centre + project(place.camera, look_at), inset.radius, model);
    inset.camera = place.camera;
    inset.camera.look_at = look_at;
    inset.camera.scale *= inset.radius / extent;
    return inset;
}

//! How far the detail reaches from the element's centre, in the figure's points: with its surroundings, but a thin one
//! as large as it fits. One that is as long as that and no larger then is cut off at its ends.
double detail_extent(const Polygon& p, double radius)
{
    constexpr double wanted = 45 / mm2_per_pt2;
    const double reach = reach_of(p);
    const double extent = std::clamp(radius * std::sqrt(polygon_area(p) / wanted), 1.05 * reach, 1.5 * reach);
    return std::min(extent, radius / least_magnified);
}

bool hard_to_see(const FigureScene& scene, Face f, const std::vector<Face>& others)
{
    const Polygon p = outline_of(scene, f);
    return narrowness(p) < enough_width || polygon_area(p) * mm2_per_pt2 * seen_part(scene, f, others) < enough_area;
}

//! The whole element when it is small in the figure; in the first steps, one joint.
std::optional<Inset> inset_for(int k, const Step& step, const StepPlace& place, const FigureScene& scene, Face f,
                               const std::vector<Face>& others)
{
    const Polygon p = outline_of(scene, f);
    if (hard_to_see(scene, f, others)) {
        return inset_at(place, element_centre(*scene.surface, f), detail_extent(p, inset_radius(place)),
                        model_on_page(place, scene, f, others));
    }
    if (k >= first_steps || step.joins.empty()) {
        return {};
    }
    const int side = step.joins.front().side;
    const Quad q = quad(*scene.surface, f);
    const Vec3 begin = scene.surface->point(Vertex(q[side]));
    const Vec3 end = scene.surface->point(Vertex(q[(side + 1) % 4]));
    const double whole_side = 0.58 * (p[(side + 1) % 4] - p[side]).norm();
    const double extent = std::min(whole_side, inset_radius(place) / least_magnified);
    const double along = 0.5 * extent / whole_side; // a side too long for the detail: about its first hook
    return inset_at(place, begin + along * (end - begin), extent, model_on_page(place, scene, f, others));
}

} // namespace

void place_insets(const Replay& replay, const AssemblyPlan& plan, std::vector<StepPlace>& places)
{
    std::vector<char> present(replay.surface.n_faces() + plan.temporary.size(), 0);
    std::vector<int> face;
    for (int k = 0; k < static_cast<int>(plan.steps.size()); ++k) {
        const Step& step = plan.steps[k];
        if (k == 0 || plan.steps[k - 1].stage != step.stage) {
            face = faces_of_elements(replay, plan, step.stage);
        }
        std::vector<Face> others;
        for (std::size_t e = 0; e < present.size(); ++e) {
            if (present[e] && static_cast<int>(e) != step.element && face[e] >= 0) {
                others.emplace_back(face[e]);
            }
        }
        const FigureScene scene{&stage_surface(replay, step.stage), places[k].camera};
        const Face f(face[step.element]);
        places[k].inset = inset_for(k, step, places[k], scene, f, others);
        present[step.element] = step.kind != StepKind::Remove;
    }
}

namespace {

//! Does the polygon reach into the disc about the origin?
bool meets_disc(const Polygon& p, double radius)
{
    bool inside = true; // is the origin
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 a = p[i];
        const Vec2 side = p[(i + 1) % p.size()] - a;
        const double t = std::clamp(-a.dot(side) / std::max(1e-12, side.squaredNorm()), 0.0, 1.0);
        if ((a + t * side).norm() < radius) {
            return true;
        }
        inside = inside && side.x() * a.y() - side.y() * a.x() > 0;
    }
    return inside;
}

//! Where an element's number hides nothing of the next one: on the element, near its middle, within \p radius. Nothing
//! when the next one covers it: a number there would seem to be its own.
std::optional<Vec2> place_of_number(const Polygon& element, Polygon own, double radius)
{
    constexpr double outside = 1e3;
    constexpr double hiding = 1e4;
    constexpr double half_number = 7.5; // points
    const Vec2 middle = (element[0] + element[1] + element[2] + element[3]) / 4;
    double least = 1e300;
    Vec2 best = middle;
    for (int i = 0; i < 81; ++i) {
        const double u = 0.1 * (1 + i % 9);
        const double v = 0.1 * (1 + i / 9);
        const Vec2 at = (1 - v) * ((1 - u) * element[0] + u * element[1]) + v * (u * element[2] + (1 - u) * element[3]);
        std::for_each(own.begin(), own.end(), [&](Vec2& corner) { corner -= at; });
        const double cost = (at - middle).norm() + (at.norm() > radius ? outside + at.norm() : 0) +
                            (meets_disc(own, half_number) ? hiding : 0);
        std::for_each(own.begin(), own.end(), [&](Vec2& corner) { corner += at; });
        if (cost < least) {
            least = cost;
            best = at;
        }
    }
    const Vec2 within = best * std::min(1.0, radius / std::max(1e-9, best.norm()));
    return least < hiding ? std::optional(within) : std::nullopt;
}

//! What an inset shows, back to front: the element and what it is joined to, with their hooks, among plain elements.
struct Detail
{
    std::vector<Face> behind;
    std::vector<DrawnPiece> pieces;
};

Detail detail(const FigureScene& scene, const DrawnPiece& own, double radius, const std::vector<Face>& built,
              const std::vector<Face>& joined)
{
    const std::vector<Face> round = faces_round(*scene.surface, own.face);
    const auto is_in = [](const std::vector<Face>& list, Face f) {
        return std::find(list.begin(), list.end(), f) != list.end();
    };
    std::vector<Face> shown = {own.face};
    std::copy_if(built.begin(), built.end(), std::back_inserter(shown),
                 [&](Face f) { return meets_disc(outline_of(scene, f), radius); });
    Detail result;
    bool own_drawn = false;
    for (const Face f : painter_order(scene, shown)) {
        if (f == own.face) {
            own_drawn = true;
            result.pieces.push_back(own);
        } else if (is_in(round, f) && from_outside(scene, f)) {
            result.pieces.push_back({f, Paint::Built, is_in(joined, f)});
        } else if (!own_drawn) { // what lies in front would hide what the detail is there to show
            result.behind.push_back(f);
        }
    }
    return result;
}

std::vector<Face> joined_faces(const Step& step, const std::vector<int>& face)
{
    std::vector<Face> joined;
    for (const Join& join : step.joins) {
        joined.emplace_back(face[join.to]);
    }
    return joined;
}

//! From the ring round the element in the figure to the detail.
void draw_leader(PdfCanvas& canvas, const Inset& inset, const Vec2& at, double ring)
{
    const Line line{0.8, 0x404040, 0};
    const Vec2 way = inset.centre - at;
    const double length = way.norm();
    if (length > ring + inset.radius) {
        canvas.stroke({at + way * (ring / length), inset.centre - way * (inset.radius / length)}, line);
    }
    canvas.arc(at, ring, 0, two_pi, line);
}

//! The distance to the nearest edge of the cell.
double room_round(const Vec2& at, const Box& box)
{
    return std::min((at - box.min).minCoeff(), (box.max - at).minCoeff());
}

} // namespace

void draw_inset(PdfCanvas& canvas, const BookletSources& sources, int k, const std::vector<int>& face,
                const std::vector<char>& present, const std::vector<int>& names)
{
    const Step& step = sources.plan.steps[k];
    const StepPlace& place = sources.layout.places[k];
    const Inset& inset = *place.inset;
    const FigureScene scene{&stage_surface(sources.replay, step.stage), inset.camera};
    const Face own(face[step.element]);
    std::vector<Face> built;
    for (std::size_t e = 0; e < present.size(); ++e) {
        if (present[e] && static_cast<int>(e) != step.element && face[e] >= 0) {
            built.emplace_back(face[e]);
        }
    }
    const Paint paint = step.kind == StepKind::Remove ? Paint::Removed : Paint::Next;
    const Detail shown = detail(scene, {own, paint}, inset.radius, built, joined_faces(step, face));
    const Vec2 spot = place.centre + project(place.camera, inset.camera.look_at);
    draw_leader(canvas, inset, spot,
                std::min(inset.radius * place.camera.scale / inset.camera.scale, room_round(spot, place.box) - 2));
    canvas.disc(inset.centre, inset.radius, 0xFFFFFF, {0.8, 0x404040, 0});
    canvas.clipped_to_disc(inset.centre, inset.radius - 0.4, [&] {
        canvas.shifted(inset.centre, [&] {
            for (const Face f : shown.behind) {
                draw_element(canvas, scene, f, Paint::Built);
            }
            draw_pieces(canvas, scene, shown.pieces, sources.contour);
            for (const Join& join : step.joins) {
                const Polygon joined = outline_of(scene, Face(face[join.to]));
                const bool near = ((joined[0] + joined[1] + joined[2] + joined[3]) / 4).norm() < 1.6 * inset.radius;
                const auto at = place_of_number(joined, outline_of(scene, own), inset.radius - 9);
                if (!near || !at) {
                    continue;
                }
                canvas.text(std::to_string(names[join.to]), *at + Vec2(0, 2.6),
                            {7.5, 0x000000, Align::Centre, 0xFFFFFF});
            }
        });
    });
}

} // namespace rhombloom
