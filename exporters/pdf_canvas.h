#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

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

//! \brief A PDF document to draw on, page by page: opaque fills, lines, text in one embedded font, tags, bookmarks.
//! \details Opaque only, so that it can become PDF/A-1. Coordinates are points with y down. A character that the font
//! does not have is an error, reported by finish().
class PdfCanvas
{
public:
    //! \param font_file a TrueType font
    PdfCanvas(double width, double height, const std::string& font_file);
    ~PdfCanvas();
    PdfCanvas(const PdfCanvas&) = delete;
    PdfCanvas& operator=(const PdfCanvas&) = delete;

    void start_page(const std::string& label);
    void finish_page();

    void fill(const Polygon& polygon, unsigned rgb);
    void fill_and_outline(const Polygon& polygon, unsigned rgb, const Line& line);
    void outline(const Polygon& polygon, const Line& line);
    void stroke(const Polygon& chain, const Line& line);
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
    //! \brief Broken at spaces to \p width; returns the y of the line after the last one.
    double paragraph(const std::string& utf8, const Vec2& at, double width, const TextStyle& style, double leading);

    //! \brief Draw once, place often: a group becomes one object of the file. Drawn about its own origin.
    int group(double extent, const std::function<void()>& draw);
    void place(int group, const Vec2& at);

    //! \brief Structure of the document: "Sect", "H1", "P", "Figure" ... with what \p draw draws in it.
    void tagged(const std::string& tag, const std::function<void()>& draw);
    //! \brief A figure with a text that stands for it.
    void figure(const std::string& alternative, const std::function<void()>& draw);
    void destination(const std::string& name);
    void link(const std::string& destination, const std::function<void()>& draw);
    //! \brief Add a bookmark below \p parent (0: top level); returns its number.
    int bookmark(int parent, const std::string& title, const std::string& destination);

    //! \brief The alternative texts of the figures, in the order of the document.
    const std::vector<std::string>& alternatives() const;

    //! \brief The bytes of the document. Refuses when a text had a character that the font lacks.
    Expected<std::string> finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace rhombloom
