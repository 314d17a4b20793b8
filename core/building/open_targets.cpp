#include <algorithm>

#include "core/building/orders.h"

namespace rhombloom {

namespace {

//! What the target leaves out because a later one takes it away again and \p closed says not to build it.
std::vector<char> passing(const BuildHistory& history, std::size_t target, const Holes& holes,
                          const std::vector<char>& closed)
{
    std::vector<char> out(history.element_count(), 0);
    for (int e = history.final_count; e < history.element_count(); ++e) {
        out[e] = history.targets[target].has(e) && holes.of[e] >= 0 && !closed[holes.of[e]];
    }
    return out;
}

//! The elements of a target that hang together with \p first, ascending.
std::vector<int> piece_round(const Target& target, int first, std::vector<char>& seen)
{
    std::vector<int> piece = {first};
    seen[first] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        for (const Port& port : target.ports[piece[i]]) {
            if (port.element >= 0 && !seen[port.element]) {
                seen[port.element] = 1;
                piece.push_back(port.element);
            }
        }
    }
    std::sort(piece.begin(), piece.end());
    return piece;
}

//! The piece that goes on from what is \p built; the largest when nothing is.
std::vector<int> continued_piece(const Target& target, const std::vector<char>& built)
{
    std::vector<int> best;
    std::pair<long, std::size_t> most{-1, 0};
    std::vector<char> seen(target.face.size(), 0);
    for (int e = 0; e < static_cast<int>(target.face.size()); ++e) {
        if (!target.has(e) || seen[e]) {
            continue;
        }
        std::vector<int> piece = piece_round(target, e, seen);
        const long shared = std::count_if(piece.begin(), piece.end(), [&](int i) { return built[i] != 0; });
        const std::pair<long, std::size_t> its{shared, piece.size()};
        if (its > most) {
            most = its;
            best = std::move(piece);
        }
    }
    return best;
}

} // namespace

Holes holes(const BuildHistory& history)
{
    Holes result;
    result.of.assign(history.element_count(), -1);
    for (std::size_t t = 0; t + 1 < history.targets.size(); ++t) {
        std::vector<char> stays(history.element_count(), 0);
        for (int e = 0; e < history.element_count(); ++e) {
            stays[e] = !history.targets[t].has(e) || history.targets[t + 1].has(e);
        }
        const Target leaving = without(history.targets[t], stays);
        std::vector<char> seen(history.element_count(), 0);
        for (int e = 0; e < history.element_count(); ++e) {
            if (leaving.has(e) && !seen[e]) {
                for (const int i : piece_round(leaving, e, seen)) {
                    result.of[i] = result.count;
                }
                ++result.count;
            }
        }
    }
    return result;
}

std::vector<Target> open_targets(const BuildHistory& history, const Holes& holes, const std::vector<char>& closed,
                                 int last)
{
    std::vector<Target> result;
    std::vector<char> built(history.element_count(), 0);
    for (std::size_t t = 0; t < history.targets.size(); ++t) {
        std::vector<char> later = passing(history, t, holes, closed);
        if (last >= 0) {
            later[last] = 1;
        }
        const Target open = without(history.targets[t], later);
        std::vector<char> islands(history.element_count(), 1);
        for (const int e : continued_piece(open, built)) {
            islands[e] = 0;
        }
        result.push_back(without(open, islands));
        for (int e = 0; e < history.element_count(); ++e) {
            built[e] = result.back().has(e);
        }
    }
    if (last >= 0) {
        result.push_back(history.targets.back());
    }
    return result;
}

} // namespace rhombloom
