#include "core/design/mesh_import/network_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/design/mesh_import/network_crossings.h"
#include "core/design/mesh_import/network_ease.h"
#include "core/design/mesh_import/network_starts.h"
#include "core/design/mesh_import/working_target.h"
#include "core/design/pose.h"
#include "core/form/parallel.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double stretch_price = 25;             // la per unit of stretch beyond the limit, summed over the elements
constexpr long most_work = 100'000'000;          // iterations times elements, besides straightening: four minutes
constexpr int large = 600;                       // elements; with more, a long search finds no more
constexpr long straightening = 3000;             // iterations per network, and three times as many for the best
constexpr long large_straightening = 15'000'000; // iterations times elements: large networks take more rounds
constexpr long long_straightening = 100'000;     // iterations for the best, when limbs still point elsewhere
constexpr long polishing = 3000;                 // iterations per network
constexpr long easing = 12'000;                  // the same, at first

bool is_better(const Trial& a, const Trial& b)
{
    return score(a, stretch_price) < score(b, stretch_price);
}

//! Different ways of matching may end in one network.
bool is_same(const Trial& a, const Trial& b)
{
    constexpr double same = 1e-6;
    return a.ratings.size() == b.ratings.size() && std::abs(a.rms - b.rms) < same &&
           std::abs(a.excess - b.excess) < same;
}

//! Three to be polished: which of them ends best cannot be told yet. Much stretch can be eased at little cost, so at
//! first it counts little; when that has come to nothing, those with the least are taken first.
std::vector<Trial> finalists(std::vector<Trial> found, int attempt)
{
    const std::array prices = attempt == 0 ? std::array{4.0, 0.5, stretch_price} : std::array{stretch_price, 4.0, 0.5};
    std::vector<Trial> result;
    for (const double price : prices) {
        const auto is_taken = [&](const Trial& trial) {
            return std::any_of(result.begin(), result.end(), [&](const Trial& other) { return is_same(trial, other); });
        };
        found.erase(std::remove_if(found.begin(), found.end(), is_taken), found.end());
        const auto best = std::min_element(found.begin(), found.end(), [price](const Trial& a, const Trial& b) {
            return score(a, price) < score(b, price);
        });
        if (best != found.end()) {
            result.push_back(std::move(*best));
            found.erase(best);
        }
    }
    return result;
}

//! Straighten and polish side by side: one network alone does not keep two threads busy. To straighten is to bring the
//! corners nearer to where they were meant to be: those of all networks shortly, then those of the best for longer, and
//! for long if its limbs still point elsewhere. Polishing for distance alone does not see what turns a limb, and
//! closest points on flat parts tell nothing. Returns the work that polishing took.
long straighten_and_polish(std::vector<Trial>& found, const Trials& trials)
{
    constexpr double price = 1;          // of stretch: it can be eased afterwards
    constexpr double limbs_astray = 0.9; // la: more, and limbs point elsewhere
    const int elements = trials.options.elements;
    const int count = static_cast<int>(found.size());
    const long work = elements > large ? large_straightening : straightening * elements;
    parallel_tasks(count, count, [&](int k) { polish(found[k], trials, Aim::Straight, price, work); });
    const auto straightness = [](const Trial& trial) { return trial.astray + price * trial.excess; };
    const auto best =
        std::min_element(found.begin(), found.end(),
                         [&](const Trial& a, const Trial& b) { return straightness(a) < straightness(b); }) -
        found.begin();
    const long limb_work = std::max(3 * work, long_straightening * std::min(elements, large));
    const long more_work = found[best].astray > limbs_astray ? limb_work : 3 * work;
    const long given = polishing * elements;
    std::vector<long> spent(count);
    parallel_tasks(count, count, [&](int k) {
        if (k == best) {
            polish(found[k], trials, Aim::Straight, price, more_work);
        }
        spent[k] = given - polish(found[k], trials, Aim::Near, stretch_price, given);
    });
    return std::accumulate(spent.begin(), spent.end(), 0L);
}

bool is_nearer_built(const Trial& a, const Trial& b)
{
    return std::tuple(!can_be_built(a), has_crossings(a.found.surface), score(a, stretch_price)) <
           std::tuple(!can_be_built(b), has_crossings(b.found.surface), score(b, stretch_price));
}

//! Ease those that cannot be built yet; when one can be, only those that are nearer. Those that can be built come
//! first. \p left: work that is left for the whole search, of which each gets \p work at most.
void ease_all(std::vector<Trial>& found, const Trials& trials, double price, long work, long& left)
{
    constexpr double nearer = 0.95;
    std::stable_sort(found.begin(), found.end(), is_nearer_built);
    std::vector<Trial> eased;
    for (Trial& trial : found) {
        const bool is_behind = !eased.empty() && can_be_built(eased.front()) && trial.rms > nearer * eased.front().rms;
        if (!can_be_built(trial) && !is_behind && left > 0) {
            const long given = std::min(work, left);
            left -= given - ease(trial, trials, price, given);
        }
        eased.push_back(std::move(trial));
        std::stable_sort(eased.begin(), eased.end(), is_nearer_built);
    }
    found = std::move(eased);
}

//! Is one of \p found much nearer than what can be built?
bool promises_more(const std::vector<Trial>& found, const Trial& built)
{
    constexpr double much = 0.8;
    return std::any_of(found.begin(), found.end(), [&](const Trial& trial) { return trial.rms < much * built.rms; });
}

//! Polish the nearest of those that cannot be built, with stretch at \p price: steps which easing does not take.
void shake(std::vector<Trial>& eased, const Trials& trials, double price, long work, long& left)
{
    const auto behind = [](const Trial& trial) { return std::pair(can_be_built(trial), score(trial, stretch_price)); };
    Trial& near = *std::min_element(eased.begin(), eased.end(),
                                    [&](const Trial& a, const Trial& b) { return behind(a) < behind(b); });
    if (!can_be_built(near)) {
        left -= work - polish(near, trials, Aim::Near, price, work);
    }
}

//! The best of one attempt, eased. First all that promise to be near, shortly and without giving away much distance;
//! when none of them can be built by that, or only one that is farther off, at a higher price, and at last for long.
std::optional<Trial> attempt(const Trials& trials, int number, long& left)
{
    constexpr double higher_price = 4 * stretch_price;
    std::vector<Trial> found = finalists(starts(trials, number), number);
    if (found.empty()) {
        return std::nullopt;
    }
    const int elements = trials.options.elements;
    const long long_work = 60000L * std::min(elements, large);
    left -= straighten_and_polish(found, trials);
    std::vector<Trial> eased = found;
    ease_all(eased, trials, stretch_price, easing * elements, left);
    const auto goes_on = [&] {
        return left > 0 && (!can_be_built(eased.front()) || promises_more(found, eased.front()));
    };
    if (goes_on()) {
        shake(eased, trials, higher_price, polishing * elements, left);
        ease_all(eased, trials, higher_price, easing * elements, left);
    }
    if (goes_on()) {
        if (can_be_built(eased.front())) {
            found.push_back(std::move(eased.front()));
        }
        eased = std::move(found); // as they were: what did not lead to the end has led astray
        ease_all(eased, trials, higher_price, long_work, left);
    }
    return std::move(eased.front());
}

} // namespace

double triangle_edge(const Element& element)
{
    constexpr double share = 0.97; // the bowed long sides pull at the diagonals
    return share * long_diagonal(element);
}

double area_per_element(double edge)
{
    return edge * edge * std::sqrt(3.0) / 6;
}

Expected<FoundNetwork> search_network(const TriangleMesh& target, const Element& element, const SearchOptions& options)
{
    std::mutex telling; // networks are worked on side by side
    const auto tell = [&](const std::string& what) {
        const std::lock_guard lock(telling);
        return !options.progress || options.progress(what);
    };
    tell("simplifying the target");
    WorkingTarget working = working_target(target, triangle_edge(element), options.rescale ? options.elements : 0);
    const MeshTree tree(std::move(working.thick));
    SearchOptions searching = options;
    searching.progress = tell;
    searching.elements = working.elements;
    if (!tell("remeshing")) {
        return refuse("stopped");
    }
    Trials trials{tree, element, searching};
    const int attempts = std::clamp(2400 / searching.elements, 2, 8); // few elements settle quickly
    long left = most_work;
    std::optional<Trial> best;
    for (int k = 0; k < attempts && left > 0 && !(best && can_be_built(*best)); ++k) {
        auto next = attempt(trials, k, left);
        if (next && (!best || can_be_built(*next) || is_better(*next, *best))) {
            best = std::move(next);
        }
        if (!tell("remeshing differently")) {
            return refuse("stopped");
        }
    }
    if (!best) {
        return refuse("no network of " + std::to_string(searching.elements) +
                      " elements comes to rest on this target: try more elements");
    }
    FoundNetwork network = std::move(best->found);
    EmbedOptions exact = options.embedding;
    exact.start = Start::Edited;
    network.embedding = embed_in_place(network.surface, element, exact);
    network.target = std::move(working.even);
    transform(network.target, network.target_scale, Vec3::Zero());
    network.target_scale *= working.scale;
    network.thickened = working.thickened;
    network.filled = working.filled;
    network.elements = working.elements;
    return network;
}

} // namespace rhombloom
