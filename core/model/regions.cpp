#include "core/model/regions.h"

namespace rhombloom {

std::vector<std::vector<Face>> connected_regions(const Surface& surface, std::vector<char> left_out)
{
    std::vector<char>& taken = left_out;
    taken.resize(surface.n_faces(), 0);
    std::vector<std::vector<Face>> regions;
    for (const Face first : surface.faces()) {
        if (taken[first.idx()]) {
            continue;
        }
        std::vector<Face> region = {first};
        taken[first.idx()] = 1;
        for (std::size_t i = 0; i < region.size(); ++i) {
            for (const Face g : surface.ff_range(region[i])) {
                if (!taken[g.idx()]) {
                    taken[g.idx()] = 1;
                    region.push_back(g);
                }
            }
        }
        regions.push_back(std::move(region));
    }
    return regions;
}

} // namespace rhombloom
