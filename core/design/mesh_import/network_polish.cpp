#include <algorithm>
#include <map>
#include <numeric>

#include "core/design/mesh_import/network_moves.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr double least_gain = 5e-4; // of the score, la
constexpr double reach = 3;         // edges of triangles over which a move is judged
constexpr int least_places = 8;
constexpr int elements_per_place = 75; // the more elements, the more places at once: a round costs an embedding
constexpr int patience = 4;            // rounds in vain after which it ends
constexpr int more_patience = 10;      // when it cannot be built yet
constexpr int most_kicks = 8;   // changes for the worse that may lead out of a dead end, while it cannot be built
constexpr int alternatives = 4; // moves that are tried at a place, side by side

//! Where something is to be done, and what.
struct Place
{
    Corners corners;
    Vec3 where = Vec3::Zero();
    std::vector<Move> moves;
};

struct Chosen
{
    Move move;
    double gain = 0;
};

class Polishing
{
public:
    Polishing(Trial& best, const Trials& trials, Aim aim, double price, long work)
        : best_(best), trials_(trials), aim_(aim), price_(price), work_(work),
          radius_(reach * triangle_edge(trials.element))
    {
    }

    long run()
    {
        const Trial given = best_;
        if (!judge(aim_)) {
            return work_;
        }
        const auto& progress = trials_.options.progress;
        while (work_ > 0 && (round() || kick()) && (!progress || progress("easing the network"))) {
        }
        if (champion_ && score(*champion_) < score(best_)) {
            best_ = std::move(*champion_);
        }
        if (!judge(Aim::Near)) {
            best_ = given;
        }
        return work_;
    }

private:
    bool judge(Aim aim);
    bool round();
    bool kick();
    std::vector<Place> places();
    double off(const Trial& trial) const { return aim_ == Aim::Near ? trial.rms : trial.astray; }
    double score(const Trial& trial) const { return off(trial) + price_ * trial.excess; }
    double share(const ElementRating& rating) const;
    double badness(const Trial& trial, std::size_t element) const;
    double badness_near(const Trial& trial, const Vec3& where) const;
    std::vector<std::optional<Trial>> settle_all(const std::vector<std::vector<Move>>& sets);
    std::vector<Chosen> choose(const std::vector<Place>& places, const std::vector<std::optional<Trial>>& trials) const;
    bool take(std::vector<std::optional<Trial>>& candidates);
    void remember(std::vector<std::optional<Trial>>& candidates);

    Trial& best_;
    const Trials& trials_;
    Aim aim_;
    double price_;
    long work_;
    double radius_;
    double bends_ = 0; //!< of all elements of the best
    int in_vain_ = 0;  //!< rounds without a gain, in a row
    int kicks_ = 0;
    std::optional<Trial> champion_;        //!< the best so far, when a kick has left it
    std::optional<Trial> runner_up_;       //!< the best of what was tried since the last gain
    std::map<Corners, std::size_t> tried_; //!< how many of a place's moves were in vain
};

//! Judge the best anew: trials that are not being polished are judged for being near. False when it does not settle.
bool Polishing::judge(Aim aim)
{
    if (aim_ == Aim::Near) {
        return true;
    }
    auto judged = settle(best_.plan, trials_, aim);
    if (judged) {
        best_ = std::move(*judged);
    }
    return judged.has_value();
}

//! What an element adds to the distance: to first order; of bends, such that they add up to half of it as well.
double Polishing::share(const ElementRating& rating) const
{
    if (aim_ == Aim::Near) {
        return rating.distance * rating.distance / (2 * best_.rms * static_cast<double>(best_.ratings.size()));
    }
    return rating.bend * best_.astray / (2 * bends_);
}

//! What an element adds to the score.
double Polishing::badness(const Trial& trial, std::size_t element) const
{
    const ElementRating& rating = trial.ratings[element];
    return price_ * excess_stretch(rating.stretch) + share(rating);
}

double Polishing::badness_near(const Trial& trial, const Vec3& where) const
{
    double sum = 0;
    for (std::size_t k = 0; k < trial.ratings.size(); ++k) {
        const double off = (trial.ratings[k].middle - where).squaredNorm() / (radius_ * radius_);
        sum += off < 1 ? (1 - off) * badness(trial, k) : 0;
    }
    return sum;
}

//! The worst elements, away from each other, where not everything has been tried.
std::vector<Place> Polishing::places()
{
    std::vector<double> bad(best_.ratings.size());
    for (std::size_t k = 0; k < bad.size(); ++k) {
        bad[k] = badness(best_, k);
    }
    std::vector<int> order(bad.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return bad[a] > bad[b]; });
    const MoveLimits limits = move_limits(best_, trials_);
    const auto most_places =
        static_cast<std::size_t>(std::max(least_places, trials_.options.elements / elements_per_place));
    std::vector<Place> result;
    for (const int k : order) {
        const Vec3& where = best_.ratings[k].middle;
        const bool crowded = std::any_of(result.begin(), result.end(),
                                         [&](const Place& p) { return (p.where - where).norm() < radius_; });
        if (crowded || result.size() == most_places) {
            continue;
        }
        const Quad q = quad(best_.found.surface, Face(k));
        Place place{std::minmax(q[0], q[2]), where, {}};
        std::vector<Move> moves = moves_near(best_.plan, place.corners, limits);
        for (std::size_t& i = tried_[place.corners]; i < moves.size() && place.moves.size() < alternatives; ++i) {
            if (is_permissible(carry_out({moves[i]}, best_.plan), trials_)) {
                place.moves.push_back(moves[i]);
            }
        }
        if (!place.moves.empty()) {
            result.push_back(std::move(place));
        }
    }
    return result;
}

std::vector<std::optional<Trial>> Polishing::settle_all(const std::vector<std::vector<Move>>& sets)
{
    std::vector<std::optional<Trial>> result(sets.size());
    parallel_tasks(default_threads(), static_cast<int>(sets.size()), [&](int k) {
        if (!sets[k].empty()) {
            result[k] = settle(carry_out(sets[k], best_.plan), trials_, aim_);
        }
    });
    const long lost = static_cast<long>(best_.ratings.size()) * trials_.max_iterations;
    for (std::size_t k = 0; k < sets.size(); ++k) {
        work_ -= result[k] ? result[k]->cost : sets[k].empty() ? 0 : lost;
    }
    return result;
}

//! At each place the move that helps most there, if one does.
std::vector<Chosen> Polishing::choose(const std::vector<Place>& places,
                                      const std::vector<std::optional<Trial>>& trials) const
{
    std::vector<Chosen> result;
    for (const Place& place : places) {
        Chosen chosen;
        const double before = badness_near(best_, place.where);
        for (std::size_t j = 0; j < place.moves.size(); ++j) {
            const double gain = trials[j] ? before - badness_near(*trials[j], place.where) : 0;
            if (gain > chosen.gain) {
                chosen = {place.moves[j], gain};
            }
        }
        if (chosen.gain > least_gain) {
            result.push_back(chosen);
        }
    }
    std::stable_sort(result.begin(), result.end(), [](const Chosen& a, const Chosen& b) { return a.gain > b.gain; });
    return result;
}

//! The best of the candidates becomes the best of all, if it is.
bool Polishing::take(std::vector<std::optional<Trial>>& candidates)
{
    bool taken = false;
    for (std::optional<Trial>& candidate : candidates) {
        if (candidate && keeps_count(*candidate, best_, trials_) && score(*candidate) < score(best_) - least_gain) {
            best_ = std::move(*candidate);
            taken = true;
        }
    }
    return taken;
}

void Polishing::remember(std::vector<std::optional<Trial>>& candidates)
{
    if (best_.excess == 0) {
        return;
    }
    for (std::optional<Trial>& candidate : candidates) {
        if (candidate && keeps_count(*candidate, best_, trials_) &&
            (!runner_up_ || score(*candidate) < score(*runner_up_))) {
            runner_up_ = std::move(candidate);
        }
    }
}

//! Leave a dead end by the least bad of the changes that were tried there.
bool Polishing::kick()
{
    if (best_.excess == 0 || !runner_up_ || kicks_ == most_kicks) {
        return false;
    }
    ++kicks_;
    if (!champion_ || score(best_) < score(*champion_)) {
        champion_ = std::move(best_);
    }
    best_ = std::move(*runner_up_);
    runner_up_.reset();
    tried_.clear();
    in_vain_ = 0;
    return true;
}

bool Polishing::round()
{
    bends_ = std::accumulate(best_.ratings.begin(), best_.ratings.end(), 1e-12,
                             [](double sum, const ElementRating& rating) { return sum + rating.bend; });
    const std::vector<Place> places = this->places();
    if (places.empty()) {
        return false;
    }
    std::vector<std::vector<Move>> sets(alternatives);
    for (const Place& place : places) {
        for (std::size_t j = 0; j < place.moves.size(); ++j) {
            sets[j].push_back(place.moves[j]);
        }
    }
    std::vector<std::optional<Trial>> trials = settle_all(sets);
    const std::vector<Chosen> chosen = choose(places, trials);
    std::vector<std::vector<Move>> combined(2);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        combined[0].push_back(chosen[k].move);
        if (k < (chosen.size() + 1) / 2) {
            combined[1].push_back(chosen[k].move);
        }
    }
    if (chosen.size() == 1) {
        combined.pop_back();
    }
    std::vector<std::optional<Trial>> second = settle_all(combined);
    trials.insert(trials.end(), std::make_move_iterator(second.begin()), std::make_move_iterator(second.end()));
    const std::size_t corners = best_.plan.triangles.points.size();
    if (take(trials)) {
        if (best_.plan.triangles.points.size() < corners) {
            tried_.clear(); // corners have other numbers now
        }
        for (const Place& place : places) {
            tried_.erase(place.corners);
        }
        in_vain_ = 0;
        runner_up_.reset();
    } else {
        ++in_vain_;
        remember(trials);
    }
    return in_vain_ < (best_.excess > 0 ? more_patience : patience);
}

} // namespace

long polish(Trial& best, const Trials& trials, Aim aim, double price, long work)
{
    return Polishing(best, trials, aim, price, work).run();
}

} // namespace rhombloom
