#include "core/design/mesh_import/network.h"

#include <cmath>

namespace rhombloom {

namespace {

//! The sides as the elements tell them: long sides leave the first and third corner, short ones the others.
Expected<std::vector<Side>> told_sides(const Import& import)
{
    std::vector<Side> sides(import.positions.size(), Side::Long);
    std::vector<bool> known(sides.size(), false);
    for (std::size_t f = 0; f < import.quads.size(); ++f) {
        for (int k = 0; k < 4; ++k) {
            const int v = import.quads[f][k];
            const Side side = k % 2 == 0 ? Side::Long : Side::Short;
            if (known[v] && sides[v] != side) {
                return refuse("element " + std::to_string(f) + " has a " + (k % 2 == 0 ? "long" : "short") +
                              " side leaving point " + std::to_string(v) +
                              ", another element the other: sides must alternate, each element starts with a long one");
            }
            known[v] = true;
            sides[v] = side;
        }
    }
    return sides;
}

} // namespace

Expected<Surface> network(const Import& import)
{
    auto sides = told_sides(import);
    if (!sides) {
        return tl::make_unexpected(sides.error());
    }
    SurfaceLists lists;
    lists.positions = import.positions;
    lists.sides = std::move(*sides);
    lists.quads = import.quads;
    lists.facing.assign(lists.quads.size(), Facing::Front);
    lists.component.assign(lists.quads.size(), 0);
    lists.serial.assign(lists.quads.size(), -1);
    for (const int f : import.flipped) {
        lists.facing[f] = Facing::Back;
    }
    return make_surface(lists);
}

Import import_of(const Surface& surface, const std::string& id)
{
    constexpr double steps_per_mm = 1000;
    Import import;
    import.id = id;
    for (const Vertex v : surface.vertices()) {
        import.positions.emplace_back((surface.point(v) * steps_per_mm).array().round() / steps_per_mm);
    }
    for (const Face f : surface.faces()) {
        Quad q = quad(surface, f);
        if (surface.data(Vertex(q[0])).side == Side::Short) {
            q = {q[1], q[2], q[3], q[0]};
        }
        import.quads.push_back(q);
        if (surface.data(f).facing == Facing::Back) {
            import.flipped.push_back(f.idx());
        }
    }
    return import;
}

} // namespace rhombloom
