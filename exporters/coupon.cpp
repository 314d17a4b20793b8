#include "exporters/coupon.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/crop.h"
#include "exporters/cut_drawing.h"
#include "exporters/segment.h"
#include "exporters/strokes.h"

namespace rhombloom {

namespace {

constexpr double square_size = 50; // mm
constexpr double notch_width = 2;  // mm
constexpr double label_height = 3.5;

//! A strip with its cut edge along the x axis, and where its label goes.
struct Strip
{
    Path contour;
    Vec2 label;
};

Path flat_on_x(const Path& contour)
{
    const Vec2 edge = contour.vertices.front().point - contour.vertices.back().point;
    const Path turned = placed(contour, -std::atan2(edge.y(), edge.x()), Vec2::Zero());
    return placed(turned, 0, -turned.vertices.back().point);
}

//! Cutting close by a vertex leaves a segment that laser programs trip over.
bool has_sliver(const Path& contour)
{
    const std::vector<Segment> all = segments(contour);
    return std::any_of(all.begin(), all.end(), [](const Segment& s) { return length(s) < 2 * shortest_segment; });
}

//! Cropped by the first of a few parallel lines, from \p near to \p far, that cuts off exactly one piece.
Expected<Strip> strip(const Path& outline, CropLine line, const Vec2& near, const Vec2& far)
{
    constexpr int tries = 8;
    for (int i = 0; i <= tries; ++i) {
        line.point = near + (far - near) * (static_cast<double>(i) / tries);
        if (auto part = cropped(outline, line); part && !has_sliver(*part)) {
            const Path flat = flat_on_x(*part);
            return Strip{flat, Vec2(flat.vertices.front().point.x() / 2, 1.2 * notch_width)};
        }
    }
    return refuse("no strip for the coupon can be cut out of an element of these proportions");
}

//! The short side v1-v2 with its two hooks.
Expected<Strip> slot_strip(const Path& outline, const HookParameters& p)
{
    const double web = std::max(2.5 * p.finger_width, 2 * notch_width + label_height);
    const double past_shoulder = pivot_radius(p) + p.seat_clearance + p.lip_rounding + 2 * p.finger_width;
    const double depth = std::min(p.lb / 2, std::max(past_shoulder, (p.scoop_depth + web) / std::sin(p.alpha)));
    const Vec2 along_short(std::cos(p.alpha), std::sin(p.alpha));
    return strip(outline, {Vec2::Zero(), -along_short}, Vec2(p.lb - depth, 0), Vec2(p.lb / 2, 0));
}

//! The half of the element along the long side v0-v1.
Expected<Strip> edge_strip(const Path& outline, const HookParameters& p)
{
    const Vec2 along_short(std::cos(p.alpha), std::sin(p.alpha));
    const double past_hook = pivot_radius(p) + p.slit / 2 + p.finger_length + 2 * p.finger_width;
    const double depth = std::min(p.la / 2, past_hook);
    return strip(outline, {Vec2::Zero(), -Vec2::UnitX()}, depth * along_short, p.la / 2 * along_short);
}

std::vector<double> ladder(const CutOptions& options)
{
    const double kerf = std::max(options.kerf_x, options.kerf_y);
    if (kerf == 0) {
        return {0, 0.1, 0.2, 0.3, 0.4};
    }
    std::vector<double> values;
    for (const double step : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
        if (kerf + step >= 0) {
            values.push_back(std::round((kerf + step) * 1000) / 1000);
        }
    }
    return values;
}

//! Fills rows from the lower left corner.
class Shelves
{
public:
    Shelves(const SheetSize& sheet, double margin, double spacing)
        : sheet_(sheet), margin_(margin), spacing_(spacing), next_(margin, margin)
    {
    }
    //! Offset that puts \p path into the next free place, if the sheet has one.
    std::optional<Vec2> place(const Path& path)
    {
        const Box box = bounds(path);
        const Vec2 size = box.max - box.min;
        if (next_.x() + size.x() > sheet_.width - margin_) {
            next_ = Vec2(margin_, top_ + spacing_);
        }
        const Vec2 end = next_ + size;
        if (end.x() > sheet_.width - margin_ || end.y() > sheet_.height - margin_) {
            return std::nullopt;
        }
        const Vec2 offset = next_ - box.min;
        top_ = std::max(top_, end.y());
        right_ = std::max(right_, end.x());
        next_.x() = end.x() + spacing_;
        return offset;
    }
    //! In whole millimetres.
    SheetSize used() const { return {std::ceil(right_ + margin_), std::ceil(top_ + margin_)}; }

private:
    SheetSize sheet_;
    double margin_;
    double spacing_;
    Vec2 next_;
    double top_ = 0;
    double right_ = 0;
};

Path square()
{
    const double s = square_size;
    return {{{Vec2(0, 0), 0}, {Vec2(s, 0), 0}, {Vec2(s, s), 0}, {Vec2(0, s), 0}}, true};
}

//! "0.05": as wide as its neighbours.
std::string two_decimals(double value)
{
    const std::string hundredths = std::to_string(std::lround(value * 100));
    return (hundredths.size() < 2 ? "0.0" : "0.") + hundredths;
}

std::vector<Path> label(const Strip& strip, double kerf)
{
    const std::string text = two_decimals(kerf);
    std::vector<Path> marks;
    for (const Path& stroke : strokes(text, label_height)) {
        marks.push_back(placed(stroke, 0, strip.label - Vec2(strokes_width(text, label_height) / 2, 0)));
    }
    return marks;
}

//! The pieces as they are placed.
struct Laid
{
    std::vector<LaidPiece> pieces;
    std::vector<std::string> ids;
};

enum class Fit
{
    Placed,
    NoRoom,
    NoSlit
};

Fit add(Laid& laid, Shelves& shelves, const Strip& strip, const std::string& id, const CutOptions& options)
{
    Shelves after = shelves;
    const std::optional<Vec2> offset = after.place(strip.contour);
    if (!offset) {
        return Fit::NoRoom;
    }
    const Placement placement = {0, false, *offset};
    auto piece = Blank(strip.contour, {options.kerf_x, options.kerf_y}).laid(placement);
    if (!piece) {
        return Fit::NoSlit;
    }
    if (options.engraving == Engraving::On && strip.label != Vec2::Zero()) {
        piece->engraved = rhombloom::laid(label(strip, options.kerf_x), placement);
    }
    laid.pieces.push_back(std::move(*piece));
    laid.ids.push_back(id);
    shelves = after;
    return Fit::Placed;
}

Fit add_pair(Laid& laid, Shelves& shelves, const Strip& slot, const Strip& edge, CutOptions options, double kerf,
             int notches)
{
    options.kerf_x = options.kerf_y = kerf;
    const std::string id = "coupon-" + std::to_string(notches);
    Laid with_pair = laid;
    Shelves after = shelves;
    for (const auto& [strip, name] : {std::pair(&slot, "-slot"), std::pair(&edge, "-edge")}) {
        const Strip marked = {notched(strip->contour, notches, notch_width), strip->label};
        if (const Fit fit = add(with_pair, after, marked, id + name, options); fit != Fit::Placed) {
            return fit;
        }
    }
    laid = std::move(with_pair);
    shelves = after;
    return Fit::Placed;
}

std::string pairs_text(const std::vector<double>& kerfs)
{
    std::string text = "b. The two strips with the same number of notches are one joint, drawn for one kerf: ";
    for (std::size_t i = 0; i < kerfs.size(); ++i) {
        text += (i == 0 ? "" : ", ") + std::to_string(i + 1) + (i == 0 ? " notch " : " notches ") + to_text(kerfs[i]) +
                " mm";
    }
    return text + ". Bend the long edge into the two hooks of the short side. The right pair slides in without force "
                  "and does not rattle.\n";
}

std::string reading(const std::vector<double>& kerfs, const CutOptions& options)
{
    std::string text = "Cut the coupon first, in the material and with the settings of the sheets, and with the "
                       "cutting program's own kerf offset switched off.\n"
                       "a. Measure the square: it is drawn 50 mm wide, for no kerf. 50 mm minus what you measure is "
                       "the kerf (the full width of the cut); more than 1 mm off means that the program changed the "
                       "scale.\n";
    text += kerfs.empty() ? "" : pairs_text(kerfs);
    text += "c. Give the value that fits: --kerf VALUE";
    if (options.kerf_x == 0 && options.kerf_y == 0) {
        text += " (or leave --kerf away and enter it as the kerf offset of the cutting program: once, not twice)";
    }
    return text +
           ". If every joint is too tight, give a wider --slit-clearance; if every joint rattles, a narrower one.\n";
}

} // namespace

Expected<Coupon> coupon(const HookParameters& parameters, const CutOptions& options)
{
    const auto outline = element_outline(parameters);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    const auto slot = slot_strip(*outline, parameters);
    const auto edge = edge_strip(*outline, parameters);
    if (!slot || !edge) {
        return tl::make_unexpected(slot ? edge.error() : slot.error());
    }
    const double margin = std::max(options.margin, 1.0);
    Shelves shelves({options.sheet_width, options.sheet_height}, margin, std::max(options.spacing, 2.0));
    Laid laid;
    CutOptions uncompensated = options;
    uncompensated.kerf_x = uncompensated.kerf_y = 0;
    Coupon result;
    if (add(laid, shelves, {square(), Vec2::Zero()}, "reference-square", uncompensated) != Fit::Placed) {
        return refuse("the coupon does not fit on the sheet");
    }
    for (const double kerf : ladder(options)) {
        const int notches = static_cast<int>(result.kerfs.size()) + 1;
        if (add_pair(laid, shelves, *slot, *edge, options, kerf, notches) == Fit::Placed) {
            result.kerfs.push_back(kerf);
        } else {
            result.warning += (result.warning.empty() ? "the coupon leaves out the kerf " : ", ") + to_text(kerf);
        }
    }
    CutOptions plain = options;
    plain.annotations = false;
    result.drawing = cut_drawing(laid.pieces, laid.ids, shelves.used(), plain);
    result.text = reading(result.kerfs, options);
    return result;
}

} // namespace rhombloom
