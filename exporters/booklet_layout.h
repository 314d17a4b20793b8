#pragma once

#include "exporters/booklet.h"
#include "exporters/figure.h"

namespace rhombloom {

//! A magnified detail in a corner of a figure: the next element and what it is hooked to, with the real hooks.
struct Inset
{
    Vec2 centre = Vec2::Zero(); //!< on the page
    double radius = 0;          //!< points
    Camera camera;              //!< the figure's, nearer and looking at the element
};

//! Where a step stands in the booklet and how it is seen.
struct StepPlace
{
    int page = 0;               //!< 1 = the cover
    int cell = 0;               //!< 0.. on its page, row by row
    Box box;                    //!< the cell on the page, points, y down
    Vec2 centre = Vec2::Zero(); //!< of the figure
    Vec2 half = Vec2::Zero();   //!< half the figure's size
    Camera camera;
    int view = 0; //!< index into viewpoints()
    Turn turn;    //!< from the step before
    std::optional<Inset> inset;
};

//! Steps of one component in a row: a chapter with its own title page.
struct Chapter
{
    std::string title;
    int component = 0;
    int first = 0; //!< step
    int count = 0;
    int page = 0; //!< its title page
    int rows = 1;
    int columns = 1;
};

struct BookletLayout
{
    PaperSize paper;
    std::vector<Chapter> chapters;
    std::vector<StepPlace> places; //!< one for each step
    int last_page = 0;             //!< the finished model
};

inline constexpr double page_margin = 40; //!< points
inline constexpr int front_pages = 4;     //!< cover, how to read, parts, joint

BookletLayout booklet_layout(const Replay& replay, const AssemblyPlan& plan, const BookletOptions& options);

//! \brief Decide which steps need a magnified detail, and place it in the corner where it hides
//! least of the model.
//! \details Wanted when less than 60 mm2 of the element can be seen or it is seen narrower than 6 mm, and in the first
//! steps, where the joint is new to the reader.
void place_insets(const Replay& replay, const AssemblyPlan& plan, std::vector<StepPlace>& places);

//! \brief The faces that some step in \p stage shows: the part of that stage's surface that is under construction.
std::vector<Face> shown_faces(const Replay& replay, const AssemblyPlan& plan, int stage);

//! \brief The number that the booklet calls each element by: its last insertion's step, counted from 1.
//! \param before only insertions before this step (0..) count; 0 for elements that are not there yet
std::vector<int> element_names(const AssemblyPlan& plan, std::size_t final_count, int before);

} // namespace rhombloom
