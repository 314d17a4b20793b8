#include "exporters/template_pdf.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo-pdf.h>

#include "core/units.h"
#include "exporters/nesting.h"
#include "exporters/strokes.h"

namespace rhombloom {

namespace {

constexpr double margin = 10;  // mm, what every printer can reach
constexpr double overlap = 10; // mm, of neighbouring tiles
constexpr double check_size = 50;
constexpr double head = check_size + 12; // mm, height of the strip with the check square
constexpr double foot = 7;               // mm, height of a tile's label
constexpr double thin = 0.15, bold = 0.35;
constexpr double flatten_tolerance = 0.05;
constexpr int most_copies = 12;

struct Area
{
    Vec2 size;
    Vec2 inner() const { return size - Vec2::Constant(2 * margin); }
    //! Of a tile, above its label.
    Vec2 tile() const { return inner() - Vec2(0, foot); }
};

Area page_of(Paper paper)
{
    const PaperSize size = paper_size(paper);
    return {Vec2(size.width, size.height) * (25.4 / 72)};
}

//! A PDF in memory whose user space is millimetres with y up.
class Pdf
{
public:
    explicit Pdf(const Area& page)
        : page_(page),
          surface_(cairo_pdf_surface_create_for_stream(append, &bytes_, points(page.size.x()), points(page.size.y())),
                   cairo_surface_destroy)
    {
        cairo_pdf_surface_restrict_to_version(surface_.get(), CAIRO_PDF_VERSION_1_5);
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, "1:1 template");
        // Cairo would write the time of day.
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
        context_ = {cairo_create(surface_.get()), cairo_destroy};
        cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
        cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
        cairo_set_tolerance(context_.get(), 0.001); // points; arcs become curves within it
        start_page();
    }
    void next_page()
    {
        cairo_show_page(context_.get());
        start_page();
    }
    void stroke(const Path& path, double width)
    {
        trace(path);
        cairo_set_line_width(context_.get(), width);
        cairo_stroke(context_.get());
    }
    void clip_to(const Vec2& corner, const Vec2& size)
    {
        cairo_save(context_.get());
        cairo_rectangle(context_.get(), corner.x(), corner.y(), size.x(), size.y());
        cairo_clip(context_.get());
    }
    void unclip() { cairo_restore(context_.get()); }
    Expected<std::string> finish()
    {
        cairo_surface_finish(surface_.get());
        if (const cairo_status_t status = cairo_surface_status(surface_.get()); status != CAIRO_STATUS_SUCCESS) {
            return machine_failure(std::string("the template could not be drawn: ") + cairo_status_to_string(status));
        }
        return bytes_;
    }

private:
    static double points(double mm) { return mm * 72 / 25.4; }
    static cairo_status_t append(void* to, const unsigned char* data, unsigned length)
    {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    }
    void start_page()
    {
        cairo_identity_matrix(context_.get());
        cairo_translate(context_.get(), 0, points(page_.size.y()));
        cairo_scale(context_.get(), points(1), -points(1));
    }
    void trace(const Path& path)
    {
        const std::size_t n = path.vertices.size();
        cairo_move_to(context_.get(), path.vertices[0].point.x(), path.vertices[0].point.y());
        for (std::size_t i = 0; i + (path.closed ? 0 : 1) < n; ++i) {
            trace(path.vertices[i], path.vertices[(i + 1) % n].point);
        }
        if (path.closed) {
            cairo_close_path(context_.get());
        }
    }
    void trace(const PathVertex& from, const Vec2& to)
    {
        if (from.bulge == 0) {
            cairo_line_to(context_.get(), to.x(), to.y());
            return;
        }
        const Vec2 chord = to - from.point;
        const double sweep = 4 * std::atan(from.bulge);
        const Vec2 centre = (from.point + to) / 2 + Vec2(-chord.y(), chord.x()) / (2 * std::tan(sweep / 2));
        const Vec2 radial = from.point - centre;
        const double start = std::atan2(radial.y(), radial.x());
        const auto draw = sweep > 0 ? cairo_arc : cairo_arc_negative;
        draw(context_.get(), centre.x(), centre.y(), radial.norm(), start, start + sweep);
    }

    std::string bytes_;
    Area page_;
    std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
    std::unique_ptr<cairo_t, void (*)(cairo_t*)> context_{nullptr, cairo_destroy};
};

Path rectangle(const Vec2& corner, const Vec2& size)
{
    const Vec2 x(size.x(), 0);
    const Vec2 y(0, size.y());
    return {{{corner, 0}, {corner + x, 0}, {corner + size, 0}, {corner + y, 0}}, true};
}

Path line(const Vec2& from, const Vec2& to)
{
    return {{{from, 0}, {to, 0}}, false};
}

void write(Pdf& pdf, std::string_view text, const Vec2& at, double height)
{
    for (const Path& path : strokes(text, height)) {
        pdf.stroke(placed(path, 0, at), height / 10);
    }
}

//! The square and what to do with it, along the upper edge.
void draw_head(Pdf& pdf, const Area& page, const std::string& title)
{
    const Vec2 corner(margin, page.size.y() - margin - check_size);
    pdf.stroke(rectangle(corner, Vec2::Constant(check_size)), bold);
    write(pdf, "50 x 50 MM", corner + Vec2(9, check_size / 2 - 1.5), 3);
    const Vec2 text = corner + Vec2(check_size + 8, check_size - 6);
    write(pdf, "1:1 TEMPLATE", text, 6);
    write(pdf, "PRINT AT 100 % - NOT FIT TO PAGE.", text + Vec2(0, -12), 3);
    write(pdf, "MEASURE THE SQUARE BEFORE CUTTING.", text + Vec2(0, -19), 3);
    write(pdf, title, text + Vec2(0, -26), 3);
}

//! The piece turned so that its bounds are narrow, with the lower left corner of its bounds in the origin.
Path turned_to(const Path& outline, double angle)
{
    const Path turned = placed(outline, angle, Vec2::Zero());
    return placed(turned, 0, -bounds(turned).min);
}

Vec2 size_of(const Path& path)
{
    const Box box = bounds(path);
    return box.max - box.min;
}

//! Copies for the part of one page below the head; none when the piece is too large.
std::vector<Path> copies(const Path& outline, const Area& page)
{
    NestOptions options;
    options.sheet_width = page.inner().x();
    options.sheet_height = page.inner().y() - head;
    options.spacing = 2;
    options.count = most_copies;
    options.effort = Effort::Quick;
    std::vector<Path> result;
    if (const auto nesting = nest(flatten(outline, flatten_tolerance), options)) {
        for (const Placement& placement : nesting->sheets[0].placements) {
            result.push_back(placed(outline, placement.angle, placement.offset + Vec2::Constant(margin)));
        }
    }
    return result;
}

struct Tiles
{
    int columns = 1;
    int rows = 1;
    Vec2 step; //!< from one tile to the next
    int count() const { return columns * rows; }
    Vec2 whole() const { return step.cwiseProduct(Vec2(columns, rows)) + Vec2::Constant(overlap); }
};

Tiles tiles(const Vec2& size, const Area& page)
{
    Tiles result;
    result.step = page.tile() - Vec2::Constant(overlap);
    const auto needed = [](double length, double inner, double step) {
        return length <= inner ? 1 : 1 + static_cast<int>(std::ceil((length - inner) / step - 1e-9));
    };
    result.columns = needed(size.x(), page.tile().x(), result.step.x());
    result.rows = needed(size.y(), page.tile().y(), result.step.y());
    return result;
}

std::string tile_name(const Tiles& tiling, int column, int row)
{
    // Rows are counted from the top, as one reads.
    return std::string(1, static_cast<char>('A' + tiling.rows - 1 - row)) + std::to_string(column + 1);
}

void draw_registration_mark(Pdf& pdf, const Vec2& at)
{
    constexpr double arm = 4;
    pdf.stroke(line(at - Vec2(arm, 0), at + Vec2(arm, 0)), thin);
    pdf.stroke(line(at - Vec2(0, arm), at + Vec2(0, arm)), thin);
    const Vec2 r(arm / 2, 0);
    pdf.stroke({{{at - r, 1}, {at + r, 1}}, true}, thin);
}

//! The part of \p piece in one tile. Marks lie where the middles of the overlaps cross.
void draw_tile(Pdf& pdf, const Path& piece, const Tiles& tiling, int column, int row, const Area& page)
{
    const Vec2 corner(margin, margin + foot);
    const Vec2 size = page.tile();
    const Vec2 shift = corner - Vec2(column * tiling.step.x(), row * tiling.step.y());
    pdf.clip_to(corner, size);
    pdf.stroke(placed(piece, 0, shift), bold);
    pdf.unclip();
    pdf.stroke(rectangle(corner, size), thin);
    const double low = overlap / 2;
    for (const double x : {low, size.x() - low}) {
        for (const double y : {low, size.y() - low}) {
            draw_registration_mark(pdf, corner + Vec2(x, y));
        }
    }
    const int number = 2 + (tiling.rows - 1 - row) * tiling.columns + column;
    write(pdf,
          tile_name(tiling, column, row) + "  PAGE " + std::to_string(number) + "/" +
              std::to_string(tiling.count() + 1),
          Vec2(margin, margin), 4);
}

//! The plan of the tiles, small, below the head.
void draw_plan(Pdf& pdf, const Path& piece, const Tiles& tiling, const Area& page)
{
    const Vec2 whole = tiling.whole();
    const Vec2 room = page.inner() - Vec2(0, head);
    const double scale = std::min({0.4, room.x() / whole.x(), room.y() / whole.y()});
    const Vec2 origin(margin, margin + room.y() - whole.y() * scale);
    Path small = piece;
    for (PathVertex& v : small.vertices) {
        v.point = origin + scale * v.point;
    }
    pdf.stroke(small, bold);
    for (int row = 0; row < tiling.rows; ++row) {
        for (int column = 0; column < tiling.columns; ++column) {
            const Vec2 corner = origin + scale * tiling.step.cwiseProduct(Vec2(column, row));
            pdf.stroke(rectangle(corner, scale * page.tile()), thin);
            write(pdf, tile_name(tiling, column, row), corner + Vec2::Constant(scale * (overlap + 4)), 5);
        }
    }
}

Expected<std::string> tiled(const Path& outline, const Area& page)
{
    const Path flat = turned_to(outline, 0);
    const Path upright = turned_to(outline, pi / 2);
    const bool turn = tiles(size_of(upright), page).count() < tiles(size_of(flat), page).count();
    const Tiles tiling = tiles(size_of(turn ? upright : flat), page);
    const Vec2 spare = tiling.whole() - size_of(turn ? upright : flat);
    const Path piece = placed(turn ? upright : flat, 0, spare / 2);
    Pdf pdf(page);
    draw_head(pdf, page,
              "GLUE " + std::to_string(tiling.count()) + " PAGES MARK ON MARK.  PAGE 1/" +
                  std::to_string(tiling.count() + 1));
    draw_plan(pdf, piece, tiling, page);
    for (int row = tiling.rows - 1; row >= 0; --row) {
        for (int column = 0; column < tiling.columns; ++column) {
            pdf.next_page();
            draw_tile(pdf, piece, tiling, column, row, page);
        }
    }
    return pdf.finish();
}

} // namespace

Expected<std::string> template_pdf(const Path& outline, Paper paper)
{
    const Area page = page_of(paper);
    const std::vector<Path> pieces = copies(outline, page);
    if (pieces.empty()) {
        return tiled(outline, page);
    }
    Pdf pdf(page);
    draw_head(pdf, page, "PAGE 1/1 - PIECES: " + std::to_string(pieces.size()));
    for (const Path& piece : pieces) {
        pdf.stroke(piece, thin);
    }
    return pdf.finish();
}

} // namespace rhombloom
