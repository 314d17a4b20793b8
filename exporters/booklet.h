#pragma once

#include "core/building/assembly_plan.h"
#include "exporters/paper.h"
#include "exporters/save.h"

namespace rhombloom {

struct BookletOptions
{
    Paper paper = Paper::A4;
    std::string title;      //!< empty: the design's, or "Puzzle lamp"
    std::string material;   //!< for the list of parts; empty: the element's thickness only
    int sheets = 0;         //!< cut sheets, for the cover; 0: not mentioned
    int steps_per_page = 0; //!< 1, 2, 4 or 6; 0: chosen so that the next element is easy to see
};

struct BookletReport
{
    int pages = 0;
    int chapters = 0;
    int view_turns = 0;
    int insets = 0; //!< steps with a magnified detail
};

struct BookletFiles
{
    FileSet files; //!< booklet.pdf, booklet-imposed.pdf, plan.json
    BookletReport report;
};

//! \brief Refuses a title or a part's name that the booklet cannot write. Quick: to be asked before any long work.
Expected<void> check_booklet_names(const Design& design);

//! \brief Draw the assembly plan as a booklet, once page by page and once imposed for folding, and write the plan with
//! the page, cell and camera of each step (DESIGN.md section 7).
//! \details Refuses names as check_booklet_names() does. Dates in the files are SOURCE_DATE_EPOCH or
//! a fixed one: the same design gives the same bytes.
Expected<BookletFiles> booklet_files(const Design& design, const Replay& replay, const AssemblyPlan& plan,
                                     const BookletOptions& options = {});

} // namespace rhombloom
