#include "core/design/edit.h"

#include <algorithm>
#include <set>

#include "core/model/validity.h"

namespace rhombloom {

Expected<Grafted> open_elements(const Surface& surface, const std::vector<Face>& elements)
{
    Graft change;
    for (const Face f : elements) {
        change.removed.push_back(f.idx());
    }
    int no_new_elements = 0;
    auto result = apply_grafts(surface, {change}, no_new_elements);
    if (!result) {
        return result;
    }
    if (validate(result->surface, Element{}).connected_parts > validate(surface, Element{}).connected_parts) {
        return refuse("without these elements the surface falls into two parts: open fewer or others");
    }
    return result;
}

Expected<Surface> flip_elements(const Surface& surface, const Element& element, const std::vector<Face>& elements)
{
    Surface result = surface;
    for (const Face f : elements) {
        Facing& facing = result.data(f).facing;
        facing = facing == Facing::Front ? Facing::Back : Facing::Front;
    }
    for (const Face f : elements) {
        for (const Vertex v : result.fv_range(f)) {
            if (result.is_boundary(v)) {
                continue;
            }
            if (std::string problem = defect_problem(result, element, v); !problem.empty()) {
                return refuse("element " + std::to_string(f.idx()) + " cannot be flipped: " + problem);
            }
        }
    }
    return result;
}

Expected<std::vector<Face>> with_images(const Surface& surface, const Element& element, const Symmetry& symmetry,
                                        const std::vector<Face>& elements)
{
    std::set<Face> result(elements.begin(), elements.end());
    for (const SymmetryImage& image : images(symmetry)) {
        for (const Face f : elements) {
            const auto g = image_face(surface, element, image, f);
            if (!g) {
                return tl::make_unexpected(g.error());
            }
            result.insert(*g);
        }
    }
    return std::vector<Face>(result.begin(), result.end());
}

} // namespace rhombloom
