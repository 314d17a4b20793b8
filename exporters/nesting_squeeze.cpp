#include "exporters/nesting_squeeze.h"

#include <algorithm>
#include <array>

#include "core/units.h"
#include "exporters/nesting_crowd.h"
#include "exporters/nesting_parallel.h"
#include "exporters/nesting_rows.h"

namespace rhombloom::nesting {

namespace {

//! Work of the search for one copy more: boundary points looked at, about 17 ns each.
constexpr double squeeze_work = 1.5e8;
constexpr int rounds = 20;
constexpr int steps = 20;
constexpr std::size_t fewest = 4;
constexpr std::size_t most = 120;
constexpr std::size_t openings_per_attempt = 3;

//! The same numbers on every machine (splitmix64).
class Dice
{
public:
    explicit Dice(std::size_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 1) {}

    //! Evenly in [0, 1).
    double roll()
    {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

    std::size_t below(std::size_t n) { return static_cast<std::size_t>(roll() * static_cast<double>(n)); }

private:
    std::uint64_t state_;
};

using Poses = std::vector<Pose>;

//! What to look for, and from where.
struct Quest
{
    const Piece& piece;
    const Room& room;
    Body body;
    std::size_t count;
    Poses known;               //!< one copy less
    std::vector<Poses> starts; //!< patterns for a room slightly too large, the closest first
    bool may_turn = true;

    Crowd crowd(Poses poses) const { return Crowd(body, room, std::move(poses), may_turn); }
};

//! The first \p count copies as they lie in \p from, moved evenly into \p to.
Poses shrunk(const Body& body, const Layout& layout, std::size_t count, const Room& from, const Room& to)
{
    Poses poses;
    for (std::size_t i = 0; i < count; ++i) {
        poses.push_back(body.pose(layout[i]));
        poses.back().at = poses.back().at.cwiseProduct(Vec2(to.width / from.width, to.height / from.height));
    }
    return poses;
}

Room grown(const Room& room, double x, double y)
{
    return {room.width * (1 + x), room.height * (1 + y)};
}

std::vector<Poses> pattern_starts(const Quest& quest)
{
    constexpr std::size_t enough = 300, most_trials = 900;
    constexpr std::array<std::array<double, 2>, 3> ways = {{{0.5, 0.5}, {1, 0}, {0, 1}}};
    const std::vector<Trial> trials = trials_for(quest.piece, quest.room);
    const std::size_t looked_at = std::min(trials.size(), most_trials) * ways.size();
    std::vector<bool> done(looked_at, false);
    std::vector<Poses> starts;
    for (const double growth : {0.01, 0.02, 0.03, 0.045, 0.06, 0.08, 0.1, 0.13, 0.17, 0.22, 0.3}) {
        for (std::size_t i = 0; i < looked_at && starts.size() < enough; ++i) {
            if (done[i]) {
                continue;
            }
            const Trial& trial = trials[i / ways.size()];
            const auto& way = ways[i % ways.size()];
            const Room larger = grown(quest.room, growth * way[0], growth * way[1]);
            const Layout layout = fragment(*trial.pattern, trial.angle, quest.piece.hull, larger, quest.count);
            if (!layout.empty()) {
                starts.push_back(shrunk(quest.body, layout, quest.count, larger, quest.room));
                done[i] = true;
            }
        }
    }
    return starts;
}

//! Stacked rows at some angle for a room slightly too large.
Poses row_start(const Quest& quest, Dice& dice)
{
    const double angle = quest.may_turn ? two_pi * dice.roll() : 0;
    for (const double growth : {0.02, 0.04, 0.06, 0.09, 0.13, 0.18, 0.25}) {
        const bool wide = dice.roll() < 0.5;
        const Room larger = grown(quest.room, wide ? growth : growth / 4, wide ? growth / 4 : growth);
        const Layout rows = stacked_rows(quest.piece, larger, angle);
        if (rows.size() >= quest.count) {
            return shrunk(quest.body, rows, quest.count, larger, quest.room);
        }
    }
    return {};
}

Pose random_pose(const Quest& quest, Dice& dice)
{
    Pose pose = quest.known[dice.below(quest.known.size())];
    pose.at = Vec2(quest.room.width * dice.roll(), quest.room.height * dice.roll());
    const double how = dice.roll();
    if (quest.may_turn && how < 0.5) {
        pose.angle = how < 0.25 ? pose.angle + pi : two_pi * dice.roll();
    }
    return pose;
}

//! Of many random poses the one under the least pressure from all copies but \p except.
Pose easiest_pose(const Quest& quest, const Crowd& crowd, std::size_t except, Dice& dice)
{
    constexpr int samples = 150;
    Pose best;
    double least = 1e300;
    for (int k = 0; k < samples; ++k) {
        const Pose pose = random_pose(quest, dice);
        const double pressure = crowd.pressure(pose, except, least);
        if (pressure < least) {
            least = pressure;
            best = pose;
        }
    }
    return best;
}

//! The known layout, a few neighbours taken out and one more put in.
Poses crammed(const Quest& quest, Dice& dice)
{
    Poses poses = quest.known;
    const Vec2 hole(quest.room.width * dice.roll(), quest.room.height * dice.roll());
    std::stable_sort(poses.begin(), poses.end(), [&](const Pose& p, const Pose& q) {
        return (p.at - hole).squaredNorm() > (q.at - hole).squaredNorm();
    });
    poses.resize(poses.size() - std::min(poses.size() - 1, dice.below(5)));
    Crowd crowd = quest.crowd(std::move(poses));
    while (crowd.poses().size() < quest.count) {
        crowd.add(easiest_pose(quest, crowd, quest.count, dice));
    }
    return crowd.poses();
}

enum class Kind
{
    Pattern,
    Rows,
    Crammed
};

//! Where an attempt sets out: a start after its first descent.
struct Opening
{
    Kind kind = Kind::Crammed;
    Poses poses;
    double energy = 0;
    bool solved = false;
};

Opening opening(const Quest& quest, std::size_t index)
{
    Dice dice(index);
    Opening result;
    if (index % 4 < 2 && !quest.starts.empty()) {
        const double nearer = dice.roll() * dice.roll();
        result = {Kind::Pattern, quest.starts[static_cast<std::size_t>(nearer * double(quest.starts.size()))]};
    } else if (index % 4 == 2) {
        result = {Kind::Rows, row_start(quest, dice)};
    }
    if (result.poses.empty()) {
        result = {Kind::Crammed, crammed(quest, dice)};
    }
    Crowd crowd = quest.crowd(std::move(result.poses));
    result.solved = crowd.relax(steps);
    result.energy = crowd.energy();
    result.poses = crowd.poses();
    return result;
}

//! The copy under the highest pressure goes where it is lowest.
void relocate(const Quest& quest, Crowd& crowd, Dice& dice)
{
    std::size_t worst = 0;
    double highest = -1;
    for (std::size_t i = 0; i < crowd.poses().size(); ++i) {
        const double pressure = crowd.pressure(crowd.poses()[i], i) * (0.5 + dice.roll());
        if (pressure > highest) {
            highest = pressure;
            worst = i;
        }
    }
    crowd.replace(worst, easiest_pose(quest, crowd, worst, dice));
}

//! Descents, with more weight on what still overlaps after each, and now and then a copy moved elsewhere.
Poses separated(const Quest& quest, const Opening& opening, std::size_t index)
{
    constexpr int relocate_every = 3;
    Dice dice(~index);
    Crowd crowd = quest.crowd(opening.poses);
    for (int round = 1; round <= rounds; ++round) {
        crowd.blame();
        if (round % relocate_every == 0) {
            relocate(quest, crowd, dice);
        }
        if (crowd.relax(steps)) {
            return crowd.poses();
        }
    }
    return {};
}

//! The best openings of each kind take turns, for their energies do not compare. Patterns do best on small sheets,
//! crammed layouts on large ones.
std::vector<Opening> chosen(std::vector<Opening> openings, std::size_t attempts)
{
    std::stable_sort(openings.begin(), openings.end(),
                     [](const Opening& a, const Opening& b) { return a.energy < b.energy; });
    std::array<std::vector<Opening>, 3> by_kind;
    for (Opening& o : openings) {
        by_kind[static_cast<std::size_t>(o.kind)].push_back(std::move(o));
    }
    constexpr std::array turns = {Kind::Pattern, Kind::Crammed, Kind::Pattern, Kind::Crammed, Kind::Rows};
    std::array<std::size_t, 3> taken = {};
    std::vector<Opening> result;
    for (std::size_t i = 0; i < turns.size() * openings.size() && result.size() < attempts; ++i) {
        const auto kind = static_cast<std::size_t>(turns[i % turns.size()]);
        if (taken[kind] < by_kind[kind].size()) {
            result.push_back(std::move(by_kind[kind][taken[kind]++]));
        }
    }
    return result;
}

//! Exact, for the end: all copies in the room and no boundary across another.
bool proven(const Piece& piece, const Room& room, const Layout& layout)
{
    std::vector<Polygon> placed_copies;
    for (const Placement& p : layout) {
        const Box box = extents(piece.hull, {p.angle, p.mirrored});
        if ((box.min + p.offset).minCoeff() < 0 || box.max.x() + p.offset.x() > room.width ||
            box.max.y() + p.offset.y() > room.height) {
            return false;
        }
        Polygon copy = oriented(piece.inflated, {p.angle, p.mirrored});
        for (Vec2& v : copy) {
            v += p.offset;
        }
        placed_copies.push_back(std::move(copy));
    }
    for (std::size_t i = 0; i < placed_copies.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (boundaries_meet(placed_copies[i], placed_copies[j])) {
                return false;
            }
        }
    }
    return true;
}

Layout delivered(const Quest& quest, const Poses& poses)
{
    Layout layout;
    for (const Pose& pose : poses) {
        layout.push_back(quest.body.placement(pose));
    }
    return proven(quest.piece, quest.room, layout) ? layout : Layout{};
}

} // namespace

Layout squeezed(const Piece& piece, const Room& room, const Layout& layout)
{
    if (layout.empty() || piece.patterns.empty()) {
        return {};
    }
    Quest quest{piece, room, Body(piece), layout.size() + 1, {}, {}, piece.grain == Grain::Any};
    const double per_attempt = static_cast<double>(rounds * steps * quest.count * quest.body.probes());
    const double area = (room.width + piece.spacing) * (room.height + piece.spacing);
    if (squeeze_work / per_attempt < fewest || signed_area(piece.inflated) * static_cast<double>(quest.count) > area) {
        return {};
    }
    const auto attempts = std::min(most, static_cast<std::size_t>(squeeze_work / per_attempt));
    for (const Placement& p : layout) {
        quest.known.push_back(quest.body.pose(p));
    }
    quest.starts = pattern_starts(quest);
    std::vector<Opening> openings(openings_per_attempt * attempts);
    if (const auto i = first_of(openings.size(), [&](std::size_t k) {
            openings[k] = opening(quest, k);
            return openings[k].solved && !delivered(quest, openings[k].poses).empty();
        })) {
        return delivered(quest, openings[*i].poses);
    }
    openings = chosen(std::move(openings), attempts);
    std::vector<Layout> layouts(openings.size());
    const auto i = first_of(openings.size(), [&](std::size_t k) {
        layouts[k] = delivered(quest, separated(quest, openings[k], k));
        return !layouts[k].empty();
    });
    return i ? layouts[*i] : Layout{};
}

} // namespace rhombloom::nesting
