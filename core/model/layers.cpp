#include "core/model/layers.h"

namespace rhombloom {

std::vector<std::vector<Face>> layers(const Surface& surface, Vertex seed)
{
    std::vector<bool> taken(surface.n_faces(), false);
    std::vector<std::vector<Face>> result(1);
    for (const Face f : surface.vf_range(seed)) {
        result[0].push_back(f);
        taken[f.idx()] = true;
    }
    while (!result.back().empty()) {
        std::vector<Face> next;
        for (const Face f : result.back()) {
            for (const Face g : surface.ff_range(f)) {
                if (!taken[g.idx()]) {
                    taken[g.idx()] = true;
                    next.push_back(g);
                }
            }
        }
        result.push_back(std::move(next));
    }
    result.pop_back();
    return result;
}

} // namespace rhombloom
