#pragma once

#include "core/building/build_history.h"
#include "exporters/camera.h"
#include "exporters/pdf_canvas.h"

namespace rhombloom {

//! \brief The colours of the booklet. The next element is the only dark fill (L* 43); all others have L* >= 75, so
//! that it stands out in grey and for colour-blind readers.
namespace colour {
inline constexpr unsigned next = 0xC81E1E;
inline constexpr unsigned built_light = 0xF7F6F3;
inline constexpr unsigned built_dark = 0xD2D1CC;
inline constexpr unsigned inside = 0xB8C4D6;
inline constexpr unsigned chapter_light = 0xF0CD94;
inline constexpr unsigned chapter_dark = 0xDDB06A;
inline constexpr unsigned faint = 0xFCFCFC;
inline constexpr unsigned faint_inside = 0xEAEDF2;
inline constexpr unsigned faint_line = 0x8C8C8C;
inline constexpr unsigned ghost = 0xFFFFFF;
inline constexpr unsigned ghost_line = 0xCDCDCD;
inline constexpr unsigned line = 0x3A3A3A;
inline constexpr unsigned dot = 0x6A6A6A;
} // namespace colour

//! \brief A surface seen by a camera: what every figure is drawn from.
struct FigureScene
{
    const Surface* surface = nullptr;
    Camera camera;
};

//! \brief The four corners of an element on the paper, relative to the figure's centre.
Polygon outline_of(const FigureScene& scene, Face f);

//! \brief The faces from the farthest to the nearest: none is drawn before one it hides.
//! \details Where elements overlap on the paper, the pixels tell which lies in front; the order is a topological sort
//! of these facts, with the mean depth as tie-break. Any part of the result, in the same sequence, is right as well.
std::vector<Face> painter_order(const FigureScene& scene, const std::vector<Face>& faces);

//! \brief A face in a painting; or a face whose visible part over another is painted once more.
struct Painted
{
    Face face;
    Face over;                 //!< valid: only the part that lies in front of this face, drawn before it came
    std::vector<Polygon> part; //!< that part, convex pieces on the paper; empty: the whole face
};

//! \brief painter_order, and where no order of whole faces is right (they cut each other, or hide each other in a
//! circle) the parts that come to light again, each right after the face that hid it.
std::vector<Painted> painter_sequence(const FigureScene& scene, const std::vector<Face>& faces);

//! \brief How much of an element, 0..1, is in front of all of \p others, found by sampling.
double seen_part(const FigureScene& scene, Face f, const std::vector<Face>& others);

enum class Paint
{
    Ghost,
    Built,
    Chapter, //!< of the chapter that a picture announces
    Faint,   //!< there, but not what the picture is about
    Next,
    Removed
};

//! \brief One element: tinted by its slope and by which face is seen, dotted when it is flipped.
void draw_element(PdfCanvas& canvas, const FigureScene& scene, Face f, Paint paint);

//! \brief Parts of an element once more; see painter_sequence.
void draw_part(PdfCanvas& canvas, const FigureScene& scene, const Painted& painted, Paint paint);

//! \brief The fill of an element: by its slope, or its side when seen from inside, or what is done with it.
unsigned element_tint(const FigureScene& scene, Face f, Paint paint);

//! \brief The dots of a flipped element; nothing for others and for those seen from inside.
void draw_flip_dots(PdfCanvas& canvas, const FigureScene& scene, Face f, Paint paint);

//! \brief Is the element seen from outside?
bool from_outside(const FigureScene& scene, Face f);

//! \brief Area of a polygon, unsigned, in the square of its unit.
double polygon_area(const Polygon& polygon);

//! \brief The sides just joined, drawn thick where nothing built hides them.
void draw_joined_sides(PdfCanvas& canvas, const FigureScene& scene, Face f, const std::vector<int>& sides,
                       const std::vector<Face>& built);

struct Arrow
{
    std::vector<int> joined;                             //!< sides
    int away = 1;                                        //!< +1: the element goes in; -1: it comes out
    Box room{Vec2::Constant(-1e6), Vec2::Constant(1e6)}; //!< about the figure's centre, where the arrow has to stay
};

//! \brief An arrow that shows where the element comes from: across its free sides, else from outside.
void draw_arrow(PdfCanvas& canvas, const FigureScene& scene, Face f, const Arrow& arrow);

} // namespace rhombloom
