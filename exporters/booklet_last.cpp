#include <algorithm>
#include <array>
#include <optional>

#include "exporters/booklet_pages.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_openings = 6; // told by the elements round them

//! Where the plane of a triangle is at (x, y), or nothing beside it.
std::optional<double> height_at(const std::array<Vec3, 3>& t, const Vec3& at)
{
    const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    const double area = turn(t[0], t[1], t[2]);
    const double u = turn(at, t[1], t[2]) / area;
    const double v = turn(t[0], at, t[2]) / area;
    const bool inside = area != 0 && u >= 0 && v >= 0 && u + v <= 1;
    return inside ? std::optional(u * t[0].z() + v * t[1].z() + (1 - u - v) * t[2].z()) : std::nullopt;
}

//! The highest point of the model above its centre of mass: it hangs there as it stands. Where there is nothing above
//! the centre: the highest of all.
Vec3 hanging_point(const Surface& surface)
{
    Vec3 centre = Vec3::Zero();
    Vec3 highest = Vec3::Constant(-1e300);
    for (const Face f : surface.faces()) {
        centre += element_centre(surface, f) / static_cast<double>(surface.n_faces());
    }
    std::optional<double> top;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const auto corner = [&](int k) -> Vec3 { return surface.point(Vertex(q[k])); };
        for (const auto& t :
             {std::array{corner(0), corner(1), corner(2)}, std::array{corner(0), corner(2), corner(3)}}) {
            const std::optional<double> z = height_at(t, centre);
            top = z && (!top || *z > *top) ? z : top;
            highest = t[0].z() > highest.z() ? t[0] : highest;
        }
    }
    return top && *top > centre.z() ? Vec3(centre.x(), centre.y(), *top) : highest;
}

using Names = std::vector<int>;

std::string named(const std::vector<int>& faces, const Names& names)
{
    std::vector<int> numbers;
    for (const int f : faces) {
        numbers.push_back(names[f]);
    }
    return listed(std::move(numbers));
}

std::string hanging_words(const BookletSources& sources)
{
    const bool held = std::any_of(sources.openings.begin(), sources.openings.end(), [](const NamedOpening& opening) {
        return opening.purpose.find("holder") != std::string::npos;
    });
    return held ? "To hang it, lead the cord through a hole where corners meet at the top; the lamp holder has an "
                  "opening of its own. "
                : "To hang it, lead the cord through the hole where corners meet at the top, or hook the last elements "
                  "round the lamp holder. ";
}

//! What the openings are for, and where they are.
std::string opening_words(const BookletSources& sources, const Names& names)
{
    std::string words;
    const std::size_t count = std::min(sources.openings.size(), most_openings);
    for (std::size_t i = 0; i < count; ++i) {
        const NamedOpening& opening = sources.openings[i];
        words += (i == 0 ? "Openings: " : "; ") + opening.purpose + " between " + named(opening.beside, names);
    }
    words += sources.openings.size() > count ? "; " + std::to_string(sources.openings.size() - count) + " more" : "";
    return words.empty() ? words : words + ". ";
}

//! Is the last element the one to take out to reach the bulb? Beside the hatch that the design names; else, the one
//! that closed the shape.
bool last_is_hatch(const BookletSources& sources)
{
    const Step& last = sources.plan.steps.back();
    bool named = false;
    bool beside = false;
    for (const NamedOpening& opening : sources.openings) {
        if (names_hatch(opening.purpose)) {
            named = true;
            beside = beside || std::count(opening.beside.begin(), opening.beside.end(), last.element) > 0;
        }
    }
    return last.kind == StepKind::Insert && (named ? beside : last.joins.size() >= 3);
}

std::string hatch_words(const BookletSources& sources, const Names& names)
{
    const std::vector<Step>& steps = sources.plan.steps;
    std::vector<int> round;
    for (const Join& join : steps.back().joins) {
        round.push_back(join.to);
    }
    return "The dark red element is the bulb hatch: to reach the bulb, unhook it, and afterwards hook it in again as "
           "step " +
           std::to_string(steps.size()) + " shows (its neighbours are " + named(round, names) + "). ";
}

//! Are most of the elements round it seen, from outside?
bool is_seen(const NamedOpening& opening, const FigureScene& scene, const std::vector<Face>& all)
{
    const auto seen = std::count_if(opening.beside.begin(), opening.beside.end(), [&](int f) {
        return from_outside(scene, Face(f)) && seen_part(scene, Face(f), all) > 0.5;
    });
    return 2 * static_cast<std::size_t>(seen) > opening.beside.size();
}

//! The purpose of each opening, written into it where it is seen.
void draw_openings(PdfCanvas& canvas, const BookletSources& sources, const Camera& camera)
{
    const FigureScene scene{&sources.replay.surface, camera};
    const auto faces = sources.replay.surface.faces();
    const std::vector<Face> all(faces.begin(), faces.end());
    for (const NamedOpening& opening : sources.openings) {
        if (is_seen(opening, scene, all)) {
            canvas.text(opening.purpose, project(camera, opening.middle) + Vec2(0, 3),
                        {10, 0x000000, Align::Centre, 0xFFFFFF});
        }
    }
}

} // namespace

void draw_last_page(PdfCanvas& canvas, const BookletSources& sources)
{
    const PaperSize& paper = sources.layout.paper;
    draw_heading(canvas, sources, "Finished");
    if (sources.plan.steps.empty()) {
        return;
    }
    const bool hatch = last_is_hatch(sources);
    const int view = sources.layout.places.back().view;
    const double width = paper.width - 2 * page_margin;
    const Vec2 centre(paper.width / 2, paper.height * 0.47);
    const Vec2 half(width / 2, paper.height * 0.29);
    canvas.figure("The finished model, hung from its top.", [&] {
        const Camera camera = model_camera(sources, view, half);
        const Vec2 top = centre + project(camera, hanging_point(sources.replay.surface));
        canvas.stroke({Vec2(top.x(), page_margin + 44), top}, {2.2, 0x404040, 0}); // the cord
        draw_model(canvas, sources, centre, half, view, hatch ? sources.plan.steps.back().element : -1);
        canvas.shifted(centre, [&] { draw_openings(canvas, sources, camera); });
    });
    const Names names =
        element_names(sources.plan, sources.replay.surface.n_faces(), static_cast<int>(sources.plan.steps.size()));
    const std::string words =
        hanging_words(sources) + (hatch ? hatch_words(sources, names) : "") + opening_words(sources, names);
    canvas.tagged(
        "P", [&] { canvas.paragraph(words, Vec2(page_margin, paper.height - page_margin - 76), width, {11}, 15); });
}

} // namespace rhombloom
