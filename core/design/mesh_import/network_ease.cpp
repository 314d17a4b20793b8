#include "core/design/mesh_import/network_ease.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/design/mesh_import/network_crossings.h"
#include "core/design/mesh_import/network_patch.h"
#include "core/design/mesh_import/network_replace.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_places = 6;
constexpr std::size_t beam = 8; // changes of a place that are changed further
constexpr int depth = 4;        // changes one after another
constexpr double least_gain = 2e-4;

//! A place and what has become of it so far.
struct Search
{
    Corners place;
    Patch start;
    std::vector<Patch> layer; //!< the best of the latest changes
    Patch best;
    std::vector<double> seen; //!< badness of all that was changed further
};

//! The best few of the layer that are not what has been there before: different changes often end alike.
void keep_new(Search& search)
{
    constexpr double same = 1e-4;
    std::vector<Patch> kept;
    for (Patch& patch : search.layer) {
        const bool known = std::any_of(search.seen.begin(), search.seen.end(),
                                       [&](double badness) { return std::abs(badness - patch.badness) < same; });
        if (!known && kept.size() < beam) {
            search.seen.push_back(patch.badness);
            kept.push_back(std::move(patch));
        }
    }
    search.layer = std::move(kept);
}

struct Step
{
    std::size_t search = 0;
    std::size_t parent = 0;
    Move move;
    std::optional<Patch> result;
};

class Easing
{
public:
    Easing(Trial& best, const Trials& trials, double price, long work)
        : best_(best), trials_(trials), price_(price), work_(work), crosses_(has_crossings(best.found.surface))
    {
    }

    void run()
    {
        const auto& progress = trials_.options.progress;
        while (work_ > 0 && best_.excess > 0 && !can_be_built(best_) && round() &&
               (!progress || progress("easing the stretch"))) {
        }
    }

private:
    bool round();
    std::vector<Search> searches() const;
    void deepen(std::vector<Search>& searches);
    std::vector<std::vector<Patch>> improvements(const std::vector<Search>& searches) const;
    bool take(const std::vector<Search>& searches);
    void give_up(const std::vector<Search>& searches);
    MoveLimits limits() const;

    Trial& best_;
    const Trials& trials_;
    double price_;
    long work_;
    bool crosses_;              //!< elements cross each other
    std::set<Corners> in_vain_; //!< places
};

MoveLimits Easing::limits() const
{
    constexpr double most_changed = 0.04;
    const double asked = trials_.options.elements;
    const auto count = static_cast<double>(best_.ratings.size());
    return {max_move_degree(trials_.element), count + 3 <= (1 + most_changed) * asked,
            count - 3 >= (1 - most_changed) * asked, true};
}

//! The most stretched elements, in patches that have nothing in common.
std::vector<Search> Easing::searches() const
{
    std::vector<int> order(best_.ratings.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return best_.ratings[a].stretch > best_.ratings[b].stretch; });
    std::vector<Search> result;
    std::vector<bool> taken(best_.plan.triangles.triangles.size(), false);
    for (const int k : order) {
        if (excess_stretch(best_.ratings[k].stretch) == 0 || result.size() == most_places) {
            break;
        }
        const Quad q = quad(best_.found.surface, Face(k));
        const Corners place = std::minmax(q[0], q[2]);
        if (in_vain_.count(place) > 0) {
            continue;
        }
        Patch patch = patch_around(best_, place, trials_, price_);
        if (std::any_of(patch.triangles.begin(), patch.triangles.end(), [&](int i) { return taken[i]; })) {
            continue;
        }
        for (const int i : patch.triangles) {
            taken[i] = true;
        }
        result.push_back({place, patch, {patch}, patch, {patch.badness}});
    }
    return result;
}

//! One more change everywhere, of the best so far.
void Easing::deepen(std::vector<Search>& searches)
{
    std::vector<Step> steps;
    for (std::size_t i = 0; i < searches.size(); ++i) {
        for (std::size_t j = 0; j < searches[i].layer.size(); ++j) {
            const Patch& patch = searches[i].layer[j];
            for (const Move& move : moves_near(patch.plan, patch.worst, limits())) {
                steps.push_back({i, j, move, std::nullopt});
            }
        }
    }
    parallel_tasks(default_threads(), static_cast<int>(steps.size()), [&](int k) {
        Step& step = steps[k];
        step.result = changed(searches[step.search].layer[step.parent], step.move, best_, trials_, price_);
    });
    for (Search& search : searches) {
        search.layer.clear();
    }
    for (Step& step : steps) {
        Search& search = searches[step.search];
        constexpr long cost_of_none = 100;
        const auto size = static_cast<long>(search.start.triangles.size());
        work_ -= size * (step.result ? step.result->iterations + 20 : cost_of_none);
        if (step.result) {
            search.layer.push_back(std::move(*step.result));
        }
    }
    for (Search& search : searches) {
        std::stable_sort(search.layer.begin(), search.layer.end(),
                         [](const Patch& a, const Patch& b) { return a.badness < b.badness; });
        keep_new(search);
        if (!search.layer.empty() && search.layer.front().badness < search.best.badness) {
            search.best = search.layer.front();
        }
    }
}

//! What has become better in the patches: all at once, and each alone.
std::vector<std::vector<Patch>> Easing::improvements(const std::vector<Search>& searches) const
{
    constexpr std::size_t most_alone = 8; // of a place: not everything that is good in its patch is good in the whole
    std::vector<Patch> best;
    std::vector<std::vector<Patch>> sets;
    for (const Search& search : searches) {
        const double enough = search.start.badness - least_gain;
        if (search.best.badness < enough) {
            best.push_back(search.best);
        }
        for (std::size_t k = 0; k < std::min(most_alone, search.layer.size()); ++k) {
            if (search.layer[k].badness < enough) {
                sets.push_back({search.layer[k]});
            }
        }
    }
    if (best.size() > 1) {
        sets.push_back(std::move(best));
    }
    return sets;
}

//! Take the best of the improvements, settled with the whole. Elements that did not cross each other stay apart.
bool Easing::take(const std::vector<Search>& searches)
{
    const std::vector<std::vector<Patch>> sets = improvements(searches);
    std::vector<std::optional<Trial>> results(sets.size());
    parallel_tasks(default_threads(), static_cast<int>(sets.size()), [&](int k) {
        results[k] = settle(replaced(best_, sets[k]), trials_);
        if (results[k] && !crosses_ && has_crossings(results[k]->found.surface)) {
            results[k].reset();
        }
    });
    bool taken = false;
    for (std::optional<Trial>& trial : results) {
        if (trial && score(*trial, price_) < score(best_, price_) - least_gain) {
            best_ = std::move(*trial);
            taken = true;
        }
    }
    crosses_ = crosses_ && (!taken || has_crossings(best_.found.surface));
    return taken;
}

//! Not to be tried again until something has changed: the places and what is stretched close to them.
void Easing::give_up(const std::vector<Search>& searches)
{
    const double close = 1.5 * triangle_edge(trials_.element) * best_.plan.scale;
    const auto middle = [&](const Corners& place) {
        return Vec3((best_.plan.triangles.points[place.first] + best_.plan.triangles.points[place.second]) / 2);
    };
    for (const Face f : best_.found.surface.faces()) {
        const Quad q = quad(best_.found.surface, f);
        const Corners place = std::minmax(q[0], q[2]);
        if (std::any_of(searches.begin(), searches.end(),
                        [&](const Search& s) { return (middle(s.place) - middle(place)).norm() < close; })) {
            in_vain_.insert(place);
        }
    }
}

bool Easing::round()
{
    std::vector<Search> searches = this->searches();
    if (searches.empty()) {
        return false;
    }
    for (int k = 0; k < depth; ++k) {
        deepen(searches);
        if (take(searches)) {
            in_vain_.clear();
            return true;
        }
    }
    give_up(searches);
    return true;
}

} // namespace

void ease(Trial& best, const Trials& trials, double price, long work)
{
    Easing(best, trials, price, work).run();
}

} // namespace rhombloom
