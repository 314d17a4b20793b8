#include "exporters/nesting_double.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"
#include "exporters/nesting_skyline.h"

namespace rhombloom::nesting {

namespace {

//! What fixes a stack: the rows' direction, their pitch as a multiple of the closest one, and the shifts of the row
//! of mates and of the next row of drawn copies, in pitches.
struct Stack
{
    std::array<double, 4> at{}; //!< direction (radians), stretch, mate's shift, next shift
    double cell = 1e300;

    double direction() const { return at[0]; }
    double stretch() const { return std::max(1.0, at[1]); }
};

double pitch_of(const Mates& mates, const Stack& stack)
{
    const Vec2 along(std::cos(stack.direction()), std::sin(stack.direction()));
    return stack.stretch() * std::max(reach_along(mates.self, along), reach_along(mates.other, along));
}

//! The four skylines of a direction and pitch.
struct Rows
{
    Skyline self, other, up, down;

    Rows(const Mates& mates, const Turn& t, double pitch)
        : self(mates.self, t, Sense::Forward, pitch), other(mates.other, t, Sense::Forward, pitch),
          up(mates.cross, t, Sense::Forward, pitch), down(mates.cross, t, Sense::Reversed, pitch)
    {
    }

    double pitch() const { return self.pitch(); }
    double next_height(double mate_x, double next_x) const
    {
        const double stacked = up.at(mate_x) + down.at(next_x - mate_x);
        return std::max({stacked, self.at(next_x), other.at(next_x)});
    }
};

Rows rows_of(const Mates& mates, const Stack& stack)
{
    return Rows(mates, turn(-stack.direction()), pitch_of(mates, stack));
}

double cell_of(const Mates& mates, const Stack& stack)
{
    const Rows rows = rows_of(mates, stack);
    const double p = rows.pitch();
    return p * rows.next_height(stack.at[2] * p, stack.at[3] * p);
}

//! The best shifts of one direction and pitch, on a grid.
Stack best_on_grid(const Mates& mates, Stack stack)
{
    constexpr std::size_t n = 64;
    const Rows rows = rows_of(mates, stack);
    const double p = rows.pitch();
    std::array<double, n> up{}, down{}, straight{};
    for (std::size_t i = 0; i < n; ++i) {
        const double x = p * static_cast<double>(i) / n;
        up[i] = rows.up.at(x);
        down[i] = rows.down.at(x);
        straight[i] = std::max(rows.self.at(x), rows.other.at(x));
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double cell = p * std::max(up[i] + down[(j + n - i) % n], straight[j]);
            if (cell < stack.cell) {
                stack.cell = cell;
                stack.at[2] = static_cast<double>(i) / n;
                stack.at[3] = static_cast<double>(j) / n;
            }
        }
    }
    return stack;
}

//! Pattern search over all four parameters.
Stack refined(const Mates& mates, Stack stack)
{
    std::array<double, 4> step = {0.02, 0.01, 0.008, 0.008};
    for (int round = 0; round < 26; ++round) {
        bool better = false;
        for (std::size_t k = 0; k < 4; ++k) {
            for (const double way : {step[k], -step[k]}) {
                Stack moved = stack;
                moved.at[k] += way;
                moved.at[1] = std::max(1.0, moved.at[1]);
                moved.cell = cell_of(mates, moved);
                if (moved.cell < stack.cell * (1 - 1e-12)) {
                    stack = moved;
                    better = true;
                }
            }
        }
        if (!better) {
            for (double& s : step) {
                s /= 3;
            }
        }
    }
    return stack;
}

std::vector<Stack> sampled_stacks(const Mates& mates)
{
    std::vector<double> directions;
    constexpr int even = 60;
    for (int i = 0; i < even; ++i) {
        directions.push_back(pi * i / even);
    }
    std::vector<Stack> stacks;
    for (const double direction : directions) {
        for (const double stretch : {1.0, 1.03, 1.08, 1.16, 1.3}) {
            stacks.push_back(best_on_grid(mates, {{direction, stretch, 0, 0}, 1e300}));
        }
    }
    std::stable_sort(stacks.begin(), stacks.end(), [](const Stack& a, const Stack& b) { return a.cell < b.cell; });
    return stacks;
}

Pattern pattern_of(const Mates& mates, const Stack& stack)
{
    const Rows rows = rows_of(mates, stack);
    const double p = rows.pitch(), mate_x = stack.at[2] * p, next_x = stack.at[3] * p;
    const Turn back = turn(stack.direction());
    Pattern pattern;
    pattern.lattice = {back * Vec2(p, 0), back * Vec2(next_x, rows.next_height(mate_x, next_x))};
    pattern.members = {{{}, Vec2::Zero()}, {mates.mate, back * Vec2(mate_x, rows.up.at(mate_x))}};
    return pattern;
}

bool clear(const NoFit& region, const Lattice& lattice, const Vec2& offset)
{
    const double far = region.reach + offset.norm();
    const int rows = static_cast<int>(far / (0.866 * lattice.v2.norm())) + 1;
    const int columns = static_cast<int>(far / (0.866 * lattice.v1.norm())) + 1;
    for (int j = -rows; j <= rows; ++j) {
        for (int i = -columns; i <= columns; ++i) {
            if (overlaps(region, offset + i * lattice.v1 + j * lattice.v2)) {
                return false;
            }
        }
    }
    return true;
}

bool admissible(const Mates& mates, Pattern& pattern)
{
    pattern.lattice = reduced(pattern.lattice);
    return admissible(pattern.lattice, mates.self) && admissible(pattern.lattice, mates.other) &&
           clear(mates.cross, pattern.lattice, pattern.members[1].offset);
}

} // namespace

Mates mates_of(const Polygon& inflated, const NoFit& self, const Orientation& mate)
{
    const Polygon other = oriented(inflated, mate);
    return {mate, self, no_fit(other, other), no_fit(inflated, other)};
}

std::vector<Pattern> double_patterns(const Mates& mates, int keep)
{
    std::vector<Stack> stacks = sampled_stacks(mates);
    stacks.resize(std::min<std::size_t>(stacks.size(), 2 * static_cast<std::size_t>(keep)));
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        stacks[i] = refined(mates, stacks[i]);
    }
    std::stable_sort(stacks.begin(), stacks.end(), [](const Stack& a, const Stack& b) { return a.cell < b.cell; });
    std::vector<Pattern> patterns;
    for (const Stack& stack : stacks) {
        Pattern pattern = pattern_of(mates, stack);
        const bool known = !patterns.empty() && std::abs(patterns.back().lattice.cell() - stack.cell) < 1e-6;
        if (!known && std::ssize(patterns) < keep && admissible(mates, pattern)) {
            patterns.push_back(std::move(pattern));
        }
    }
    return patterns;
}

} // namespace rhombloom::nesting
