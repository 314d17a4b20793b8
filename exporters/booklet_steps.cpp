#include "exporters/booklet_steps.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rhombloom {

namespace {

constexpr int longest_run = 16; // steps that share their drawn groups

//! The steps that share a view, and what their pictures are put together from.
struct Run
{
    int first = 0;
    int end = 0;
    //! Back to front: a group of elements that all steps show, or a single element.
    struct Item
    {
        int group = -1;
        int element = -1;
        int over = -1; //!< the element over which a part of this one is drawn once more
        Painted painted;
    };
    std::vector<Item> items;
};

} // namespace

namespace {

void draw_painted(PdfCanvas& canvas, const Scene& scene, const Painted& painted, Paint paint)
{
    if (painted.over.is_valid()) {
        draw_part(canvas, scene, painted, paint);
    } else {
        draw_element(canvas, scene, painted.face, paint);
    }
}

} // namespace

struct StepDrawer::State
{
    PdfCanvas& canvas;
    BookletSources sources;
    std::vector<char> present;
    std::vector<int> names;
    Run run;
    std::map<std::array<int, 3>, int> ghosts; // chapter, stage, view -> group
    int stage = -1;
    std::vector<int> face; // of the elements in that stage
    int insets = 0;

    const Step& step(int k) const { return sources.plan.steps[k]; }
    const StepPlace& place(int k) const { return sources.layout.places[k]; }

    Scene scene(int k) const { return {&stage_surface(sources.replay, step(k).stage), place(k).camera}; }

    int chapter(int k) const
    {
        int c = 0;
        for (const Chapter& candidate : sources.layout.chapters) {
            c += candidate.first + candidate.count <= k;
        }
        return c;
    }

    bool same_picture(int a, int b) const
    {
        return chapter(a) == chapter(b) && step(a).stage == step(b).stage && place(a).view == place(b).view;
    }

    int ghost(int k);
    void start_run(int first);
    std::vector<Face> built(int k) const;
    void draw_picture(int k);
    void draw_names(int k);
    void draw_words(int k);
};

int StepDrawer::State::ghost(int k)
{
    const auto [entry, fresh] = ghosts.emplace(std::array{chapter(k), step(k).stage, place(k).view}, -1);
    if (fresh) {
        const Scene seen = scene(k);
        const std::vector<Face> faces = painter_order(seen, shown_faces(sources.replay, sources.plan, step(k).stage));
        entry->second = canvas.group(place(k).half.maxCoeff() + 4, [&] {
            for (const Face f : faces) {
                draw_element(canvas, seen, f, Paint::Ghost);
            }
        });
    }
    return entry->second;
}

void StepDrawer::State::start_run(int first)
{
    run = Run{first, first + 1, {}};
    const int count = static_cast<int>(sources.plan.steps.size());
    while (run.end < count && run.end < first + longest_run && same_picture(first, run.end)) {
        ++run.end;
    }
    std::vector<char> changing(present.size(), 0);
    std::vector<char> appears = present;
    for (int k = first; k < run.end; ++k) {
        changing[step(k).element] = 1;
        appears[step(k).element] = 1;
    }
    std::map<int, int> element_of;
    std::vector<Face> faces;
    for (std::size_t e = 0; e < appears.size(); ++e) {
        if (appears[e] && face[e] >= 0) {
            faces.emplace_back(face[e]);
            element_of[face[e]] = static_cast<int>(e);
        }
    }
    const Scene seen = scene(first);
    const std::vector<Painted> order = painter_sequence(seen, faces);
    const auto element = [&](Face f) { return f.is_valid() ? element_of[f.idx()] : -1; };
    const auto changes = [&](Face f) { return f.is_valid() && changing[element_of[f.idx()]]; };
    for (std::size_t i = 0; i < order.size();) {
        std::size_t j = i;
        while (j < order.size() && !changes(order[j].face) && !changes(order[j].over)) {
            ++j;
        }
        if (j == i || run.end - first < 2) {
            run.items.push_back({-1, element(order[i].face), element(order[i].over), order[i]});
            ++i;
            continue;
        }
        const int group = canvas.group(place(first).half.maxCoeff() + 4, [&] {
            for (std::size_t m = i; m < j; ++m) {
                draw_painted(canvas, seen, order[m], Paint::Built);
            }
        });
        run.items.push_back({group, -1, -1, Painted()});
        i = j;
    }
}

std::vector<Face> StepDrawer::State::built(int k) const
{
    std::vector<Face> faces;
    for (std::size_t e = 0; e < present.size(); ++e) {
        if (present[e] && static_cast<int>(e) != step(k).element && face[e] >= 0) {
            faces.emplace_back(face[e]);
        }
    }
    return faces;
}

void StepDrawer::State::draw_names(int k)
{
    const Scene seen = scene(k);
    const std::vector<Face> others = built(k);
    for (const Join& join : step(k).joins) {
        const Face f(face[join.to]);
        if (seen_part(seen, f, others) < 0.5) {
            continue;
        }
        const Vec2 at = place(k).centre + project(seen.camera, element_centre(*seen.surface, f));
        canvas.text(std::to_string(names[join.to]), at + Vec2(0, 2.8), {8, 0x000000, Align::Centre, 0xFFFFFF});
    }
}

void StepDrawer::State::draw_picture(int k)
{
    const Scene seen = scene(k);
    const Vec2 centre = place(k).centre;
    canvas.place(ghost(k), centre);
    const StepKind kind = step(k).kind;
    std::vector<int> sides;
    for (const Join& join : step(k).joins) {
        sides.push_back(join.side);
    }
    const Face own(face[step(k).element]);
    canvas.shifted(centre, [&] {
        for (const Run::Item& item : run.items) {
            if (item.group >= 0) {
                canvas.place(item.group, Vec2::Zero());
                continue;
            }
            const int own_element = step(k).element;
            const bool hider = item.over < 0 || item.over == own_element || present[item.over];
            if (item.element == own_element && hider) {
                draw_painted(canvas, seen, item.painted, kind == StepKind::Remove ? Paint::Removed : Paint::Next);
            } else if (hider && present[item.element]) {
                draw_painted(canvas, seen, item.painted, Paint::Built);
            }
        }
        draw_joined_sides(canvas, seen, own, sides, built(k));
        const bool outward = kind == StepKind::Remove || kind == StepKind::Unhook;
        draw_arrow(canvas, seen, own, sides, outward ? -1 : 1);
    });
    draw_names(k);
}

void StepDrawer::State::draw_words(int k)
{
    const Box& box = place(k).box;
    const double width = box.max.x() - box.min.x();
    const bool reopening = step(k).kind == StepKind::Remove || step(k).kind == StepKind::Unhook;
    if (reopening) {
        const Vec2 low = box.min + Vec2(1, 32);
        canvas.fill({low, low + Vec2(width - 2, 0), low + Vec2(width - 2, 26), low + Vec2(0, 26)}, 0xFBE9B7);
    }
    canvas.tagged("H2", [&] {
        canvas.text("Step " + std::to_string(k + 1), box.min + Vec2(8, 25), {21, 0x000000, Align::Left, 0});
    });
    canvas.tagged("P", [&] {
        canvas.paragraph(step_words(sources, k, names), box.min + Vec2(8, 42), width - 16, {9, 0x202020}, 11.5);
    });
    const std::vector<std::string> turn = turn_words(place(k).turn);
    if (turn.empty()) {
        return;
    }
    double longest = 0;
    for (const std::string& line : turn) {
        longest = std::max(longest, canvas.text_width(line, 9));
    }
    draw_turn_arrow(canvas, box.min + Vec2(width - longest - 22, 17), 8, place(k).turn.round < 0);
    canvas.tagged("P", [&] {
        for (std::size_t i = 0; i < turn.size(); ++i) {
            const double y = (turn.size() == 1 ? 20 : 14) + 11.0 * static_cast<double>(i);
            canvas.text(turn[i], box.min + Vec2(width - 8, y), {9, 0x004080, Align::Right, 0});
        }
    });
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

StepDrawer::StepDrawer(PdfCanvas& canvas, const BookletSources& sources)
    : state_(new State{canvas, sources, {}, {}, {}, {}, -1, {}, 0})
{
    state_->present.assign(sources.replay.surface.n_faces() + sources.plan.temporary.size(), 0);
    state_->names.assign(state_->present.size(), 0);
}

StepDrawer::~StepDrawer() = default;

int StepDrawer::insets() const
{
    return state_->insets;
}

void StepDrawer::draw(int k)
{
    State& s = *state_;
    const Step& step = s.step(k);
    if (step.stage != s.stage) {
        s.stage = step.stage;
        s.face = faces_of_elements(s.sources.replay, s.sources.plan, step.stage);
    }
    if (k >= s.run.end) {
        s.start_run(k);
    }
    if (step.kind == StepKind::Insert) {
        s.names[step.element] = k + 1;
    }
    const Box& box = s.place(k).box;
    s.canvas.outline({box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}}, {0.6, 0xB0B0B0, 0});
    s.draw_words(k);
    s.canvas.figure(step_words(s.sources, k, s.names), [&] {
        s.draw_picture(k);
        if (s.place(k).inset) {
            ++s.insets;
            draw_inset(s.canvas, s.sources, k, s.face, s.present, s.names);
        }
    });
    s.present[step.element] = step.kind != StepKind::Remove;
}

} // namespace rhombloom
