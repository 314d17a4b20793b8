#include "exporters/booklet_steps.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr int longest_run = 16;              // steps that share their drawn groups
constexpr double small_for_a_number = 350.0; // square points

//! Back to front: a group of elements that all steps of a run show, or a single element.
struct Item
{
    std::shared_ptr<const PdfGroup> group;
    int element = -1;
    int over = -1; //!< the element over which a part of this one is drawn once more
    Painted painted;
};

//! The steps that share a view, and what their pictures are put together from.
struct Run
{
    int first = 0;
    int end = 0;
    std::vector<char> present; //!< before the first step, by element
    std::vector<Item> items;
};

//! By chapter, stage and view.
using GhostKey = std::array<int, 3>;

void draw_painted(PdfCanvas& canvas, const FigureScene& scene, const Painted& painted, Paint paint)
{
    if (painted.over.is_valid()) {
        draw_part(canvas, scene, painted, paint);
    } else {
        draw_element(canvas, scene, painted.face, paint);
    }
}

} // namespace

struct StepPictures::State
{
    const PdfFont& font;
    const BookletSources& sources;
    std::map<int, std::vector<int>> faces; // of the elements, by stage
    std::vector<Run> runs;
    std::map<GhostKey, std::shared_ptr<const PdfGroup>> ghosts;

    const Step& step(int k) const { return sources.plan.steps[k]; }
    const StepPlace& place(int k) const { return sources.layout.places[k]; }
    const std::vector<int>& face(int k) const { return faces.at(step(k).stage); }
    int count() const { return static_cast<int>(sources.plan.steps.size()); }

    FigureScene scene(int k) const { return {&stage_surface(sources.replay, step(k).stage), place(k).camera}; }

    int chapter(int k) const
    {
        int c = 0;
        for (const Chapter& candidate : sources.layout.chapters) {
            c += candidate.first + candidate.count <= k;
        }
        return c;
    }

    GhostKey ghost_key(int k) const { return {chapter(k), step(k).stage, place(k).view}; }

    void find_runs();
    void draw_run(Run& run) const;
    std::shared_ptr<const PdfGroup> draw_ghost(int k) const;
};

void StepPictures::State::find_runs()
{
    std::vector<char> present(sources.replay.surface.n_faces() + sources.plan.temporary.size(), 0);
    for (int k = 0; k < count(); ++k) {
        if (!faces.contains(step(k).stage)) {
            faces[step(k).stage] = faces_of_elements(sources.replay, sources.plan, step(k).stage);
        }
        if (runs.empty() || k - runs.back().first == longest_run || ghost_key(k) != ghost_key(k - 1)) {
            runs.push_back({k, k, present, {}});
        }
        runs.back().end = k + 1;
        present[step(k).element] = step(k).kind != StepKind::Remove;
    }
}

std::shared_ptr<const PdfGroup> StepPictures::State::draw_ghost(int k) const
{
    const FigureScene seen = scene(k);
    return pdf_group(font, place(k).half.maxCoeff() + 4, [&](PdfCanvas& canvas) {
        for (const Face f : painter_order(seen, shown_faces(sources.replay, sources.plan, step(k).stage))) {
            draw_element(canvas, seen, f, Paint::Ghost);
        }
    });
}

void StepPictures::State::draw_run(Run& run) const
{
    std::vector<char> changing(run.present.size(), 0);
    std::vector<char> appears = run.present;
    for (int k = run.first; k < run.end; ++k) {
        changing[step(k).element] = 1;
        appears[step(k).element] = 1;
    }
    const std::vector<int>& face_of = face(run.first);
    std::map<int, int> element_of;
    std::vector<Face> shown;
    for (std::size_t e = 0; e < appears.size(); ++e) {
        if (appears[e] && face_of[e] >= 0) {
            shown.emplace_back(face_of[e]);
            element_of[face_of[e]] = static_cast<int>(e);
        }
    }
    const FigureScene seen = scene(run.first);
    const std::vector<Painted> order = painter_sequence(seen, shown);
    const auto element = [&](Face f) { return f.is_valid() ? element_of[f.idx()] : -1; };
    const auto changes = [&](Face f) { return f.is_valid() && changing[element_of[f.idx()]]; };
    for (std::size_t i = 0; i < order.size();) {
        std::size_t j = i;
        while (j < order.size() && !changes(order[j].face) && !changes(order[j].over)) {
            ++j;
        }
        if (j == i || run.end - run.first < 2) {
            run.items.push_back({nullptr, element(order[i].face), element(order[i].over), order[i]});
            ++i;
            continue;
        }
        run.items.push_back({pdf_group(font, place(run.first).half.maxCoeff() + 4,
                                       [&](PdfCanvas& canvas) {
                                           for (std::size_t m = i; m < j; ++m) {
                                               draw_painted(canvas, seen, order[m], Paint::Built);
                                           }
                                       }),
                             -1, -1, Painted()});
        i = j;
    }
}

StepPictures::StepPictures(const PdfFont& font, const BookletSources& sources)
    : state_(new State{font, sources, {}, {}, {}})
{
    State& s = *state_;
    s.find_runs();
    std::vector<int> ghosts; // a step that shows each
    for (int k = 0; k < s.count(); ++k) {
        if (s.ghosts.emplace(s.ghost_key(k), nullptr).second) {
            ghosts.push_back(k);
        }
    }
    std::vector<std::shared_ptr<const PdfGroup>> drawn(ghosts.size());
    const auto runs = static_cast<int>(s.runs.size());
    parallel_tasks(default_threads(), runs + static_cast<int>(ghosts.size()), [&](int i) {
        if (i < runs) {
            s.draw_run(s.runs[i]);
        } else {
            drawn[i - runs] = s.draw_ghost(ghosts[i - runs]);
        }
    });
    for (std::size_t i = 0; i < ghosts.size(); ++i) {
        s.ghosts[s.ghost_key(ghosts[i])] = drawn[i];
    }
}

StepPictures::~StepPictures() = default;

namespace {

//! One step being drawn in its cell.
struct StepDrawing
{
    PdfCanvas& canvas;
    const BookletSources& sources;
    const Run& run;
    std::shared_ptr<const PdfGroup> ghost;
    int k = 0;
    std::vector<int> face;
    std::vector<char> present; // before the step
    std::vector<int> names;
    FigureScene scene;

    const Step& step() const { return sources.plan.steps[k]; }
    const StepPlace& place() const { return sources.layout.places[k]; }

    std::vector<Face> built() const
    {
        std::vector<Face> faces;
        for (std::size_t e = 0; e < present.size(); ++e) {
            if (present[e] && static_cast<int>(e) != step().element && face[e] >= 0) {
                faces.emplace_back(face[e]);
            }
        }
        return faces;
    }

    void draw() const;
    void draw_items() const;
    void draw_picture() const;
    void draw_names(const std::vector<Face>& others) const;
    void draw_words() const;
    void draw_turn() const;
};

void StepDrawing::draw() const
{
    const Box& box = place().box;
    canvas.outline({box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}}, {0.6, 0xB0B0B0, 0});
    draw_words();
    canvas.figure(step_words(sources, k, names), [&] {
        draw_picture();
        if (place().inset) {
            draw_inset(canvas, sources, k, face, present, names);
        }
    });
}

void StepDrawing::draw_names(const std::vector<Face>& others) const
{
    for (const Join& join : step().joins) {
        const Face f(face[join.to]);
        const bool small = polygon_area(outline_of(scene, f)) < small_for_a_number;
        if ((small && place().inset) || seen_part(scene, f, others) < 0.5) {
            continue; // the detail names it
        }
        const Vec2 at = place().centre + project(scene.camera, element_centre(*scene.surface, f));
        canvas.text(std::to_string(names[join.to]), at + Vec2(0, 2.8), {8, 0x000000, Align::Centre, 0xFFFFFF});
    }
}

void StepDrawing::draw_items() const
{
    const int own = step().element;
    const auto there = [&](int element) { return element == own || present[element]; };
    for (const Item& item : run.items) {
        if (item.group) {
            canvas.place(item.group, Vec2::Zero());
        } else if (there(item.element) && (item.over < 0 || there(item.over))) {
            const Paint paint = step().kind == StepKind::Remove ? Paint::Removed : Paint::Next;
            draw_painted(canvas, scene, item.painted, item.element == own ? paint : Paint::Built);
        }
    }
}

void StepDrawing::draw_picture() const
{
    std::vector<int> sides;
    for (const Join& join : step().joins) {
        sides.push_back(join.side);
    }
    const std::vector<Face> others = built();
    const Face own(face[step().element]);
    canvas.shifted(place().centre, [&] {
        canvas.place(ghost, Vec2::Zero());
        draw_items();
        draw_joined_sides(canvas, scene, own, sides, others);
        const bool outward = step().kind == StepKind::Remove || step().kind == StepKind::Unhook;
        const Vec2 gap = Vec2::Constant(4);
        draw_arrow(canvas, scene, own,
                   {sides,
                    outward ? -1 : 1,
                    {place().box.min - place().centre + gap, place().box.max - place().centre - gap}});
    });
    draw_names(others);
}

void StepDrawing::draw_words() const
{
    const Box& box = place().box;
    const double width = box.max.x() - box.min.x();
    const bool reopening = step().kind == StepKind::Remove || step().kind == StepKind::Unhook;
    if (reopening) {
        const Vec2 low = box.min + Vec2(1, 32);
        canvas.fill({low, low + Vec2(width - 2, 0), low + Vec2(width - 2, 26), low + Vec2(0, 26)}, 0xFBE9B7);
    }
    canvas.tagged("H2", [&] {
        canvas.text("Step " + std::to_string(k + 1), box.min + Vec2(8, 25), {21, 0x000000, Align::Left, 0});
    });
    canvas.tagged("P", [&] {
        canvas.paragraph(step_words(sources, k, names), box.min + Vec2(8, 41), width - 16, {10, 0x101010}, 12);
    });
    draw_turn();
}

void StepDrawing::draw_turn() const
{
    const Box& box = place().box;
    const double width = box.max.x() - box.min.x();
    const std::vector<std::string> turn = turn_words(place().turn);
    if (turn.empty()) {
        return;
    }
    double longest = 0;
    for (const std::string& line : turn) {
        longest = std::max(longest, canvas.text_width(line, 9));
    }
    draw_turn_arrow(canvas, box.min + Vec2(width - longest - 22, 17), 8, place().turn.round < 0);
    canvas.tagged("P", [&] {
        for (std::size_t i = 0; i < turn.size(); ++i) {
            const double y = (turn.size() == 1 ? 20 : 14) + 11.0 * static_cast<double>(i);
            canvas.text(turn[i], box.min + Vec2(width - 8, y), {9, 0x004080, Align::Right, 0});
        }
    });
}

} // namespace

void StepPictures::draw(PdfCanvas& canvas, int first, int end) const
{
    const State& s = *state_;
    const auto run_of = [&](int k) {
        return std::find_if(s.runs.begin(), s.runs.end(), [&](const Run& run) { return k < run.end; });
    };
    std::vector<char> present = run_of(first)->present;
    std::vector<int> names = element_names(s.sources.plan, s.sources.replay.surface.n_faces(), first);
    for (int k = run_of(first)->first; k < end; ++k) {
        const Step& step = s.step(k);
        if (step.kind == StepKind::Insert) {
            names[step.element] = k + 1;
        }
        if (k >= first) {
            StepDrawing{canvas,  s.sources, *run_of(k), s.ghosts.at(s.ghost_key(k)), k, s.face(k),
                        present, names,     s.scene(k)}
                .draw();
        }
        present[step.element] = step.kind != StepKind::Remove;
    }
}

void draw_turn_arrow(PdfCanvas& canvas, const Vec2& centre, double radius, bool clockwise)
{
    const double way = clockwise ? 1 : -1;
    const double start = -pi / 2 + way * 0.5;
    const double end = start + way * 4.9;
    canvas.arc(centre, radius, start, end, {1.6, 0x004080, 0});
    const Vec2 tip = centre + radius * Vec2(std::cos(end + way * 0.45), std::sin(end + way * 0.45));
    const Vec2 base = centre + radius * Vec2(std::cos(end), std::sin(end));
    const Vec2 out = (base - centre) * (0.45);
    canvas.fill({tip, base + out, base - out}, 0x004080);
}

} // namespace rhombloom
