#include "exporters/outline_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "exporters/outline_pieces.h"
#include "exporters/save.h"

namespace rhombloom {

namespace reading {

namespace {

std::string text_of(const Vec2& p)
{
    return "(" + to_fixed(p.x(), 3) + ", " + to_fixed(p.y(), 3) + ")";
}

Path reversed(const Path& path)
{
    Path result = path;
    const std::size_t n = path.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        result.vertices[i].point = path.vertices[n - 1 - i].point;
        result.vertices[i].bulge = i + 1 < n ? -path.vertices[n - 2 - i].bulge : 0;
    }
    return result;
}

Vec2 first_of(const Path& path)
{
    return path.vertices.front().point;
}

Vec2 last_of(const Path& path)
{
    return path.vertices.back().point;
}

//! The loose path with the end nearest to \p chain's end, and how far it is.
struct Mate
{
    std::size_t index = 0;
    double gap = 1e300;
    bool backwards = false;
};

Mate mate_of(const Path& chain, const std::vector<Path>& loose)
{
    Mate mate;
    for (std::size_t i = 0; i < loose.size(); ++i) {
        const double front = (first_of(loose[i]) - last_of(chain)).norm();
        const double back = (last_of(loose[i]) - last_of(chain)).norm();
        if (std::min(front, back) < mate.gap) {
            mate = {i, std::min(front, back), back < front};
        }
    }
    return mate;
}

double closing_gap(const Path& chain)
{
    return chain.vertices.size() < 3 ? 1e300 : (last_of(chain) - first_of(chain)).norm();
}

//! Moves the loose path whose end is nearest to \p chain's end behind it, if it is nearer than the chain's own start.
bool extend(Path& chain, std::vector<Path>& loose)
{
    const Mate mate = mate_of(chain, loose);
    if (mate.gap > join_tolerance || mate.gap > closing_gap(chain)) {
        return false;
    }
    const Path next = mate.backwards ? reversed(loose[mate.index]) : loose[mate.index];
    chain.vertices.back().bulge = next.vertices.front().bulge;
    chain.vertices.insert(chain.vertices.end(), next.vertices.begin() + 1, next.vertices.end());
    loose.erase(loose.begin() + static_cast<std::ptrdiff_t>(mate.index));
    return true;
}

bool close_up(Path& chain)
{
    if (closing_gap(chain) > join_tolerance) {
        return false;
    }
    chain.vertices.pop_back();
    chain.closed = true;
    return true;
}

//! Drops repeated points; a closed path may also repeat its first one at the end.
void drop_repeats(Path& path)
{
    std::vector<PathVertex> kept;
    for (const PathVertex& v : path.vertices) {
        if (!kept.empty() && kept.back().point == v.point) {
            kept.back() = v;
        } else {
            kept.push_back(v);
        }
    }
    while (path.closed && kept.size() > 1 && kept.front().point == kept.back().point) {
        kept.pop_back();
    }
    path.vertices = std::move(kept);
}

//! The sentence about the smallest of the gaps at a chain's ends.
tl::unexpected<Error> not_closed(const Path& chain, const std::vector<Path>& loose)
{
    Vec2 from = last_of(chain), to = first_of(chain);
    for (const Path& end : {chain, reversed(chain)}) {
        const Mate mate = mate_of(end, loose);
        if (mate.gap < (to - from).norm()) {
            from = last_of(end);
            to = mate.backwards ? last_of(loose[mate.index]) : first_of(loose[mate.index]);
        }
    }
    return refuse("the outline is not closed: a gap of " + to_fixed((to - from).norm(), 3) + " mm between " +
                  text_of(from) + " and " + text_of(to) + "; join the ends in the drawing");
}

//! Drops contours that are drawn twice in the same place, once filled and once stroked, say.
void drop_copies(std::vector<Path>& contours)
{
    const auto same = [](const Path& a, const Path& b) {
        return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                          [](const PathVertex& v, const PathVertex& w) {
                              return (v.point - w.point).norm() < 1e-6 && std::abs(v.bulge - w.bulge) < 1e-6;
                          });
    };
    for (std::size_t i = 0; i < contours.size(); ++i) {
        contours.erase(std::remove_if(contours.begin() + static_cast<std::ptrdiff_t>(i) + 1, contours.end(),
                                      [&](const Path& other) { return same(contours[i], other); }),
                       contours.end());
    }
}

//! The same for loose pieces, whichever way they run.
void drop_loose_copies(std::vector<Path>& loose)
{
    const auto key = [](const Path& path) {
        const auto grid = [](double value) { return std::round(value * 1e6); };
        const Vec2 a = first_of(path), b = last_of(path);
        return std::array<double, 6>{grid(a.x()),
                                     grid(a.y()),
                                     grid(b.x()),
                                     grid(b.y()),
                                     grid(path.vertices.front().bulge),
                                     static_cast<double>(path.vertices.size())};
    };
    std::set<std::array<double, 6>> seen;
    std::erase_if(loose,
                  [&](const Path& path) { return !seen.insert(std::min(key(path), key(reversed(path)))).second; });
}

Expected<void> check_points(const std::vector<Path>& paths)
{
    std::size_t points = 0;
    for (const Path& path : paths) {
        points += path.vertices.size();
        for (const PathVertex& v : path.vertices) {
            if (!v.point.allFinite() || !std::isfinite(v.bulge) || v.point.cwiseAbs().maxCoeff() > 1e6) {
                return refuse("a point of the outline is not a finite number of millimetres below 1 km");
            }
        }
    }
    if (points > most_points) {
        return refuse("the outline has " + std::to_string(points) + " points; at most " + std::to_string(most_points) +
                      " are read");
    }
    return {};
}

Expected<Path> json_outline(const nlohmann::json& json)
{
    if (!json.is_object() || !json.contains("outline") || !json.at("outline").is_array()) {
        return refuse("expected a JSON object with \"outline\": [[x, y], ...] in millimetres");
    }
    Path path;
    for (const auto& point : json.at("outline")) {
        const bool numbers = point.is_array() && (point.size() == 2 || point.size() == 3) &&
                             std::all_of(point.begin(), point.end(), [](const auto& n) { return n.is_number(); });
        if (!numbers) {
            return refuse("outline[" + std::to_string(path.vertices.size()) +
                          "] is not a point: expected [x, y] or [x, y, bulge], all numbers");
        }
        path.vertices.push_back({Vec2(point[0], point[1]), point.size() == 3 ? point[2].get<double>() : 0.0});
        if (std::abs(path.vertices.back().bulge) > 1) {
            return refuse("outline[" + std::to_string(path.vertices.size() - 1) +
                          "] has a bulge beyond 1; split arcs of more than half a circle");
        }
    }
    return path;
}

} // namespace

void add_arc(Path& path, const Vec2& end, double sweep)
{
    if (std::abs(sweep) > 3.1415) {
        const Vec2 start = last_of(path), chord = end - start;
        const Vec2 middle = 0.5 * (start + end) + std::tan(sweep / 4) / 2 * Vec2(chord.y(), -chord.x());
        add_arc(path, middle, sweep / 2);
        add_arc(path, end, sweep / 2);
        return;
    }
    path.vertices.back().bulge = std::tan(sweep / 4);
    path.vertices.push_back({end, 0});
}

Expected<Pieces> json_pieces(const std::string& bytes)
{
    const auto json = nlohmann::json::parse(bytes, nullptr, false);
    if (json.is_discarded()) {
        return refuse("this is not valid JSON (a missing bracket or comma, NaN, or a number too large)");
    }
    return json_outline(json).map([](Path path) { return Pieces{{std::move(path)}, false}; });
}

Expected<Path> joined(std::vector<Path> paths)
{
    std::vector<Path> contours, loose;
    for (Path& path : paths) {
        drop_repeats(path);
        if (path.vertices.size() < 2) {
            continue;
        }
        (path.closed || close_up(path) ? contours : loose).push_back(std::move(path));
    }
    drop_loose_copies(loose);
    while (!loose.empty()) {
        Path chain = loose.back();
        loose.pop_back();
        for (int side = 0; side < 2; ++side) {
            while (extend(chain, loose)) {
            }
            if (close_up(chain)) {
                break;
            }
            chain = reversed(chain); // it may have begun in the middle
        }
        if (!chain.closed) {
            return not_closed(chain, loose);
        }
        contours.push_back(std::move(chain));
    }
    drop_copies(contours);
    if (contours.empty()) {
        return refuse("the file draws no outline");
    }
    if (contours.size() > 1) {
        return refuse("the file draws " + std::to_string(contours.size()) +
                      " contours; expected one closed outline, without holes, borders or marks");
    }
    return contours.front();
}

} // namespace reading

Expected<ReadOutline> read_outline(const std::string& file_name, const std::string& bytes)
{
    using namespace reading;
    const std::string ending = file_ending(file_name);
    const auto parse = ending == "svg"    ? svg_pieces
                       : ending == "dxf"  ? dxf_pieces
                       : ending == "json" ? json_pieces
                                          : nullptr;
    const auto named = [&](const Error& error) { return Error{file_name + ": " + error.message, error.kind}; };
    if (parse == nullptr) {
        return refuse(file_name + ": expected a file that ends in .svg, .dxf or .json");
    }
    auto pieces = parse(bytes);
    if (!pieces) {
        return tl::make_unexpected(named(pieces.error()));
    }
    if (auto ok = check_points(pieces->paths); !ok) {
        return tl::make_unexpected(named(ok.error()));
    }
    const double strayed = pieces->curves ? curve_tolerance : 0;
    return joined(std::move(pieces->paths)).map_error(named).map([&](Path path) {
        return ReadOutline{std::move(path), strayed};
    });
}

} // namespace rhombloom
