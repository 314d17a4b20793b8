#include "core/design/join.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/model/tagging.h"

namespace rhombloom {

namespace {

//! Finds which vertex a vertex has become.
class Representatives
{
public:
    explicit Representatives(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    int find(int v) const
    {
        while (parent_[v] != v) {
            v = parent_[v];
        }
        return v;
    }

    void join(int a, int b)
    {
        const int first = find(a);
        const int second = find(b);
        parent_[std::max(first, second)] = std::min(first, second);
    }

private:
    std::vector<int> parent_;
};

//! Numbers that the vertices of the moving part get in the fixed one; -1: not yet.
std::vector<int> glued_numbers(const CutPart& fixed, const CutPart& moving, const std::vector<Seam>& seams)
{
    const int count = static_cast<int>(moving.surface.n_vertices() + moving.cut.copies.size());
    Representatives same(count);
    for (const Interface& loop : moving.cut.loops) {
        for (const auto& [a, b] : loop.zipped) {
            same.join(a, b);
        }
    }
    std::vector<int> number(count, -1);
    for (const Seam& seam : seams) {
        const Interface& a = fixed.cut.loops[seam.fixed];
        const Interface& b = moving.cut.loops[seam.moving];
        for (int i = 0; i < a.size(); ++i) {
            number[same.find(b.vertices[partner(seam.match, i, a.size())])] = a.vertices[i];
        }
    }
    for (int v = 0; v < count; ++v) {
        number[v] = number[same.find(v)];
    }
    return number;
}

void place_seams(const CutPart& fixed, const CutPart& moving, const std::vector<Seam>& seams,
                 const Eigen::Isometry3d& pose, Graft& result)
{
    const int old_count = static_cast<int>(fixed.surface.n_vertices());
    result.positions = fixed.cut.copies;
    for (const Seam& seam : seams) {
        const Interface& a = fixed.cut.loops[seam.fixed];
        const Interface& b = moving.cut.loops[seam.moving];
        for (int i = 0; i < a.size(); ++i) {
            const Vec3 middle = (a.points[i] + pose * b.points[partner(seam.match, i, a.size())]) / 2;
            if (a.vertices[i] >= old_count) {
                result.positions[a.vertices[i] - old_count] = middle;
            } else {
                result.moved.emplace_back(a.vertices[i], middle);
            }
        }
        result.zipped.insert(result.zipped.end(), a.zipped.begin(), a.zipped.end());
    }
}

Quad corners(const CutPart& part, Face f)
{
    for (const auto& [face, rewritten] : part.cut.rewritten) {
        if (face == f.idx()) {
            return rewritten;
        }
    }
    return quad(part.surface, f);
}

Vec3 position(const CutPart& part, int v)
{
    const int count = static_cast<int>(part.surface.n_vertices());
    return v < count ? part.surface.point(Vertex(v)) : part.cut.copies[v - count];
}

struct Draft
{
    SurfaceLists lists;
    std::vector<char> acute_first;
    std::vector<char> present; // per element
};

Draft draft(const Surface& surface)
{
    Draft result{lists(surface), {}, std::vector<char>(surface.n_faces(), 1)};
    for (const Face f : surface.faces()) {
        result.acute_first.push_back(is_acute(surface, f, 0));
    }
    return result;
}

int component_index(std::vector<std::string>& names, const std::string& name)
{
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
        names.push_back(name);
        return static_cast<int>(names.size()) - 1;
    }
    return static_cast<int>(known - names.begin());
}

//! Append the graft's new vertices and elements; returns the offset of its new vertices.
int append(Draft& result, const Graft& change, int old_count, int& next_serial)
{
    SurfaceLists& out = result.lists;
    const int offset = static_cast<int>(out.positions.size()) - old_count;
    const auto renumber = [&](Quad q) {
        for (int& v : q) {
            v += v >= old_count ? offset : 0;
        }
        return q;
    };
    out.positions.insert(out.positions.end(), change.positions.begin(), change.positions.end());
    for (const auto& [v, p] : change.moved) {
        out.positions[v] = p;
    }
    for (const int f : change.removed) {
        result.present[f] = 0;
    }
    for (const auto& [f, q] : change.rewritten) {
        out.quads[f] = renumber(q);
    }
    for (std::size_t i = 0; i < change.quads.size(); ++i) {
        out.quads.push_back(renumber(change.quads[i]));
        out.component.push_back(component_index(out.components, change.component_names[change.components[i]]));
        out.serial.push_back(change.serials[i] >= 0 ? change.serials[i] : next_serial++);
        result.acute_first.push_back(change.acute_first[i]);
        result.present.push_back(1);
    }
    return offset;
}

template <class T>
void keep_present(std::vector<T>& values, const std::vector<char>& present)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (present[i]) {
            values[kept++] = values[i];
        }
    }
    values.resize(kept);
}

//! Drop absent elements and unused vertices; returns the new number of each vertex, -1 for the dropped.
std::vector<int> compact(Draft& result)
{
    SurfaceLists& out = result.lists;
    keep_present(out.quads, result.present);
    keep_present(out.component, result.present);
    keep_present(out.serial, result.present);
    keep_present(result.acute_first, result.present);
    std::vector<int> number(out.positions.size(), -1);
    for (const Quad& q : out.quads) {
        for (const int v : q) {
            number[v] = 0;
        }
    }
    int count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == 0) {
            number[v] = count;
            out.positions[count++] = out.positions[v];
        }
    }
    out.positions.resize(count);
    for (Quad& q : out.quads) {
        for (int& v : q) {
            v = number[v];
        }
    }
    return number;
}

void drop_unused_components(SurfaceLists& lists)
{
    std::vector<int> number(lists.components.size(), -1);
    for (const int c : lists.component) {
        number[c] = 0;
    }
    std::vector<std::string> names;
    for (std::size_t c = 0; c < number.size(); ++c) {
        if (number[c] == 0) {
            number[c] = static_cast<int>(names.size());
            names.push_back(lists.components[c]);
        }
    }
    for (int& c : lists.component) {
        c = number[c];
    }
    lists.components = names;
}

//! The side of the lowest-numbered vertex that is still there, so that the tags of the surface stay as they are.
Side first_side(const Surface& surface, const std::vector<int>& number, const Representatives& same)
{
    for (int v = 0; v < static_cast<int>(number.size()); ++v) {
        if (number[v] == 0) {
            const int old = same.find(v);
            return old < static_cast<int>(surface.n_vertices()) ? surface.data(Vertex(old)).side : Side::Long;
        }
    }
    return Side::Long;
}

} // namespace

bool is_acute(const Surface& surface, Face f, int k)
{
    const Vertex v(quad(surface, f)[k]);
    return (surface.data(v).side == Side::Long) == (surface.data(f).facing == Facing::Front);
}

Expected<void> retag(SurfaceLists& lists, const std::vector<char>& acute_first, Side first)
{
    auto sides = tag_sides(static_cast<int>(lists.positions.size()), lists.quads, first);
    if (!sides) {
        return tl::make_unexpected(sides.error());
    }
    lists.sides = std::move(*sides);
    lists.facing.clear();
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        const bool leaves_long = lists.sides[lists.quads[f][0]] == Side::Long;
        lists.facing.push_back(leaves_long == (acute_first[f] != 0) ? Facing::Front : Facing::Back);
    }
    return {};
}

Graft graft(const CutPart& fixed, const CutPart& moving, const std::vector<Seam>& seams, const Eigen::Isometry3d& pose,
            const std::vector<Vertex>& tips)
{
    Graft result;
    result.removed = fixed.cut.removed;
    result.rewritten = fixed.cut.rewritten;
    result.component_names = moving.surface.components;
    place_seams(fixed, moving, seams, pose, result);
    std::vector<int> number = glued_numbers(fixed, moving, seams);
    std::vector<char> kept(moving.surface.n_faces(), 1);
    for (const int f : moving.cut.removed) {
        kept[f] = 0;
    }
    for (const Face f : moving.surface.faces()) {
        if (!kept[f.idx()]) {
            continue;
        }
        Quad q = corners(moving, f);
        for (int& v : q) {
            if (number[v] < 0) {
                number[v] = static_cast<int>(fixed.surface.n_vertices() + result.positions.size());
                result.positions.push_back(pose * position(moving, v));
            }
            v = number[v];
        }
        result.quads.push_back(q);
        result.acute_first.push_back(is_acute(moving.surface, f, 0));
        result.serials.push_back(moving.surface.data(f).serial);
        result.components.push_back(moving.surface.data(f).component);
    }
    for (const Vertex v : tips) {
        result.tips.push_back(number[v.idx()]);
    }
    return result;
}

bool edges_fit(const Surface& surface, const Graft& change)
{
    Representatives same(static_cast<int>(surface.n_vertices() + change.positions.size()));
    std::set<int> seam;
    for (const auto& [a, b] : change.zipped) {
        same.join(a, b);
        seam.insert({a, b});
    }
    for (const auto& [v, p] : change.moved) {
        seam.insert(v);
    }
    std::set<int> done(change.removed.begin(), change.removed.end()); // removed, or looked at already
    std::vector<Quad> quads = change.quads;
    for (const int v : seam) {
        if (v >= static_cast<int>(surface.n_vertices())) {
            continue;
        }
        for (const Face f : surface.vf_range(Vertex(v))) {
            if (done.insert(f.idx()).second) {
                quads.push_back(quad(surface, f));
            }
        }
    }
    std::vector<std::pair<int, int>> edges;
    for (Quad& q : quads) {
        std::transform(q.begin(), q.end(), q.begin(), [&](int v) { return same.find(v); });
        if (q[0] == q[2] || q[1] == q[3]) {
            return false;
        }
        for (int k = 0; k < 4; ++k) {
            edges.emplace_back(q[k], q[(k + 1) % 4]);
        }
    }
    std::sort(edges.begin(), edges.end());
    return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

Expected<Grafted> apply_grafts(const Surface& surface, const std::vector<Graft>& grafts, int& next_serial)
{
    Draft result = draft(surface);
    const int old_count = static_cast<int>(surface.n_vertices());
    std::vector<int> offsets;
    for (const Graft& change : grafts) {
        offsets.push_back(append(result, change, old_count, next_serial));
    }
    Representatives same(static_cast<int>(result.lists.positions.size()));
    for (std::size_t g = 0; g < grafts.size(); ++g) {
        for (const auto& [a, b] : grafts[g].zipped) {
            same.join(a >= old_count ? a + offsets[g] : a, b >= old_count ? b + offsets[g] : b);
        }
    }
    for (Quad& q : result.lists.quads) {
        std::transform(q.begin(), q.end(), q.begin(), [&](int v) { return same.find(v); });
    }
    const std::vector<int> number = compact(result);
    if (result.lists.quads.empty()) {
        return refuse("nothing is left of the surface: keep at least one element");
    }
    drop_unused_components(result.lists);
    if (auto ok = retag(result.lists, result.acute_first, first_side(surface, number, same)); !ok) {
        return tl::make_unexpected(ok.error());
    }
    auto made = make_surface(result.lists);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    Grafted out{std::move(*made), {}, {}};
    for (int v = 0; v < old_count; ++v) {
        out.number.push_back(number[same.find(v)]);
    }
    for (std::size_t g = 0; g < grafts.size(); ++g) {
        out.tips.emplace_back();
        for (const int tip : grafts[g].tips) {
            out.tips.back().push_back(Vertex(number[same.find(tip >= old_count ? tip + offsets[g] : tip)]));
        }
    }
    return out;
}

} // namespace rhombloom
