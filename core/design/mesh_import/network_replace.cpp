#include "core/design/mesh_import/network_replace.h"

#include <algorithm>

namespace rhombloom {

namespace {

//! A plan taken apart: triangles and points in the numbers of the old one, new points after those.
struct Pieces
{
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Vec3> middles;
    std::set<Corners> flipped;
};

//! The elements between two of the triangles.
std::set<Corners> elements_within(const TriangleMesh& mesh, const std::vector<int>& triangles)
{
    std::set<Corners> edges;
    std::set<Corners> result;
    for (const int i : triangles) {
        const Triangle& t = mesh.triangles[i];
        for (int k = 0; k < 3; ++k) {
            const Corners edge = std::minmax(t[k], t[(k + 1) % 3]);
            if (!edges.insert(edge).second) {
                result.insert(edge);
            }
        }
    }
    return result;
}

//! \p plan without the triangles that the parts stand for.
Pieces left_over(const Plan& plan, const std::vector<Patch>& parts)
{
    Pieces result{plan.triangles.points, {}, {}, plan.flipped};
    std::vector<bool> gone(plan.triangles.triangles.size(), false);
    for (const Patch& part : parts) {
        for (const int i : part.triangles) {
            expects(!gone[i], "replaced: the parts have no triangle in common");
            gone[i] = true;
        }
        for (const Corners& element : elements_within(plan.triangles, part.triangles)) {
            result.flipped.erase(element);
        }
    }
    for (std::size_t i = 0; i < gone.size(); ++i) {
        if (!gone[i]) {
            result.triangles.push_back(plan.triangles.triangles[i]);
            result.middles.push_back(plan.middles[i]);
        }
    }
    return result;
}

void put_in(const Plan& part, double scale, Pieces& pieces)
{
    std::vector<int> number;
    for (std::size_t k = 0; k < part.origin.size(); ++k) {
        const bool is_new = part.origin[k] < 0;
        number.push_back(is_new ? static_cast<int>(pieces.points.size()) : part.origin[k]);
        if (is_new) {
            pieces.points.emplace_back();
        }
        pieces.points[number.back()] = scale * part.triangles.points[k];
    }
    for (std::size_t i = 0; i < part.middles.size(); ++i) {
        const Triangle& t = part.triangles.triangles[i];
        pieces.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
        pieces.middles.push_back(scale * part.middles[i]);
    }
    for (const auto& [a, b] : part.flipped) {
        pieces.flipped.insert(std::minmax(number[a], number[b]));
    }
}

//! In new numbers, without points that no triangle has.
Plan put_together(const Pieces& pieces, double scale)
{
    Plan plan;
    plan.scale = scale;
    std::vector<int> number(pieces.points.size(), -1);
    for (const Triangle& t : pieces.triangles) {
        for (const int v : t) {
            number[v] = 0;
        }
    }
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == 0) {
            number[v] = static_cast<int>(plan.triangles.points.size());
            plan.triangles.points.push_back(pieces.points[v]);
        }
    }
    for (const Triangle& t : pieces.triangles) {
        plan.triangles.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    plan.middles = pieces.middles;
    for (const auto& [a, b] : pieces.flipped) {
        if (number[a] >= 0 && number[b] >= 0) {
            plan.flipped.insert(std::minmax(number[a], number[b]));
        }
    }
    return plan;
}

} // namespace

Plan replaced(const Trial& whole, const std::vector<Patch>& parts)
{
    Pieces pieces = left_over(whole.plan, parts);
    for (const Patch& part : parts) {
        put_in(part.plan, whole.plan.scale, pieces);
    }
    return put_together(pieces, whole.plan.scale);
}

} // namespace rhombloom
