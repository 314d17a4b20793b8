#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "core/units.h"
#include "exporters/outline_dxf_entity.h"
#include "exporters/outline_pieces.h"

namespace rhombloom::reading {

namespace {

//! A flag word; what is no small whole number counts as 0.
int whole(double value)
{
    return std::isfinite(value) && std::abs(value) < 1e6 ? static_cast<int>(value) : 0;
}

//! Vertices of an LWPOLYLINE: 10, 20 and 42 in turn.
Path light_polyline(const DxfEntity& entity)
{
    Path path;
    path.closed = (whole(dxf_value(entity, 70, 0)) & 1) != 0;
    for (const DxfGroup& g : entity.groups) {
        if (g.code == 10) {
            path.vertices.push_back({Vec2(dxf_number(g), std::nan("")), 0});
        } else if (g.code == 20 && !path.vertices.empty()) {
            path.vertices.back().point.y() = dxf_number(g);
        } else if (g.code == 42 && !path.vertices.empty()) {
            path.vertices.back().bulge = dxf_number(g);
        }
    }
    return path;
}

//! Bulges beyond 1 (more than half a circle) are split.
Path with_short_arcs(const Path& path)
{
    Path result;
    result.closed = path.closed;
    const std::size_t n = path.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        result.vertices.push_back(path.vertices[i]);
        const double bulge = path.vertices[i].bulge;
        const bool last = i + 1 == n;
        if (std::abs(bulge) > 1 && (!last || path.closed)) {
            add_arc(result, path.vertices[(i + 1) % n].point, 4 * std::atan(bulge));
            result.vertices.pop_back();
        }
    }
    return result;
}

Path line(const DxfEntity& entity)
{
    return {{{dxf_point(entity, 10), 0}, {dxf_point(entity, 11), 0}}, false, {}};
}

Path arc(const DxfEntity& entity)
{
    const Vec2 centre = dxf_point(entity, 10);
    const double r = dxf_value(entity, 40, std::nan(""));
    const double start = radians(dxf_value(entity, 50, 0));
    double sweep = radians(dxf_value(entity, 51, 0)) - start;
    sweep -= two_pi * std::floor(sweep / two_pi);
    const auto at = [&](double a) { return Vec2(centre + r * Vec2(std::cos(a), std::sin(a))); };
    Path path{{{at(start), 0}}, false, {}};
    add_arc(path, at(start + sweep), sweep);
    return path;
}

Path circle(const DxfEntity& entity)
{
    const Vec2 centre = dxf_point(entity, 10), r(dxf_value(entity, 40, std::nan("")), 0);
    return {{{centre + r, 1}, {centre - r, 1}}, true, {}};
}

//! Entities with an extrusion of -z are drawn mirrored in the y axis.
Path as_seen(Path path, const DxfEntity& entity)
{
    if (dxf_value(entity, 230, 1) < 0) {
        for (PathVertex& v : path.vertices) {
            v.point.x() = -v.point.x();
            v.bulge = -v.bulge;
        }
    }
    return path;
}

//! A POLYLINE and its VERTEX entities; \p i moves on to the last of them.
Path heavy_polyline(const std::vector<DxfEntity>& entities, std::size_t& i)
{
    constexpr int spline_frame = 16;
    Path path;
    path.closed = (whole(dxf_value(entities[i], 70, 0)) & 1) != 0;
    for (; i + 1 < entities.size() && entities[i + 1].kind == "VERTEX"; ++i) {
        const DxfEntity& vertex = entities[i + 1];
        if ((whole(dxf_value(vertex, 70, 0)) & spline_frame) == 0) {
            path.vertices.push_back({dxf_point(vertex, 10), dxf_value(vertex, 42, 0)});
        }
    }
    return path;
}

//! A drawing's blocks by name.
struct Block
{
    Vec2 base = Vec2::Zero();
    std::vector<DxfEntity> entities;
};

std::map<std::string_view, Block> blocks_of(const std::vector<DxfGroup>& groups)
{
    std::map<std::string_view, Block> blocks;
    Block* block = nullptr;
    for (DxfEntity& entity : dxf_entities(groups, "BLOCKS")) {
        if (entity.kind == "BLOCK") {
            block = &blocks[dxf_text(entity, 2)];
            *block = {Vec2(dxf_value(entity, 10, 0), dxf_value(entity, 20, 0)), {}};
        } else if (entity.kind == "ENDBLK") {
            block = nullptr;
        } else if (block != nullptr) {
            block->entities.push_back(std::move(entity));
        }
    }
    return blocks;
}

//! Layers that are switched off (a negative colour) or frozen.
std::set<std::string_view> hidden_layers(const std::vector<DxfGroup>& groups)
{
    std::set<std::string_view> hidden;
    for (const DxfEntity& entity : dxf_entities(groups, "TABLES")) {
        if (entity.kind == "LAYER" && (dxf_value(entity, 62, 7) < 0 || (whole(dxf_value(entity, 70, 0)) & 1) != 0)) {
            hidden.insert(dxf_text(entity, 2));
        }
    }
    return hidden;
}

Path chords_of(const Path& path, double tolerance)
{
    Path result{{}, path.closed, {}};
    for (const Vec2& p : flatten(path, tolerance)) {
        result.vertices.push_back({p, 0});
    }
    return result;
}

//! Reads entities into paths, those of inserted blocks too.
class EntityReader
{
public:
    EntityReader(const std::vector<DxfGroup>& groups, double tolerance)
        : blocks_(blocks_of(groups)), hidden_(hidden_layers(groups)), tolerance_(tolerance)
    {
    }

    Expected<std::vector<Path>> read(const std::vector<DxfEntity>& entities, int depth);
    bool curves = false; //!< some became chords

private:
    Expected<std::vector<Path>> paths_of(const std::vector<DxfEntity>& entities, std::size_t& i, int depth);
    Expected<std::vector<Path>> inserted(const DxfEntity& insert, int depth);
    Expected<std::vector<Path>> flattened(const Expected<Path>& path)
    {
        curves = true;
        return path.map([](const Path& p) { return std::vector<Path>{p}; });
    }

    std::map<std::string_view, Block> blocks_;
    std::set<std::string_view> hidden_;
    double tolerance_;
    std::size_t inserts_ = 0;
};

Expected<std::vector<Path>> EntityReader::paths_of(const std::vector<DxfEntity>& entities, std::size_t& i, int depth)
{
    const DxfEntity& entity = entities[i];
    const auto one = [](Path path) { return std::vector<Path>{std::move(path)}; };
    if (entity.kind == "LINE") {
        return one(line(entity)); // LINE is in world coordinates whatever its extrusion
    }
    if (entity.kind == "ARC") {
        return one(as_seen(arc(entity), entity));
    }
    if (entity.kind == "CIRCLE") {
        return one(as_seen(circle(entity), entity));
    }
    if (entity.kind == "LWPOLYLINE") {
        return one(as_seen(with_short_arcs(light_polyline(entity)), entity));
    }
    if (entity.kind == "POLYLINE") {
        return one(as_seen(with_short_arcs(heavy_polyline(entities, i)), entity));
    }
    if (entity.kind == "ELLIPSE" || entity.kind == "SPLINE") {
        return flattened(entity.kind == "SPLINE" ? dxf_spline(entity, tolerance_) : dxf_ellipse(entity, tolerance_));
    }
    if (entity.kind == "INSERT") {
        return inserted(entity, depth);
    }
    if (entity.kind == "MLINE" || entity.kind == "REGION") {
        return refuse("the DXF holds a " + std::string(entity.kind) +
                      "; expected polylines, lines, arcs, circles, ellipses and splines (explode it)");
    }
    return std::vector<Path>{};
}

Expected<std::vector<Path>> EntityReader::read(const std::vector<DxfEntity>& entities, int depth)
{
    std::vector<Path> paths;
    for (std::size_t i = 0; i < entities.size(); ++i) {
        const DxfEntity& entity = entities[i];
        const bool in_paper_space = dxf_value(entity, 67, 0) == 1, invisible = dxf_value(entity, 60, 0) == 1;
        const bool seen = !in_paper_space && !invisible && !hidden_.contains(dxf_text(entity, 8));
        const auto more = paths_of(entities, i, depth);
        if (!more && seen) {
            return tl::make_unexpected(more.error());
        }
        if (more && seen) {
            paths.insert(paths.end(), more->begin(), more->end());
        }
    }
    return paths;
}

//! A block's paths: scaled (with different factors, arcs become chords), turned and moved.
Expected<std::vector<Path>> EntityReader::inserted(const DxfEntity& insert, int depth)
{
    constexpr int deepest = 16;
    constexpr std::size_t most_inserts = 10000;
    const std::string name(dxf_text(insert, 2));
    const auto block = blocks_.find(name);
    if (block == blocks_.end() || depth >= deepest || ++inserts_ > most_inserts) {
        return refuse("the DXF inserts the block \"" + name.substr(0, 60) + "\", which " +
                      (block == blocks_.end() ? "it does not define" : "is nested too deep or too often"));
    }
    if (dxf_value(insert, 70, 1) > 1 || dxf_value(insert, 71, 1) > 1) {
        return refuse("the DXF inserts the block \"" + name.substr(0, 60) +
                      "\" in rows or columns; expected one outline");
    }
    auto paths = read(block->second.entities, depth + 1);
    if (!paths) {
        return paths;
    }
    const double sx = dxf_value(insert, 41, 1), sy = dxf_value(insert, 42, 1),
                 angle = radians(dxf_value(insert, 50, 0));
    const bool even = std::abs(std::abs(sx) - std::abs(sy)) <= 1e-9 * std::abs(sx);
    const double factor = std::max(std::abs(sx), std::abs(sy));
    for (Path& path : *paths) {
        if (!even) {
            path = chords_of(path, tolerance_ / std::max(factor, 1e-9));
            curves = true;
        }
        for (PathVertex& v : path.vertices) {
            v.point = (v.point - block->second.base).cwiseProduct(Vec2(sx, sy));
            v.bulge *= sx * sy < 0 ? -1 : 1;
        }
        path = as_seen(placed(path, angle, dxf_point(insert, 10)), insert);
    }
    return paths;
}

Expected<double> millimetres_per_unit(const std::vector<DxfGroup>& groups)
{
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
        if (groups[i].code != 9 || groups[i].value != "$INSUNITS") {
            continue;
        }
        static const std::map<int, double> units = {{0, 1},      {1, 25.4},   {2, 304.8},   {4, 1},
                                                    {5, 10},     {6, 1000},   {8, 2.54e-5}, {9, 0.0254},
                                                    {10, 914.4}, {13, 0.001}, {14, 100}};
        const auto unit = units.find(whole(dxf_number(groups[i + 1])));
        if (unit == units.end()) {
            return refuse("$INSUNITS is " + std::string(groups[i + 1].value) +
                          "; expected 4 (mm), 5 (cm), 14 (dm), 6 (m), 13 (micrometres), 1 (inches), 2 (feet), 8 "
                          "(microinches), 9 (mils), 10 (yards) or 0 (none, read as mm)");
        }
        return unit->second;
    }
    return 1.0;
}

} // namespace

Expected<Pieces> dxf_pieces(const std::string& bytes)
{
    const auto groups = dxf_groups(bytes);
    if (!groups) {
        return tl::make_unexpected(groups.error());
    }
    const auto unit = millimetres_per_unit(*groups);
    if (!unit) {
        return tl::make_unexpected(unit.error());
    }
    EntityReader reader(*groups, curve_tolerance / *unit);
    auto paths = reader.read(dxf_entities(*groups, "ENTITIES"), 0);
    if (!paths) {
        return tl::make_unexpected(paths.error());
    }
    Pieces pieces{std::move(*paths), reader.curves};
    for (Path& path : pieces.paths) {
        for (PathVertex& v : path.vertices) {
            v.point *= *unit;
        }
    }
    return pieces;
}

} // namespace rhombloom::reading
