#include <algorithm>

#include "exporters/booklet_pages.h"
#include "exporters/hanging.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_openings = 6; // told by the elements round them

using Names = std::vector<int>;

std::string named(const std::vector<int>& faces, const Names& names)
{
    std::vector<int> numbers;
    for (const int f : faces) {
        numbers.push_back(names[f]);
    }
    return listed(std::move(numbers));
}

std::string hanging_words(const BookletSources& sources, std::size_t cords)
{
    if (cords > 1) {
        return "To hang it, lead a cord through a hole near each of the " + std::string(cords > 2 ? "three" : "two") +
               " places shown, and join them above its middle: it is open there. ";
    }
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

//! How the bulb is reached: through a hatch that the design names, by unhooking the last element, or both.
struct BulbWay
{
    const NamedOpening* hatch = nullptr;
    bool by_last = false; //!< it is beside the hatch or, where none is named, closed the shape
};

BulbWay bulb_way(const BookletSources& sources)
{
    const Step& last = sources.plan.steps.back();
    BulbWay way;
    for (const NamedOpening& opening : sources.openings) {
        if (!way.by_last && names_hatch(opening.purpose)) {
            way.hatch = &opening;
            way.by_last = std::count(opening.beside.begin(), opening.beside.end(), last.element) > 0;
        }
    }
    way.by_last = last.kind == StepKind::Insert && (way.hatch != nullptr ? way.by_last : last.joins.size() >= 3);
    return way;
}

//! A hatch that the design names is an opening; the element beside it is not called so too.
std::string bulb_words(const BookletSources& sources, const BulbWay& way, const Names& names)
{
    const std::string through =
        way.hatch == nullptr ? "" : "Reach the bulb through the opening \"" + way.hatch->purpose + "\". ";
    if (!way.by_last) {
        return through;
    }
    const std::vector<Step>& steps = sources.plan.steps;
    std::vector<int> round;
    for (const Join& join : steps.back().joins) {
        round.push_back(join.to);
    }
    const std::string unhook = way.hatch == nullptr
                                   ? "The dark red element is the bulb hatch: to reach the bulb, unhook it"
                                   : "Where that is too narrow, unhook the dark red element beside it";
    return through + unhook + ", and afterwards hook it in again as step " + std::to_string(steps.size()) +
           " shows (its neighbours are " + named(round, names) + "). ";
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

//! A cord to the highest point, or several that meet above the model: those in front of its middle, or the others.
struct Cords
{
    Camera camera;
    Vec2 centre; //!< of the figure
    Vec3 middle; //!< of the model
    std::vector<Vec3> ends;

    Vec2 at(const Vec3& p) const { return centre + project(camera, p); }

    Vec2 knot() const
    {
        double highest = at(ends.front()).y();
        for (const Vec3& end : ends) {
            highest = std::min(highest, at(end).y());
        }
        const double top = page_margin + 44;
        return ends.size() == 1 ? at(ends.front()) : Vec2(at(middle).x(), top + (highest - top) / 3);
    }

    void draw(PdfCanvas& canvas, bool in_front) const
    {
        const Line line{2.2, 0x404040, 0};
        if (!in_front) {
            canvas.stroke({Vec2(knot().x(), page_margin + 44), knot()}, line);
        }
        for (const Vec3& end : ends) {
            if (ends.size() > 1 && (depth(camera, end) > depth(camera, middle)) == in_front) {
                canvas.stroke({knot(), at(end)}, line);
            }
        }
    }
};

} // namespace

void draw_last_page(PdfCanvas& canvas, const BookletSources& sources)
{
    const PaperSize& paper = sources.layout.paper;
    draw_heading(canvas, sources, "Finished");
    if (sources.plan.steps.empty()) {
        return;
    }
    const BulbWay bulb = bulb_way(sources);
    const int view = sources.layout.places.back().view;
    const double width = paper.width - 2 * page_margin;
    const Vec2 centre(paper.width / 2, paper.height * 0.47);
    const Vec2 half(width / 2, paper.height * 0.29);
    const Surface& surface = sources.replay.surface;
    const Cords cords{model_camera(sources, view, half), centre, mass_centre(surface), hanging_points(surface)};
    canvas.figure("The finished model, hung from its top.", [&] {
        cords.draw(canvas, false);
        draw_model(canvas, sources, centre, half, view, bulb.by_last ? sources.plan.steps.back().element : -1);
        cords.draw(canvas, true);
        canvas.shifted(centre, [&] { draw_openings(canvas, sources, cords.camera); });
    });
    const Names names =
        element_names(sources.plan, sources.replay.surface.n_faces(), static_cast<int>(sources.plan.steps.size()));
    const std::string words =
        hanging_words(sources, cords.ends.size()) + bulb_words(sources, bulb, names) + opening_words(sources, names);
    canvas.tagged(
        "P", [&] { canvas.paragraph(words, Vec2(page_margin, paper.height - page_margin - 76), width, {11}, 15); });
}

} // namespace rhombloom
