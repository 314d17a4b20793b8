#pragma once

#include <map>
#include <set>

#include "core/design/history.h"
#include "core/model/base_shapes.h"

//! Replays with several stages, cut and joined by hand: what merge and extrude will deliver.
namespace rhombloom::replays {

inline Surface shape(const std::string& name)
{
    return base_shape(name, Element{}).value().surface;
}

//! A single stage, embedded.
inline Replay single(const std::string& name)
{
    Replay replay;
    replay.surface = shape(name);
    replay.embedding = embed(replay.surface, Element{});
    replay.stages.push_back({"place " + name, replay.surface});
    return replay;
}

//! The lists without the marked quads, unused vertices dropped.
inline SurfaceLists cut(const SurfaceLists& lists, const std::set<int>& removed)
{
    SurfaceLists out;
    out.components = lists.components;
    std::map<int, int> number;
    for (int f = 0; f < static_cast<int>(lists.quads.size()); ++f) {
        if (removed.contains(f)) {
            continue;
        }
        Quad q = lists.quads[f];
        for (int& v : q) {
            const auto [entry, fresh] = number.emplace(v, static_cast<int>(number.size()));
            if (fresh) {
                out.positions.push_back(lists.positions[v]);
                out.sides.push_back(lists.sides[v]);
            }
            v = entry->second;
        }
        out.quads.push_back(q);
        out.facing.push_back(lists.facing[f]);
        out.component.push_back(lists.component[f]);
        out.serial.push_back(lists.serial[f]);
    }
    return out;
}

//! Boundary vertices in the order of the boundary half-edges.
inline std::vector<int> rim(const Surface& surface)
{
    std::vector<int> loop;
    for (const Halfedge first : surface.halfedges()) {
        if (!surface.is_boundary(first)) {
            continue;
        }
        Halfedge h = first;
        do {
            loop.push_back(surface.from_vertex_handle(h).idx());
            h = surface.next_halfedge_handle(h);
        } while (h != first);
        break;
    }
    return loop;
}

inline std::set<int> ring(const Surface& surface, Vertex v)
{
    std::set<int> faces;
    for (const Face f : surface.vf_range(v)) {
        faces.insert(f.idx());
    }
    return faces;
}

//! Glue the second surface's rim to the first's (same length): its elements get new serials and a component.
inline SurfaceLists join(const SurfaceLists& a, SurfaceLists b, const std::string& name, const Vec3& offset)
{
    const std::vector<int> rim_a = rim(make_surface(a).value());
    std::vector<int> rim_b = rim(make_surface(b).value());
    std::reverse(rim_b.begin(), rim_b.end());
    if (a.sides[rim_a[0]] != b.sides[rim_b[0]]) {
        std::rotate(rim_b.begin(), rim_b.begin() + 1, rim_b.end());
    }
    SurfaceLists out = a;
    std::map<int, int> number;
    for (std::size_t i = 0; i < rim_a.size(); ++i) {
        number[rim_b[i]] = rim_a[i];
    }
    for (int v = 0; v < static_cast<int>(b.positions.size()); ++v) {
        if (number.emplace(v, static_cast<int>(out.positions.size())).second) {
            out.positions.push_back(b.positions[v] + offset);
            out.sides.push_back(b.sides[v]);
        }
    }
    int serial = 1000 * static_cast<int>(a.components.size());
    for (std::size_t f = 0; f < b.quads.size(); ++f) {
        Quad q = b.quads[f];
        for (int& v : q) {
            v = number.at(v);
        }
        out.quads.push_back(q);
        out.facing.push_back(b.facing[f]);
        out.component.push_back(static_cast<int>(a.components.size()));
        out.serial.push_back(serial++);
    }
    out.components.push_back(name);
    return out;
}

inline Vertex extreme(const Surface& surface, const Vec3& direction)
{
    Vertex best(0);
    for (const Vertex v : surface.vertices()) {
        if (surface.point(v).dot(direction) > surface.point(best).dot(direction) + 1e-9) {
            best = v;
        }
    }
    return best;
}

//! A chain of shapes, each joined to the one before where a ring of elements round its topmost vertex comes off.
//! \details The valences of the vertices that meet must agree, as those of equal shapes do.
inline Replay chain(const std::string& name, int links)
{
    const Surface link = shape(name);
    Replay replay;
    replay.surface = link;
    replay.embedding = embed(replay.surface, Element{});
    replay.stages.push_back({"place " + name, replay.surface});
    for (int k = 1; k < links; ++k) {
        const Surface& built = replay.surface;
        const Vertex top = extreme(built, Vec3::UnitZ());
        const Vertex bottom = extreme(link, -Vec3::UnitZ());
        const SurfaceLists below = cut(lists(built), ring(built, top));
        const SurfaceLists above = cut(lists(link), ring(link, bottom));
        const Vec3 offset(0, 0, built.point(top).z() - link.point(bottom).z() - 60);
        replay.surface = make_surface(join(below, above, "part " + std::to_string(k + 1), offset)).value();
        replay.embedding = embed(replay.surface, Element{});
        replay.stages.push_back({"merge", replay.surface});
    }
    return replay;
}

//! The same with one element more taken out (the lamp holder's), if that leaves a surface in one piece.
inline Replay opened(Replay replay, int number)
{
    const auto count = static_cast<int>(replay.surface.n_faces());
    for (int i = 0; i < count; ++i) {
        auto left = make_surface(cut(lists(replay.surface), {(number + i) % count}));
        if (left) {
            replay.surface = std::move(*left);
            replay.embedding = embed(replay.surface, Element{});
            replay.stages.push_back({"open", replay.surface});
            break;
        }
    }
    return replay;
}

} // namespace rhombloom::replays
