#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/expected.h"
#include "exporters/code_points.h"
#include "exporters/pdf_canvas.h"
#include "exporters/pdf_content.h"
#include "exporters/pdf_grid.h"

namespace rhombloom {

//! The page under the pen, and what its content has set so far.
struct PdfCanvas::State
{
    //! What the content has set so far; nothing: not known, as at the start of a group.
    struct Pen
    {
        std::optional<unsigned> fill, line;
        std::optional<double> width, font_size;
        std::optional<std::pair<double, double>> dash;
    };

    const PdfFont& font;
    PdfPage page;
    Pen pen = {};
    std::vector<PdfTag>* tags = &page.tags;

    std::string& out() { return page.content; }

    void number(double value) { add_number(out(), value); }
    void length(double points) { number(points * pdf_units); }

    void point(const Vec2& p, char op)
    {
        length(p.x());
        length(p.y());
        out() += op;
        out() += '\n';
    }

    void colour(unsigned rgb, const char* grey, const char* colours)
    {
        const unsigned parts[] = {rgb >> 16 & 0xFFU, rgb >> 8 & 0xFFU, rgb & 0xFFU};
        const bool is_grey = parts[0] == parts[1] && parts[1] == parts[2];
        for (int i = 0; i < (is_grey ? 1 : 3); ++i) {
            number(parts[i] / 255.0);
        }
        out() += is_grey ? grey : colours;
        out() += '\n';
    }

    void use_fill(unsigned rgb)
    {
        if (pen.fill != rgb) {
            pen.fill = rgb;
            colour(rgb, "g", "rg");
        }
    }

    void use_dash(double on, double off)
    {
        if (pen.dash == std::pair(on, off)) {
            return;
        }
        pen.dash = {on, off};
        out() += '[';
        if (off > 0) {
            length(on);
            length(off);
        }
        out() += "]0 d\n";
    }

    void use_line(const Line& line)
    {
        if (pen.line != line.rgb) {
            pen.line = line.rgb;
            colour(line.rgb, "G", "RG");
        }
        if (pen.width != line.width) {
            pen.width = line.width;
            length(line.width);
            out() += "w\n";
        }
        use_dash(line.dash, line.dash);
    }

    void path(const Polygon& points, bool close)
    {
        char op = 'm';
        for (const Vec2& p : on_grid(points, close)) {
            point(p, op);
            op = 'l';
        }
    }

    //! Bezier curves along an arc, at most a quarter each; ends on the path's current point.
    void arc(const Vec2& centre, double radius, double from, double to)
    {
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / (M_PI / 2) - 1e-9)));
        const double step = (to - from) / pieces;
        const double reach = radius * 4 / 3 * std::tan(step / 4);
        const auto at = [&](double a) -> Vec2 { return centre + radius * Vec2(std::cos(a), std::sin(a)); };
        const auto along = [&](double a) -> Vec2 { return reach * Vec2(-std::sin(a), std::cos(a)); };
        point(at(from), 'm');
        for (int i = 0; i < pieces; ++i) {
            const double a = from + i * step;
            for (const Vec2& p : {Vec2(at(a) + along(a)), Vec2(at(a + step) - along(a + step))}) {
                length(p.x());
                length(p.y());
            }
            point(at(a + step), 'c');
        }
    }

    //! Draw with what \p set changes undone afterwards.
    template <class Set, class Draw>
    void kept(const Set& set, const Draw& draw)
    {
        const Pen before = pen;
        out() += "q\n";
        set();
        draw();
        out() += "Q\n";
        pen = before;
    }

    void move_origin(const Vec2& origin)
    {
        if (!origin.isZero()) {
            out() += "1 0 0 1 ";
            length(origin.x());
            length(origin.y());
            out() += "cm\n";
        }
    }

    PdfFont::Glyph glyph(char32_t c, const std::string& where)
    {
        const PdfFont::Glyph glyph = font.glyph(c);
        if (page.problem.empty() && !font.writes(c)) {
            page.problem = "the booklet's font cannot write the character U+" + hexadecimal(c) + ", used in \"" +
                           where + "\": use Latin, Greek or Cyrillic letters";
        }
        page.characters.insert(c);
        return glyph;
    }
};

} // namespace rhombloom
