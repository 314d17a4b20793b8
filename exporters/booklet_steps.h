#pragma once

#include "core/building/bulb_hatch.h"
#include "exporters/booklet_layout.h"
#include "exporters/figure_hooks.h"

namespace rhombloom {

//! What the pages of one booklet share.
struct BookletSources
{
    const Replay& replay;
    const Element& element;
    const AssemblyPlan& plan;
    const BookletLayout& layout;
    PieceContour contour;               //!< of the element with its hooks
    std::vector<NamedOpening> openings; //!< of the finished model
};

//! \brief The pictures of a booklet's steps.
//! \details Steps that share a view share what does not change between them: the ghost of the target, and runs of built
//! elements that no element of these steps comes between. That is drawn here; then pages may be drawn at the same time.
class StepPictures
{
public:
    //! \param font, sources must live as long as the pictures
    StepPictures(const PdfFont& font, const BookletSources& sources);
    ~StepPictures();

    //! \brief Draw steps \p first ... \p end - 1 in their cells.
    void draw(PdfCanvas& canvas, int first, int end) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

//! \brief The magnified detail of step \p k: built elements near the step's element with their hooks.
//! \param face of each element in the step's stage  \param present which elements are there, the step's aside
void draw_inset(PdfCanvas& canvas, const BookletSources& sources, int k, const std::vector<int>& face,
                const std::vector<char>& present, const std::vector<int>& names);

//! \brief What to do in step \p k, in words: which sides go where. Elements are called by the step that put them in.
std::string step_words(const BookletSources& sources, int k, const std::vector<int>& names);

//! \brief "3, 7 and 12", in ascending order.
std::string listed(std::vector<int> names);

//! \brief "turn 72° right" and "tip 35° toward you": how to turn the model; empty when the view stays.
std::vector<std::string> turn_words(const Turn& turn);

//! \brief A circular arrow of the given radius, clockwise or counter-clockwise.
void draw_turn_arrow(PdfCanvas& canvas, const Vec2& centre, double radius, bool clockwise);

} // namespace rhombloom
