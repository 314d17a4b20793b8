#include "exporters/booklet_layout.h"

#include <algorithm>
#include <map>

namespace rhombloom {

namespace {

constexpr double header = 34; // above the cells
constexpr double footer = 30; // below them
constexpr double gutter = 14; // between them
constexpr double words = 70;  // above a figure, for the step's text

std::vector<Chapter> chapters(const Replay& replay, const AssemblyPlan& plan)
{
    std::vector<Chapter> result;
    for (int k = 0; k < static_cast<int>(plan.steps.size()); ++k) {
        const int component = plan.steps[k].component;
        if (result.empty() || result.back().component != component) {
            Chapter chapter;
            chapter.component = component;
            chapter.title = replay.surface.components[component];
            chapter.first = k;
            result.push_back(chapter);
        }
        ++result.back().count;
    }
    return result;
}

Box cell_box(const PaperSize& paper, const Chapter& chapter, int cell)
{
    const double width = (paper.width - 2 * page_margin - (chapter.columns - 1) * gutter) / chapter.columns;
    const double top = page_margin + header;
    const double height = (paper.height - top - page_margin - footer - (chapter.rows - 1) * gutter) / chapter.rows;
    const Vec2 corner(page_margin + (cell % chapter.columns) * (width + gutter),
                      top + (cell / chapter.columns) * (height + gutter));
    return {corner, corner + Vec2(width, height)};
}

void place_in_cell(StepPlace& place)
{
    const Vec2 low = place.box.min + Vec2(10, words);
    const Vec2 high = place.box.max - Vec2(10, 12);
    place.centre = ((low + high) / 2).array().round(); // whole points: shared groups land on the same grid
    place.half = (high - low) / 2;
}

//! One camera scale for all steps of a chapter that are drawn in the same stage.
void set_cameras(const Replay& replay, const AssemblyPlan& plan, const Chapter& chapter, std::vector<StepPlace>& places)
{
    std::map<int, std::vector<int>> views;
    const auto first = chapter.first;
    for (int k = first; k < first + chapter.count; ++k) {
        views[plan.steps[k].stage].push_back(places[k].view);
    }
    std::map<int, Camera> camera;
    for (const auto& [stage, used] : views) {
        camera[stage] =
            fitted_camera(stage_surface(replay, stage), shown_faces(replay, plan, stage), used, places[first].half);
    }
    for (int k = first; k < first + chapter.count; ++k) {
        places[k].camera = camera[plan.steps[k].stage];
        places[k].camera.view = viewpoints()[places[k].view];
    }
}

void lay_out(const Replay& replay, const AssemblyPlan& plan, const PaperSize& paper, const Chapter& chapter,
             std::vector<StepPlace>& places)
{
    const int cells = chapter.rows * chapter.columns;
    for (int i = 0; i < chapter.count; ++i) {
        StepPlace& place = places[chapter.first + i];
        place.page = chapter.page + 1 + i / cells;
        place.cell = i % cells;
        place.box = cell_box(paper, chapter, place.cell);
        place_in_cell(place);
    }
    set_cameras(replay, plan, chapter, places);
}

//! Median area of the next element in the chapter's figures, mm2 on paper.
double median_area(const Replay& replay, const AssemblyPlan& plan, const Chapter& chapter,
                   const std::vector<StepPlace>& places)
{
    std::vector<double> areas;
    std::map<int, std::vector<int>> faces;
    for (int k = chapter.first; k < chapter.first + chapter.count; ++k) {
        const Step& step = plan.steps[k];
        auto& face = faces[step.stage];
        if (face.empty()) {
            face = faces_of_elements(replay, plan, step.stage);
        }
        const FigureScene scene{&stage_surface(replay, step.stage), places[k].camera};
        areas.push_back(polygon_area(outline_of(scene, Face(face[step.element]))) * (25.4 / 72) * (25.4 / 72));
    }
    std::sort(areas.begin(), areas.end());
    return areas[areas.size() / 2];
}

void use_grid(Chapter& chapter, int cells)
{
    chapter.columns = cells >= 4 ? 2 : 1;
    chapter.rows = cells / chapter.columns;
}

void choose_grid(const Replay& replay, const AssemblyPlan& plan, const BookletOptions& options, const PaperSize& paper,
                 Chapter& chapter, std::vector<StepPlace>& places)
{
    if (options.steps_per_page > 0) {
        use_grid(chapter, options.steps_per_page);
    } else if (chapter.count <= 4) {
        use_grid(chapter, chapter.count <= 2 ? chapter.count : 4);
    } else {
        use_grid(chapter, 6);
        lay_out(replay, plan, paper, chapter, places);
        use_grid(chapter, median_area(replay, plan, chapter, places) >= 100 ? 6 : 4);
    }
    lay_out(replay, plan, paper, chapter, places);
}

} // namespace

std::vector<Face> shown_faces(const Replay& replay, const AssemblyPlan& plan, int stage)
{
    const std::vector<char> shown = shown_elements(plan, replay.surface.n_faces(), stage);
    const std::vector<int> face = faces_of_elements(replay, plan, stage);
    std::vector<Face> result;
    for (std::size_t e = 0; e < shown.size(); ++e) {
        if (shown[e] && face[e] >= 0) {
            result.emplace_back(face[e]);
        }
    }
    return result;
}

std::vector<int> element_names(const AssemblyPlan& plan, std::size_t final_count, int before)
{
    std::vector<int> names(final_count + plan.temporary.size(), 0);
    for (int k = 0; k < before; ++k) {
        if (plan.steps[k].kind == StepKind::Insert) {
            names[plan.steps[k].element] = k + 1;
        }
    }
    return names;
}

BookletLayout booklet_layout(const Replay& replay, const AssemblyPlan& plan, const BookletOptions& options)
{
    BookletLayout layout;
    layout.paper = paper_size(options.paper);
    layout.chapters = chapters(replay, plan);
    layout.places.resize(plan.steps.size());
    const std::vector<int> views = held_views(replay, plan);
    for (std::size_t k = 0; k < views.size(); ++k) {
        layout.places[k].view = views[k];
        layout.places[k].turn = k > 0 ? turn_between(views[k - 1], views[k]) : Turn{};
    }
    int page = front_pages;
    for (Chapter& chapter : layout.chapters) {
        chapter.page = ++page;
        choose_grid(replay, plan, options, layout.paper, chapter, layout.places);
        page = layout.places[chapter.first + chapter.count - 1].page;
    }
    place_insets(replay, plan, layout.places);
    layout.last_page = page + 1;
    return layout;
}

} // namespace rhombloom
