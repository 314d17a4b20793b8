#include "core/model/surface.h"

#include <algorithm>
#include <map>

namespace rhombloom {

namespace {

std::string edge_name(int a, int b)
{
    return "edge " + std::to_string(a) + "-" + std::to_string(b);
}

Expected<void> check_sizes(const SurfaceLists& lists)
{
    const auto quads = lists.quads.size();
    expects(lists.facing.size() == quads && lists.component.size() == quads && lists.serial.size() == quads,
            "SurfaceLists: one facing, component and serial per quad");
    expects(lists.sides.size() == lists.positions.size(), "SurfaceLists: one side per vertex");
    if (quads == 0) {
        return refuse("the surface has no elements: at least one is needed");
    }
    return {};
}

Expected<void> check_quad(const SurfaceLists& lists, int f)
{
    const Quad& q = lists.quads[f];
    for (int i = 0; i < 4; ++i) {
        if (q[i] < 0 || q[i] >= static_cast<int>(lists.positions.size())) {
            return refuse("element " + std::to_string(f) + " uses vertex " + std::to_string(q[i]) + ", but there are " +
                          std::to_string(lists.positions.size()) + " vertices");
        }
        for (int j = 0; j < i; ++j) {
            if (q[i] == q[j]) {
                return refuse("element " + std::to_string(f) + " uses vertex " + std::to_string(q[i]) + " twice");
            }
        }
        const int next = q[(i + 1) % 4];
        if (next >= 0 && next < static_cast<int>(lists.sides.size()) && lists.sides[q[i]] == lists.sides[next]) {
            return refuse(edge_name(q[i], next) + " of element " + std::to_string(f) +
                          " joins two vertices of the same side: sides must alternate");
        }
    }
    return {};
}

Expected<void> check_edges(const SurfaceLists& lists)
{
    std::map<std::pair<int, int>, int> face_of; // directed edge -> face
    for (int f = 0; f < static_cast<int>(lists.quads.size()); ++f) {
        for (int i = 0; i < 4; ++i) {
            const int a = lists.quads[f][i];
            const int b = lists.quads[f][(i + 1) % 4];
            const auto [other, fresh] = face_of.emplace(std::pair{a, b}, f);
            if (!fresh) {
                return refuse(edge_name(a, b) + " is used in the same direction by elements " +
                              std::to_string(other->second) + " and " + std::to_string(f) +
                              ": the surface is not an oriented manifold");
            }
        }
    }
    return {};
}

Expected<void> check_fans(const SurfaceLists& lists)
{
    // Walk the faces round each vertex: `next_face` leads from a face's incoming to its outgoing neighbour vertex.
    const int n = static_cast<int>(lists.positions.size());
    std::vector<std::map<int, int>> turn(n); // at v: outgoing neighbour -> incoming neighbour of the same face
    for (const Quad& q : lists.quads) {
        for (int i = 0; i < 4; ++i) {
            turn[q[i]][q[(i + 1) % 4]] = q[(i + 3) % 4];
        }
    }
    for (int v = 0; v < n; ++v) {
        if (turn[v].empty()) {
            return refuse("vertex " + std::to_string(v) + " belongs to no element");
        }
        // Start at the fan's first face where there is a boundary, else anywhere.
        int start = turn[v].begin()->first;
        for (const auto& [out, in] : turn[v]) {
            const bool entered =
                std::any_of(turn[v].begin(), turn[v].end(), [o = out](const auto& face) { return face.second == o; });
            if (!entered) {
                start = out;
            }
        }
        std::size_t visited = 0;
        for (int out = start; visited < turn[v].size() && turn[v].contains(out); ++visited) {
            out = turn[v].at(out);
            if (out == start) {
                ++visited;
                break;
            }
        }
        if (visited != turn[v].size()) {
            return refuse("vertex " + std::to_string(v) +
                          " is touched by two separate fans of elements, which no hook can hold: open a neighbour too, "
                          "or others");
        }
    }
    return {};
}

Expected<void> check_lists(const SurfaceLists& lists)
{
    if (auto ok = check_sizes(lists); !ok) {
        return ok;
    }
    for (int f = 0; f < static_cast<int>(lists.quads.size()); ++f) {
        if (auto ok = check_quad(lists, f); !ok) {
            return ok;
        }
    }
    if (auto ok = check_edges(lists); !ok) {
        return ok;
    }
    return check_fans(lists);
}

// Half-edges are linked here rather than by add_face, which refuses some orders of faces of a valid mesh ("patch
// re-linking failed"); the checks above have made sure that every link exists and is unique.
class Linker
{
public:
    explicit Linker(Surface& surface) : surface_(surface) {}

    Halfedge halfedge(int from, int to)
    {
        const auto known = halfedges_.find({from, to});
        if (known != halfedges_.end()) {
            return known->second;
        }
        const Halfedge h = surface_.new_edge(Vertex(from), Vertex(to));
        halfedges_[{from, to}] = h;
        halfedges_[{to, from}] = surface_.opposite_halfedge_handle(h);
        return h;
    }

    void add_face(const Quad& q)
    {
        const Face f = surface_.new_face();
        for (int i = 0; i < 4; ++i) {
            const Halfedge h = halfedge(q[i], q[(i + 1) % 4]);
            surface_.set_face_handle(h, f);
            surface_.set_next_halfedge_handle(h, halfedge(q[(i + 1) % 4], q[(i + 2) % 4]));
            surface_.set_halfedge_handle(Vertex(q[i]), h);
        }
        surface_.set_halfedge_handle(f, halfedge(q[0], q[1]));
    }

    //! One fan per vertex: at most one boundary half-edge leaves it, and that one must be the vertex's own.
    void close_boundaries()
    {
        for (const auto& [ends, h] : halfedges_) {
            if (surface_.is_boundary(h)) {
                surface_.set_halfedge_handle(Vertex(ends.first), h);
            }
        }
        for (const auto& [ends, h] : halfedges_) {
            if (surface_.is_boundary(h)) {
                surface_.set_next_halfedge_handle(h, surface_.halfedge_handle(Vertex(ends.second)));
            }
        }
    }

private:
    Surface& surface_;
    std::map<std::pair<int, int>, Halfedge> halfedges_;
};

} // namespace

Expected<Surface> make_surface(const SurfaceLists& lists)
{
    if (auto ok = check_lists(lists); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Surface surface;
    surface.components = lists.components;
    for (std::size_t v = 0; v < lists.positions.size(); ++v) {
        const Vertex added = surface.add_vertex(lists.positions[v]);
        surface.data(added).side = lists.sides[v];
    }
    Linker linker(surface);
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        linker.add_face(lists.quads[f]);
        auto& data = surface.data(Face(static_cast<int>(f)));
        data.facing = lists.facing[f];
        data.component = lists.component[f];
        data.serial = lists.serial[f];
    }
    linker.close_boundaries();
    return surface;
}

SurfaceLists lists(const Surface& surface)
{
    SurfaceLists out;
    out.components = surface.components;
    for (const Vertex v : surface.vertices()) {
        out.positions.push_back(surface.point(v));
        out.sides.push_back(surface.data(v).side);
    }
    for (const Face f : surface.faces()) {
        out.quads.push_back(quad(surface, f));
        out.facing.push_back(surface.data(f).facing);
        out.component.push_back(surface.data(f).component);
        out.serial.push_back(surface.data(f).serial);
    }
    return out;
}

Quad quad(const Surface& surface, Face f)
{
    Quad q{};
    Halfedge h = surface.halfedge_handle(f);
    for (int& v : q) {
        v = surface.from_vertex_handle(h).idx();
        h = surface.next_halfedge_handle(h);
    }
    return q;
}

Halfedge side_halfedge(const Surface& surface, Face f, int k)
{
    Halfedge h = surface.halfedge_handle(f);
    for (int i = 0; i < k; ++i) {
        h = surface.next_halfedge_handle(h);
    }
    return h;
}

int side_index(const Surface& surface, Halfedge h)
{
    const Face f = surface.face_handle(h);
    int k = 0;
    for (Halfedge g = surface.halfedge_handle(f); g != h; g = surface.next_halfedge_handle(g)) {
        ++k;
    }
    return k;
}

double corner_angle(const Surface& surface, const Element& element, Face f, Vertex v)
{
    return corner_angle(element, surface.data(v).side, surface.data(f).facing);
}

} // namespace rhombloom
