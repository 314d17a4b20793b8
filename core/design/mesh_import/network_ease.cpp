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
constexpr std::size_t most_settled = 8; // changes of one network, those of which patches expect most
constexpr int most_nodes = 12;          // networks of a place that are changed further
constexpr int depth = 5;                // changes one after another
constexpr double least_gain = 2e-4;

//! A network on the way from the best so far, in equilibrium.
struct Node
{
    Trial trial;
    Corners focus; //!< the element to be changed next
    int changes = 0;
};

//! A change of a node, tried in a patch.
struct Step
{
    const Node* node = nullptr;
    const Patch* start = nullptr;
    Move move;
    std::optional<Patch> result;
    double gain = 0; //!< of the node's score, to first order
};

//! A node after some changes that patches have found.
struct Change
{
    const Trial* whole = nullptr;
    std::vector<Patch> parts;
    const Node* node = nullptr; //!< none: of several
    std::optional<Trial> result{};
};

//! A stretched element, and the networks with changes near it.
struct Place
{
    Vec3 where = Vec3::Zero();
    std::vector<Node> open;   //!< not yet changed further, the best last
    std::vector<double> seen; //!< energies of all that there were, mm: no two networks have the same
};

//! Of a whole: in a large one a change that has a long way to go does damage elsewhere, in a small one it may help.
int most_iterations(int elements)
{
    constexpr int least = 60;
    constexpr int most = 1500;
    return std::clamp(90000 / elements, least, most);
}

class Easing
{
public:
    Easing(Trial& best, const Trials& trials, double price, long work)
        : best_(best), trials_{trials.target, trials.element, trials.options, most_iterations(trials.options.elements)},
          price_(price), work_(work), edge_(triangle_edge(trials.element) * best.plan.scale),
          crosses_(has_crossings(best.found.surface))
    {
    }

    long run()
    {
        while (best_.excess > 0 && !can_be_built(best_) && goes_on() && round()) {
        }
        return work_;
    }

private:
    bool goes_on() const
    {
        const auto& progress = trials_.options.progress;
        return work_ > 0 && (!progress || progress("easing the stretch"));
    }
    bool round();
    std::vector<Place> places() const;
    std::vector<Step> steps(const std::vector<Node>& nodes, std::vector<Patch>& patches);
    double expected(const Step& step) const { return score(step.node->trial) - step.gain; }
    void settle_all(std::vector<Change>& changes);
    bool change_all(std::vector<Place>& places);
    bool change_further(Place& place);
    void keep(Place& place, std::vector<Change>& changes) const;
    bool is_better(const Trial& trial) const;
    bool take(std::vector<Change>& changes);
    Corners focus(const Trial& trial, const Vec3& where) const;
    double score(const Trial& trial) const { return rhombloom::score(trial, price_); }

    Trial& best_;
    Trials trials_;
    double price_;
    long work_;
    double edge_;               //!< of a triangle, where the target was searched
    bool crosses_;              //!< elements cross each other
    std::vector<Vec3> in_vain_; //!< places
};

Corners corners_of(const Trial& trial, int element)
{
    const Quad q = quad(trial.found.surface, Face(element));
    return std::minmax(q[0], q[2]);
}

//! Elements, the most stretched first.
std::vector<int> by_stretch(const Trial& trial)
{
    std::vector<int> order(trial.ratings.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return trial.ratings[a].stretch > trial.ratings[b].stretch; });
    return order;
}

//! The most stretched element near a place.
Corners Easing::focus(const Trial& trial, const Vec3& where) const
{
    constexpr double near = 2.5;
    const std::vector<int> order = by_stretch(trial);
    const auto found = std::find_if(order.begin(), order.end(),
                                    [&](int k) { return (trial.ratings[k].middle - where).norm() < near * edge_; });
    return corners_of(trial, found == order.end() ? order.front() : *found);
}

//! The most stretched elements, away from each other and from what was in vain.
std::vector<Place> Easing::places() const
{
    constexpr double apart = 8;
    constexpr double close = 1.5;
    std::vector<Place> result;
    for (const int k : by_stretch(best_)) {
        const ElementRating& rating = best_.ratings[k];
        if (excess_stretch(rating.stretch) == 0 || result.size() == most_places) {
            break;
        }
        const auto within = [&](double edges) {
            return [&, edges](const Vec3& other) { return (other - rating.middle).norm() < edges * edge_; };
        };
        if (std::any_of(in_vain_.begin(), in_vain_.end(), within(close)) ||
            std::any_of(result.begin(), result.end(), [&](const Place& p) { return within(apart)(p.where); })) {
            continue;
        }
        result.push_back({rating.middle, {{best_, corners_of(best_, k), 0}}, {best_.found.embedding.energy}});
    }
    return result;
}

//! All changes near the focus of each node, tried in its patch; those that gain most first.
std::vector<Step> Easing::steps(const std::vector<Node>& nodes, std::vector<Patch>& patches)
{
    patches.resize(nodes.size());
    parallel_tasks(default_threads(), static_cast<int>(nodes.size()),
                   [&](int k) { patches[k] = patch_around(nodes[k].trial, nodes[k].focus, trials_, price_); });
    std::vector<Step> result;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        MoveLimits limits = move_limits(nodes[k].trial, trials_);
        limits.may_pop = true;
        for (const Move& move : moves_near(patches[k].plan, patches[k].worst, limits)) {
            result.push_back({&nodes[k], &patches[k], move, std::nullopt});
        }
    }
    parallel_tasks(default_threads(), static_cast<int>(result.size()), [&](int k) {
        Step& step = result[k];
        step.result = changed(*step.start, step.move, step.node->trial, trials_, price_);
    });
    for (Step& step : result) {
        constexpr long cost_of_none = 100;
        const auto size = static_cast<long>(step.start->triangles.size());
        work_ -= size * (step.result ? step.result->iterations + 20 : cost_of_none);
        step.gain = step.result ? step.start->badness - step.result->badness : 0;
    }
    result.erase(std::remove_if(result.begin(), result.end(), [](const Step& step) { return !step.result; }),
                 result.end());
    std::stable_sort(result.begin(), result.end(),
                     [&](const Step& a, const Step& b) { return expected(a) < expected(b); });
    return result;
}

//! Settle the wholes with the changes. Elements that did not cross each other stay apart, and as many as were asked
//! for.
void Easing::settle_all(std::vector<Change>& changes)
{
    parallel_tasks(default_threads(), static_cast<int>(changes.size()), [&](int k) {
        Change& change = changes[k];
        change.result = settle(replaced(*change.whole, change.parts), trials_);
        const bool spoilt = change.result && (!keeps_count(*change.result, *change.whole, trials_) ||
                                              (!crosses_ && has_crossings(change.result->found.surface)));
        if (spoilt) {
            change.result.reset();
        }
    });
    for (const Change& change : changes) {
        work_ -= change.result ? change.result->cost : static_cast<long>(best_.ratings.size()) * trials_.max_iterations;
    }
}

bool Easing::is_better(const Trial& trial) const
{
    const bool built = can_be_built(trial);
    const bool best_built = can_be_built(best_);
    return built != best_built ? built : score(trial) < score(best_) - least_gain;
}

//! The best of the changes becomes the best of all, if it is.
bool Easing::take(std::vector<Change>& changes)
{
    bool taken = false;
    for (Change& change : changes) {
        if (change.result && is_better(*change.result)) {
            best_ = std::move(*change.result);
            change.result.reset();
            taken = true;
        }
    }
    if (taken) {
        crosses_ = crosses_ && has_crossings(best_.found.surface);
        in_vain_.clear();
    }
    return taken;
}

//! Is one of \p values this one, within rounding? Different changes often end alike.
bool is_known(const std::vector<double>& values, double value)
{
    constexpr double same = 1e-4;
    return std::any_of(values.begin(), values.end(), [&](double other) { return std::abs(other - value) < same; });
}

//! Changes that have not been there before are to be changed further, the best first.
void Easing::keep(Place& place, std::vector<Change>& changes) const
{
    for (Change& change : changes) {
        if (!change.result || is_known(place.seen, change.result->found.embedding.energy)) {
            continue;
        }
        place.seen.push_back(change.result->found.embedding.energy);
        const Corners focus = this->focus(*change.result, place.where);
        place.open.push_back({std::move(*change.result), focus, change.node->changes + 1});
    }
    std::stable_sort(place.open.begin(), place.open.end(),
                     [&](const Node& a, const Node& b) { return score(a.trial) > score(b.trial); });
}

bool have_common(const Patch& a, const Patch& b)
{
    return std::find_first_of(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end()) !=
           a.triangles.end();
}

//! One change at every place, alone and all at once.
bool Easing::change_all(std::vector<Place>& places)
{
    std::vector<Node> nodes;
    for (const Place& place : places) {
        nodes.push_back(place.open.back());
    }
    const std::size_t most = std::max<std::size_t>(3, most_settled / places.size());
    std::vector<Patch> patches;
    std::vector<Change> changes;
    std::vector<std::size_t> counts(places.size());
    Change all{&best_, {}};
    std::vector<std::vector<double>> seen(places.size(), {score(best_)});
    for (Step& step : steps(nodes, patches)) {
        if (is_known(seen[step.node - nodes.data()], expected(step))) {
            continue;
        }
        seen[step.node - nodes.data()].push_back(expected(step));
        std::size_t& count = counts[step.node - nodes.data()];
        const auto clashes = [&](const Patch& other) { return have_common(*step.result, other); };
        if (count == 0 && step.gain > 0 && std::none_of(all.parts.begin(), all.parts.end(), clashes)) {
            all.parts.push_back(*step.result);
        }
        if (count < most) {
            changes.push_back({&best_, {std::move(*step.result)}, step.node});
        }
        ++count;
    }
    if (all.parts.size() > 1) {
        changes.push_back(std::move(all));
    }
    settle_all(changes);
    if (take(changes)) {
        return true;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i].open.clear();
        std::vector<Change> here;
        for (Change& change : changes) {
            if (change.node == &nodes[i]) {
                here.push_back(std::move(change));
            }
        }
        keep(places[i], here);
    }
    return false;
}

//! One more change of the best network that a place has come to.
bool Easing::change_further(Place& place)
{
    const std::vector<Node> nodes = {std::move(place.open.back())};
    place.open.pop_back();
    std::vector<Patch> patches;
    std::vector<Change> changes;
    std::vector<double> seen = {score(nodes.front().trial)};
    for (Step& step : steps(nodes, patches)) {
        if (changes.size() < most_settled && !is_known(seen, expected(step))) {
            seen.push_back(expected(step));
            changes.push_back({&nodes.front().trial, {std::move(*step.result)}, &nodes.front()});
        }
    }
    settle_all(changes);
    if (take(changes)) {
        return true;
    }
    if (nodes.front().changes + 1 < depth) {
        keep(place, changes);
    }
    return false;
}

bool Easing::round()
{
    std::vector<Place> places = this->places();
    if (places.empty()) {
        return false;
    }
    if (change_all(places)) {
        return true;
    }
    for (Place& place : places) {
        for (int k = 0; k < most_nodes && !place.open.empty(); ++k) {
            if (!goes_on() || change_further(place)) {
                return true;
            }
        }
        in_vain_.push_back(place.where);
    }
    return true;
}

} // namespace

long ease(Trial& best, const Trials& trials, double price, long work)
{
    return Easing(best, trials, price, work).run();
}

} // namespace rhombloom
