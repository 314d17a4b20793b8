#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "exporters/drawing.h"
#include "exporters/pdf_font.h"
#include "exporters/pdf_page.h"

namespace rhombloom {

using Polygon = std::vector<Vec2>; //!< points (1/72 inch), origin in the page's upper left corner, y down

enum class Align
{
    Left,
    Centre,
    Right
};

struct TextStyle
{
    double size = 9; //!< points
    unsigned rgb = 0x202020;
    Align align = Align::Left;
    unsigned halo = 0; //!< colour of a rounded bar behind the letters; 0: none
};

struct Line
{
    double width = 0.5; //!< points
    unsigned rgb = 0x303030;
    double dash = 0; //!< length of dashes and gaps; 0: solid
};

//! \brief One page of a PDF document to draw on: opaque fills, lines, text in one embedded font, tags, bookmarks.
//! \details Opaque only, so that it can become PDF/A-1. Coordinates are points with y down. A character that the font
//! does not have is noted as the page's problem. Pages know nothing of each other: they may be drawn at the same time.
class PdfCanvas
{
public:
    //! \param font must live as long as the canvas
    explicit PdfCanvas(const PdfFont& font);
    ~PdfCanvas();
    PdfCanvas(const PdfCanvas&) = delete;
    PdfCanvas& operator=(const PdfCanvas&) = delete;

    void fill(const Polygon& polygon, unsigned rgb);
    //! \brief Several polygons in one go.
    void fills(const std::vector<Polygon>& polygons, unsigned rgb);
    void fill_and_outline(const Polygon& polygon, unsigned rgb, const Line& line);
    //! \brief Filled as if closed, the line left open.
    void fill_and_stroke(const Polygon& chain, unsigned rgb, const Line& line);
    void outline(const Polygon& polygon, const Line& line);
    void stroke(const Polygon& chain, const Line& line);
    //! \brief Several chains in one go.
    void strokes(const std::vector<Polygon>& chains, const Line& line);
    //! \brief Round dots every \p spacing along segments (pairs of points).
    void dots(const std::vector<std::pair<Vec2, Vec2>>& segments, double diameter, double spacing, unsigned rgb);
    void disc(const Vec2& centre, double radius, unsigned rgb, const Line& line);
    void arc(const Vec2& centre, double radius, double from, double to, const Line& line);
    //! \brief Draw with the origin moved.
    void shifted(const Vec2& origin, const std::function<void()>& draw);
    //! \brief Draw only inside a polygon.
    void clipped(const Polygon& polygon, const std::function<void()>& draw);
    void clipped_to_disc(const Vec2& centre, double radius, const std::function<void()>& draw);

    void text(const std::string& utf8, const Vec2& at, const TextStyle& style);
    double text_width(const std::string& utf8, double size) const;
    //! \brief The largest size up to \p size, but not under 6, at which \p utf8 is no wider than \p width.
    double fitting_size(const std::string& utf8, double width, double size) const;
    //! \brief \p utf8 broken to \p width: at spaces, and within a word that is wider by itself.
    std::vector<std::string> lines(const std::string& utf8, double width, double size) const;
    //! \brief Text in lines; returns the y of the line after the last one.
    double paragraph(const std::string& utf8, const Vec2& at, double width, const TextStyle& style, double leading);

    //! \brief Draw a group here.
    void place(const std::shared_ptr<const PdfGroup>& group, const Vec2& at);

    //! \brief Structure of the document: "H1", "P", "Caption" ... with what \p draw draws in it.
    void tagged(const std::string& tag, const std::function<void()>& draw);
    //! \brief Structure that only holds other structure: "Sect".
    void part(const std::string& tag, const std::function<void()>& draw);
    //! \brief A figure with a text that stands for it.
    void figure(const std::string& alternative, const std::function<void()>& draw);
    //! \brief A text that leads to a destination.
    void link(const std::string& destination, const std::string& utf8, const Vec2& at, const TextStyle& style);
    void destination(const std::string& name, double top);
    void bookmark(int level, const std::string& title, double top);

    //! \brief What was drawn. The canvas is empty afterwards.
    PdfPage take();

private:
    //! As many characters as fit, at least one.
    std::string fitting_start(const std::string& word, double width, double size) const;

    struct State;
    std::unique_ptr<State> state_;
};

//! \brief Draw a group that reaches \p extent points from its origin.
std::shared_ptr<const PdfGroup> pdf_group(const PdfFont& font, double extent,
                                          const std::function<void(PdfCanvas&)>& draw);

} // namespace rhombloom
