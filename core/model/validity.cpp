#include "core/model/validity.h"

#include "core/model/angular_defect.h"
#include "core/model/regions.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double defect_slack = 1e-9; // radians; the range's own limits are reached exactly by real vertices

int count_boundary_loops(const Surface& surface)
{
    std::vector<bool> seen(surface.n_halfedges(), false);
    int loops = 0;
    for (const Halfedge start : surface.halfedges()) {
        if (!surface.is_boundary(start) || seen[start.idx()]) {
            continue;
        }
        ++loops;
        for (Halfedge h = start; !seen[h.idx()]; h = surface.next_halfedge_handle(h)) {
            seen[h.idx()] = true;
        }
    }
    return loops;
}

} // namespace

std::string defect_problem(const Surface& surface, const Element& element, Vertex v)
{
    const DefectRange range = permissible_defect(element);
    const double defect = angular_defect(surface, element, v);
    if (defect >= range.min - defect_slack && defect <= range.max + defect_slack && valence(surface, v) >= 2) {
        return {};
    }
    return "vertex " + std::to_string(v.idx()) + " joins " + std::to_string(valence(surface, v)) +
           " elements with an angular defect of " + to_fixed(degrees(defect), 1) + " degrees; permissible are " +
           to_fixed(degrees(range.min), 1) + " to " + to_fixed(degrees(range.max), 1) +
           ": flip or remove an element there";
}

Validity validate(const Surface& surface, const Element& element)
{
    Validity report;
    for (const Edge e : surface.edges()) {
        const Halfedge h = surface.halfedge_handle(e, 0);
        if (side(surface, h) == side(surface, surface.opposite_halfedge_handle(h))) {
            report.problems.push_back("edge " + std::to_string(e.idx()) + " joins two sides of the same length");
        }
    }
    for (const Vertex v : surface.vertices()) {
        if (!surface.point(v).allFinite()) {
            report.problems.push_back("vertex " + std::to_string(v.idx()) + " has no finite position");
        }
        if (!surface.is_boundary(v)) {
            if (std::string problem = defect_problem(surface, element, v); !problem.empty()) {
                report.problems.push_back(std::move(problem));
            }
        }
    }
    report.boundary_loops = count_boundary_loops(surface);
    report.connected_parts = static_cast<int>(connected_regions(surface).size());
    report.euler_characteristic = static_cast<int>(surface.n_vertices()) - static_cast<int>(surface.n_edges()) +
                                  static_cast<int>(surface.n_faces());
    if (report.connected_parts > 1) {
        report.problems.push_back("the surface falls into " + std::to_string(report.connected_parts) +
                                  " unconnected parts: join them or make them separate designs");
    }
    return report;
}

} // namespace rhombloom
