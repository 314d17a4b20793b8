#include "exporters/pdf_canvas.h"

#include <cmath>

#include <cairo/cairo-ft.h>
#include <cairo/cairo-pdf.h>

#include "exporters/code_points.h"
#include "exporters/pdf_grid.h"

namespace rhombloom {

namespace {

//! An attribute value in cairo's syntax.
std::string quoted(const std::string& value)
{
    std::string text = "'";
    for (const char c : value) {
        if (c == '\'' || c == '\\') {
            text += '\\';
        }
        text += c;
    }
    return text + "'";
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length)
{
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

// Cairo keeps fonts for a while after their last use: the face and its library live as long as cairo's font does.
struct FontFile
{
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    ~FontFile()
    {
        FT_Done_Face(face);
        FT_Done_FreeType(library);
    }
};

cairo_font_face_t* load_font(const std::string& path, FT_Face& face)
{
    static const cairo_user_data_key_t key{};
    auto file = std::make_unique<FontFile>();
    if (FT_Init_FreeType(&file->library) != 0 || FT_New_Face(file->library, path.c_str(), 0, &file->face) != 0) {
        return nullptr;
    }
    face = file->face;
    cairo_font_face_t* font = cairo_ft_font_face_create_for_ft_face(face, 0);
    cairo_font_face_set_user_data(font, &key, file.release(),
                                  [](void* pointer) { delete static_cast<FontFile*>(pointer); });
    return font;
}

} // namespace

struct PdfCanvas::State
{
    std::string bytes;
    cairo_surface_t* surface = nullptr;
    cairo_t* page = nullptr;
    cairo_t* cr = nullptr; // the page, or the group that is being drawn
    FT_Face face = nullptr;
    cairo_font_face_t* font = nullptr;
    std::vector<std::pair<cairo_surface_t*, double>> groups;
    std::vector<std::string> alternatives;
    std::string problem;

    void colour(unsigned rgb) const
    {
        cairo_set_source_rgb(cr, ((rgb >> 16) & 0xFFU) / 255.0, ((rgb >> 8) & 0xFFU) / 255.0, (rgb & 0xFFU) / 255.0);
    }

    void pen(const Line& line) const
    {
        colour(line.rgb);
        cairo_set_line_width(cr, line.width);
        cairo_set_dash(cr, &line.dash, line.dash > 0 ? 1 : 0, 0);
    }

    void path(const Polygon& points, bool close) const
    {
        cairo_new_path(cr);
        for (const Vec2& p : on_grid(points, close)) {
            cairo_line_to(cr, p.x(), p.y());
        }
        if (close) {
            cairo_close_path(cr);
        }
    }

    void prepare(cairo_t* context) const
    {
        if (font == nullptr) {
            return;
        }
        cairo_set_font_face(context, font);
        cairo_font_options_t* options = cairo_font_options_create();
        cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
        cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
        cairo_set_font_options(context, options);
        cairo_font_options_destroy(options);
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
        cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    }

    void check_glyphs(const std::string& utf8)
    {
        for (const char32_t c : code_points(utf8)) {
            if (problem.empty() && face != nullptr && FT_Get_Char_Index(face, c) == 0) {
                problem = "the booklet's font has no character U+" + hexadecimal(c) + ", used in \"" + utf8 +
                          "\": write it with other characters";
            }
        }
    }
};

PdfCanvas::PdfCanvas(double width, double height, const std::string& font_file) : state_(std::make_unique<State>())
{
    State& s = *state_;
    s.font = load_font(font_file, s.face);
    if (s.font == nullptr) {
        s.problem = "cannot read the booklet's font " + font_file;
    }
    s.surface = cairo_pdf_surface_create_for_stream(append, &s.bytes, width, height);
    cairo_pdf_surface_restrict_to_version(s.surface, CAIRO_PDF_VERSION_1_4);
    s.page = cairo_create(s.surface);
    s.cr = s.page;
    s.prepare(s.page);
}

PdfCanvas::~PdfCanvas()
{
    for (const auto& [group, extent] : state_->groups) {
        cairo_surface_destroy(group);
    }
    cairo_destroy(state_->page);
    cairo_surface_destroy(state_->surface);
    if (state_->font != nullptr) {
        cairo_font_face_destroy(state_->font);
    }
}

void PdfCanvas::start_page(const std::string& label)
{
    cairo_pdf_surface_set_page_label(state_->surface, label.c_str());
}

void PdfCanvas::finish_page()
{
    cairo_show_page(state_->page);
}

void PdfCanvas::fill(const Polygon& polygon, unsigned rgb)
{
    state_->path(polygon, true);
    state_->colour(rgb);
    cairo_fill(state_->cr);
}

void PdfCanvas::fill_and_outline(const Polygon& polygon, unsigned rgb, const Line& line)
{
    state_->path(polygon, true);
    state_->colour(rgb);
    cairo_fill_preserve(state_->cr);
    state_->pen(line);
    cairo_stroke(state_->cr);
}

void PdfCanvas::outline(const Polygon& polygon, const Line& line)
{
    state_->path(polygon, true);
    state_->pen(line);
    cairo_stroke(state_->cr);
}

void PdfCanvas::stroke(const Polygon& chain, const Line& line)
{
    state_->path(chain, false);
    state_->pen(line);
    cairo_stroke(state_->cr);
}

void PdfCanvas::dots(const std::vector<std::pair<Vec2, Vec2>>& segments, double diameter, double spacing, unsigned rgb)
{
    cairo_new_path(state_->cr);
    for (const auto& [a, b] : segments) {
        cairo_move_to(state_->cr, a.x(), a.y());
        cairo_line_to(state_->cr, b.x(), b.y());
    }
    state_->colour(rgb);
    const double dashes[] = {0, spacing};
    cairo_set_line_width(state_->cr, diameter);
    cairo_set_dash(state_->cr, dashes, 2, 0);
    cairo_stroke(state_->cr);
}

void PdfCanvas::disc(const Vec2& centre, double radius, unsigned rgb, const Line& line)
{
    cairo_new_path(state_->cr);
    cairo_arc(state_->cr, centre.x(), centre.y(), radius, 0, 2 * M_PI);
    state_->colour(rgb);
    cairo_fill_preserve(state_->cr);
    state_->pen(line);
    cairo_stroke(state_->cr);
}

void PdfCanvas::arc(const Vec2& centre, double radius, double from, double to, const Line& line)
{
    cairo_new_path(state_->cr);
    if (to >= from) {
        cairo_arc(state_->cr, centre.x(), centre.y(), radius, from, to);
    } else {
        cairo_arc_negative(state_->cr, centre.x(), centre.y(), radius, from, to);
    }
    state_->pen(line);
    cairo_stroke(state_->cr);
}

void PdfCanvas::shifted(const Vec2& origin, const std::function<void()>& draw)
{
    cairo_save(state_->cr);
    cairo_translate(state_->cr, origin.x(), origin.y());
    draw();
    cairo_restore(state_->cr);
}

void PdfCanvas::clipped(const Polygon& polygon, const std::function<void()>& draw)
{
    cairo_save(state_->cr);
    state_->path(polygon, true);
    cairo_clip(state_->cr);
    draw();
    cairo_restore(state_->cr);
}

void PdfCanvas::clipped_to_disc(const Vec2& centre, double radius, const std::function<void()>& draw)
{
    cairo_save(state_->cr);
    cairo_new_path(state_->cr);
    cairo_arc(state_->cr, centre.x(), centre.y(), radius, 0, 2 * M_PI);
    cairo_clip(state_->cr);
    draw();
    cairo_restore(state_->cr);
}

double PdfCanvas::text_width(const std::string& utf8, double size) const
{
    cairo_text_extents_t extents;
    cairo_set_font_size(state_->cr, size);
    cairo_text_extents(state_->cr, utf8.c_str(), &extents);
    return extents.x_advance;
}

void PdfCanvas::text(const std::string& utf8, const Vec2& at, const TextStyle& style)
{
    state_->check_glyphs(utf8);
    const double share = style.align == Align::Left ? 0 : style.align == Align::Centre ? 0.5 : 1;
    const double x = at.x() - share * text_width(utf8, style.size);
    cairo_t* cr = state_->cr;
    if (style.halo != 0) {
        const double y = at.y() - 0.37 * style.size;
        stroke({Vec2(x, y), Vec2(x + text_width(utf8, style.size), y)}, {1.05 * style.size, style.halo, 0});
    }
    cairo_move_to(cr, x, at.y());
    state_->colour(style.rgb);
    cairo_show_text(cr, utf8.c_str());
    cairo_new_path(cr);
}

double PdfCanvas::paragraph(const std::string& utf8, const Vec2& at, double width, const TextStyle& style,
                            double leading)
{
    double y = at.y();
    std::string line;
    for (std::size_t i = 0; i < utf8.size();) {
        const std::size_t end = std::min(utf8.find(' ', i), utf8.size());
        const std::string word = utf8.substr(i, end - i);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && text_width(longer, style.size) > width) {
            text(line, Vec2(at.x(), y), style);
            y += leading;
            line = word;
        } else {
            line = longer;
        }
        i = end + 1;
    }
    text(line, Vec2(at.x(), y), style);
    return y + leading;
}

int PdfCanvas::group(double extent, const std::function<void()>& draw)
{
    const double side = std::ceil(extent) + 2;
    const cairo_rectangle_t box{-side, -side, 2 * side, 2 * side};
    cairo_surface_t* recording = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &box);
    cairo_t* outer = state_->cr;
    state_->cr = cairo_create(recording);
    state_->prepare(state_->cr);
    draw();
    cairo_destroy(state_->cr);
    state_->cr = outer;
    state_->groups.emplace_back(recording, side);
    return static_cast<int>(state_->groups.size()) - 1;
}

void PdfCanvas::place(int group, const Vec2& at)
{
    cairo_save(state_->cr);
    cairo_set_source_surface(state_->cr, state_->groups[group].first, at.x(), at.y());
    cairo_paint(state_->cr);
    cairo_restore(state_->cr);
}

void PdfCanvas::tagged(const std::string& tag, const std::function<void()>& draw)
{
    cairo_tag_begin(state_->cr, tag.c_str(), nullptr);
    draw();
    cairo_tag_end(state_->cr, tag.c_str());
}

void PdfCanvas::figure(const std::string& alternative, const std::function<void()>& draw)
{
    state_->alternatives.push_back(alternative);
    tagged("Figure", draw);
}

void PdfCanvas::destination(const std::string& name)
{
    cairo_tag_begin(state_->cr, CAIRO_TAG_DEST, ("name=" + quoted(name)).c_str());
    cairo_tag_end(state_->cr, CAIRO_TAG_DEST);
}

void PdfCanvas::link(const std::string& destination, const std::function<void()>& draw)
{
    cairo_tag_begin(state_->cr, CAIRO_TAG_LINK, ("dest=" + quoted(destination)).c_str());
    draw();
    cairo_tag_end(state_->cr, CAIRO_TAG_LINK);
}

int PdfCanvas::bookmark(int parent, const std::string& title, const std::string& destination)
{
    return cairo_pdf_surface_add_outline(state_->surface, parent, title.c_str(),
                                         ("dest=" + quoted(destination)).c_str(), CAIRO_PDF_OUTLINE_FLAG_OPEN);
}

const std::vector<std::string>& PdfCanvas::alternatives() const
{
    return state_->alternatives;
}

Expected<std::string> PdfCanvas::finish()
{
    cairo_surface_finish(state_->surface);
    if (!state_->problem.empty()) {
        return refuse(state_->problem);
    }
    const cairo_status_t status = cairo_surface_status(state_->surface);
    if (status != CAIRO_STATUS_SUCCESS) {
        return machine_failure(std::string("the booklet cannot be drawn: ") + cairo_status_to_string(status));
    }
    return std::move(state_->bytes);
}

} // namespace rhombloom
