#include "exporters/svg.h"

#include <cmath>

#include "core/text.h"
#include "exporters/markup.h"

namespace rhombloom {

namespace {

std::string number(double value)
{
    return to_fixed(value, 5);
}

//! As the file has it. Radii must fit the rounded ends: half circles are sensitive to the last digit.
Vec2 rounded(const Vec2& p)
{
    return Vec2(std::round(p.x() * 1e5) / 1e5, std::round(p.y() * 1e5) / 1e5);
}

//! The page has y down, the drawing y up.
std::string point(const Vec2& p, double height)
{
    return number(p.x()) + " " + number(height - p.y());
}

std::string segment(const PathVertex& from, const Vec2& to, double height)
{
    if (from.bulge == 0) {
        return "L" + point(to, height);
    }
    const double chord = (rounded(to) - rounded(from.point)).norm();
    const double radius = chord * (1 + from.bulge * from.bulge) / (4 * std::abs(from.bulge));
    // Never the large arc: arcs are at most half circles. Counter-clockwise with y up is sweep 0 with y down.
    const std::string r = to_fixed(radius, 9);
    return "A" + r + " " + r + " 0 0 " + (from.bulge > 0 ? "0 " : "1 ") + point(to, height);
}

std::string path_data(const Path& path, double height)
{
    const std::size_t n = path.vertices.size();
    std::string d = "M" + point(path.vertices[0].point, height);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        d += segment(path.vertices[i], path.vertices[i + 1].point, height);
    }
    if (path.closed) {
        // A straight last segment is the Z itself: drawing it as well would be a line of length zero.
        d += path.vertices[n - 1].bulge == 0 ? "" : segment(path.vertices[n - 1], path.vertices[0].point, height);
        d += "Z";
    }
    return d;
}

std::string layer_text(const Layer& layer, double height, double stroke_width)
{
    const std::string name = markup_escaped(layer.name);
    std::string text = "<g id=\"" + name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\">\n";
    for (std::size_t i = 0; i < layer.paths.size(); ++i) {
        const Path& path = layer.paths[i];
        if (path.vertices.size() < 2) {
            continue;
        }
        const std::string id = path.id.empty() ? name + "-" + std::to_string(i + 1) : markup_escaped(path.id);
        text += "<path id=\"" + id + "\" fill=\"none\" stroke=\"" + colour_text(layer.rgb) + "\" stroke-width=\"" +
                number(stroke_width) + "\" d=\"" + path_data(path, height) + "\"/>\n";
    }
    return text + "</g>\n";
}

std::string metadata(const std::vector<std::string>& notes)
{
    std::string text = "<metadata id=\"settings\">\n";
    for (const std::string& note : notes) {
        text += "<rhombloom:setting>" + markup_escaped(note) + "</rhombloom:setting>\n";
    }
    return text + "</metadata>\n";
}

} // namespace

std::string colour_text(unsigned rgb)
{
    constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (int shift = 20; shift >= 0; shift -= 4) {
        text += digits[(rgb >> shift) & 15];
    }
    return text;
}

std::string svg(const Drawing& drawing, const SvgOptions& options)
{
    const std::string width = number(drawing.width);
    const std::string height = number(drawing.height);
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                       "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
                       "xmlns:rhombloom=\"urn:rhombloom\" version=\"1.1\"\n width=\"" +
                       width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height + "\">\n" +
                       metadata(drawing.notes);
    for (const Layer& layer : drawing.layers) {
        text += layer_text(layer, drawing.height, options.stroke_width);
    }
    return text + "</svg>\n";
}

} // namespace rhombloom
