#include "exporters/pdf_canvas.h"

#include <algorithm>
#include <cmath>

#include "exporters/pdf_canvas_state.h"

namespace rhombloom {

PdfCanvas::PdfCanvas(const PdfFont& font) : state_(new State{font, {}}) {}

PdfCanvas::~PdfCanvas() = default;

void PdfCanvas::fill(const Polygon& polygon, unsigned rgb)
{
    fills({polygon}, rgb);
}

void PdfCanvas::fills(const std::vector<Polygon>& polygons, unsigned rgb)
{
    if (polygons.empty()) {
        return;
    }
    state_->use_fill(rgb);
    for (const Polygon& polygon : polygons) {
        state_->path(polygon, true);
    }
    state_->out() += "f\n";
}

void PdfCanvas::fill_and_outline(const Polygon& polygon, unsigned rgb, const Line& line)
{
    state_->use_fill(rgb);
    state_->use_line(line);
    state_->path(polygon, true);
    state_->out() += "b\n";
}

void PdfCanvas::fill_and_stroke(const Polygon& chain, unsigned rgb, const Line& line)
{
    state_->use_fill(rgb);
    state_->use_line(line);
    state_->path(chain, false);
    state_->out() += "B\n";
}

void PdfCanvas::outline(const Polygon& polygon, const Line& line)
{
    state_->use_line(line);
    state_->path(polygon, true);
    state_->out() += "s\n";
}

void PdfCanvas::stroke(const Polygon& chain, const Line& line)
{
    strokes({chain}, line);
}

void PdfCanvas::strokes(const std::vector<Polygon>& chains, const Line& line)
{
    if (chains.empty()) {
        return;
    }
    state_->use_line(line);
    for (const Polygon& chain : chains) {
        state_->path(chain, false);
    }
    state_->out() += "S\n";
}

void PdfCanvas::dots(const std::vector<std::pair<Vec2, Vec2>>& segments, double diameter, double spacing, unsigned rgb)
{
    if (segments.empty()) {
        return;
    }
    state_->use_line({diameter, rgb, 0});
    state_->use_dash(0, spacing);
    for (const auto& [a, b] : segments) {
        state_->point(a, 'm');
        state_->point(b, 'l');
    }
    state_->out() += "S\n";
}

void PdfCanvas::disc(const Vec2& centre, double radius, unsigned rgb, const Line& line)
{
    state_->use_fill(rgb);
    state_->use_line(line);
    state_->arc(centre, radius, 0, 2 * M_PI);
    state_->out() += "b\n";
}

void PdfCanvas::arc(const Vec2& centre, double radius, double from, double to, const Line& line)
{
    state_->use_line(line);
    state_->arc(centre, radius, from, to);
    state_->out() += "S\n";
}

void PdfCanvas::shifted(const Vec2& origin, const std::function<void()>& draw)
{
    state_->kept([&] { state_->move_origin(origin); }, draw);
}

void PdfCanvas::clipped(const Polygon& polygon, const std::function<void()>& draw)
{
    const auto clip = [&] {
        state_->path(polygon, true);
        state_->out() += "h W n\n";
    };
    state_->kept(clip, draw);
}

void PdfCanvas::clipped_to_disc(const Vec2& centre, double radius, const std::function<void()>& draw)
{
    const auto clip = [&] {
        state_->arc(centre, radius, 0, 2 * M_PI);
        state_->out() += "h W n\n";
    };
    state_->kept(clip, draw);
}

double PdfCanvas::text_width(const std::string& utf8, double size) const
{
    double width = 0;
    for (const char32_t c : code_points(utf8)) {
        width += size * state_->font.glyph(c).advance;
    }
    return width;
}

void PdfCanvas::text(const std::string& utf8, const Vec2& at, const TextStyle& style)
{
    const double share = style.align == Align::Left ? 0 : style.align == Align::Centre ? 0.5 : 1;
    const double width = text_width(utf8, style.size);
    const double x = at.x() - share * width;
    if (style.halo != 0) {
        const double y = at.y() - 0.37 * style.size;
        stroke({Vec2(x, y), Vec2(x + width, y)}, {1.05 * style.size, style.halo, 0});
    }
    State& s = *state_;
    s.use_fill(style.rgb);
    s.out() += "BT\n";
    if (s.pen.font_size != style.size) {
        s.pen.font_size = style.size;
        s.out() += "/F ";
        s.length(style.size);
        s.out() += "Tf\n";
    }
    s.out() += "1 0 0 -1 ";
    s.number(std::round(x * pdf_units));
    s.number(std::round(at.y() * pdf_units));
    s.out() += "Tm\n(";
    for (const char32_t c : code_points(utf8)) {
        add_glyph(s.out(), s.glyph(c, utf8).id);
    }
    s.out() += ")Tj\nET\n";
}

double PdfCanvas::fitting_size(const std::string& utf8, double width, double size) const
{
    constexpr double smallest = 6;
    const double needed = text_width(utf8, size);
    return needed <= width ? size : std::max(smallest, size * width / needed);
}

std::string PdfCanvas::fitting_start(const std::string& word, double width, double size) const
{
    const auto character_end = [&](std::size_t i) {
        do {
            ++i;
        } while (i < word.size() && (static_cast<unsigned char>(word[i]) & 0xC0) == 0x80);
        return i;
    };
    std::size_t end = character_end(0);
    while (end < word.size() && text_width(word.substr(0, character_end(end)), size) <= width) {
        end = character_end(end);
    }
    return word.substr(0, end);
}

std::vector<std::string> PdfCanvas::lines(const std::string& utf8, double width, double size) const
{
    std::vector<std::string> result(1);
    for (std::size_t i = 0; i < utf8.size();) {
        const std::size_t end = std::min(utf8.find(' ', i), utf8.size());
        std::string word = utf8.substr(i, end - i);
        i = end + 1;
        const std::string longer = result.back().empty() ? word : result.back() + " " + word;
        if (text_width(longer, size) <= width) {
            result.back() = longer;
            continue;
        }
        if (!result.back().empty()) {
            result.emplace_back();
        }
        while (text_width(word, size) > width) {
            result.back() = fitting_start(word, width, size);
            word.erase(0, result.back().size());
            result.emplace_back();
        }
        result.back() = word;
    }
    return result;
}

double PdfCanvas::paragraph(const std::string& utf8, const Vec2& at, double width, const TextStyle& style,
                            double leading)
{
    double y = at.y();
    for (const std::string& line : lines(utf8, width, style.size)) {
        text(line, Vec2(at.x(), y), style);
        y += leading;
    }
    return y;
}

void PdfCanvas::place(const std::shared_ptr<const PdfGroup>& group, const Vec2& at)
{
    State& s = *state_;
    auto& groups = s.page.groups;
    const auto known = std::find(groups.begin(), groups.end(), group);
    const auto number = known - groups.begin();
    if (known == groups.end()) {
        groups.push_back(group);
    }
    const auto show = [&] {
        s.out() += "/G";
        add_integer(s.out(), number);
        s.out() += " Do\n";
    };
    if (at.isZero()) {
        show();
    } else {
        s.kept([&] { s.move_origin(at); }, show);
    }
}

void PdfCanvas::tagged(const std::string& tag, const std::function<void()>& draw)
{
    State& s = *state_;
    s.tags->push_back({tag, "", s.page.marks++, -1, {}});
    s.out() += "/" + tag + "<</MCID ";
    add_integer(s.out(), s.page.marks - 1);
    s.out() += ">>BDC\n";
    draw();
    s.out() += "EMC\n";
}

void PdfCanvas::part(const std::string& tag, const std::function<void()>& draw)
{
    PdfTag holder{tag, "", -1, -1, {}};
    std::vector<PdfTag>* outer = state_->tags;
    state_->tags = &holder.kids;
    draw();
    state_->tags = outer;
    outer->push_back(std::move(holder));
}

void PdfCanvas::figure(const std::string& alternative, const std::function<void()>& draw)
{
    tagged("Figure", draw);
    state_->tags->back().alternative = alternative;
}

void PdfCanvas::link(const std::string& destination, const std::string& utf8, const Vec2& at, const TextStyle& style)
{
    tagged("Link", [&] { text(utf8, at, style); });
    state_->tags->back().link = static_cast<int>(state_->page.links.size());
    const Vec2 low(at.x(), at.y() - style.size);
    state_->page.links.push_back({{low, low + Vec2(text_width(utf8, style.size), 1.3 * style.size)}, destination});
}

void PdfCanvas::destination(const std::string& name, double top)
{
    state_->page.destinations[name] = top;
}

void PdfCanvas::bookmark(int level, const std::string& title, double top)
{
    state_->page.bookmarks.push_back({level, title, top});
}

PdfPage PdfCanvas::take()
{
    PdfPage page = std::exchange(state_->page, {});
    state_->pen = {};
    return page;
}

std::shared_ptr<const PdfGroup> pdf_group(const PdfFont& font, double extent,
                                          const std::function<void(PdfCanvas&)>& draw)
{
    PdfCanvas canvas(font);
    draw(canvas);
    PdfPage drawn = canvas.take();
    expects(drawn.characters.empty() && drawn.groups.empty(), "pdf_group: only lines and fills");
    return std::make_shared<const PdfGroup>(PdfGroup{extent, std::move(drawn.content)});
}

} // namespace rhombloom
