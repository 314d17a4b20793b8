#include "exporters/nesting_skyline.h"

#include <algorithm>
#include <cmath>

namespace rhombloom::nesting {

namespace {

constexpr std::size_t bucket_count = 48;

//! Ends of slopes are found in spite of rounding when x is folded into the period (mm).
constexpr double rounding = 1e-10;

} // namespace

Skyline::Skyline(const NoFit& region, const Turn& t, Sense sense, double pitch) : pitch_(pitch), buckets_(bucket_count)
{
    const double sign = sense == Sense::Forward ? 1 : -1;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
            const Vec2 a = sign * (t * contour[j]), b = sign * (t * contour[i]);
            if (b.x() < a.x()) { // counter-clockwise: only edges that run to the left can be seen from above
                add(b, a);
            }
        }
    }
    drop_hidden();
}

double Skyline::bucket_start(std::size_t k) const
{
    return pitch_ * static_cast<double>(k) / static_cast<double>(bucket_count);
}

void Skyline::add(const Vec2& a, const Vec2& b)
{
    const double width = pitch_ / static_cast<double>(bucket_count);
    const auto first = static_cast<long>(std::floor((a.x() - rounding) / width));
    const auto last = static_cast<long>(std::floor((b.x() + rounding) / width));
    const long n = static_cast<long>(bucket_count);
    for (long k = first; k <= last; ++k) {
        const long period = k >= 0 ? k / n : -((-k + n - 1) / n);
        const double moved = -pitch_ * static_cast<double>(period);
        buckets_[static_cast<std::size_t>(k - period * n)].push_back({a.x() + moved, a.y(), b.x() + moved, b.y()});
    }
}

void Skyline::drop_hidden()
{
    for (std::size_t k = 0; k < bucket_count; ++k) {
        const double low = bucket_start(k), high = bucket_start(k + 1);
        double floor = -1e300; // a slope over the whole bucket hides all below its lower end
        for (const Slope& s : buckets_[k]) {
            if (s.x0 <= low && s.x1 >= high) {
                floor = std::max(floor, std::min(s.at(low), s.at(high)));
            }
        }
        std::erase_if(buckets_[k], [&](const Slope& s) {
            return std::max(s.at(std::max(low, s.x0)), s.at(std::min(high, s.x1))) < floor;
        });
    }
}

double Skyline::at(double x) const
{
    const double folded = std::clamp(x - pitch_ * std::floor(x / pitch_), 0.0, pitch_);
    const auto k =
        std::min(bucket_count - 1, static_cast<std::size_t>(folded / pitch_ * static_cast<double>(bucket_count)));
    double height = 0;
    for (const Slope& s : buckets_[k]) {
        if (folded >= s.x0 - rounding && folded <= s.x1 + rounding) {
            height = std::max(height, s.at(std::clamp(folded, s.x0, s.x1)));
        }
    }
    return height;
}

double Skyline::refined_valley(double x, double reach) const
{
    for (double step = reach; step > 1e-7; step /= 2) {
        for (const double to : {x - step, x + step}) {
            if (at(to) < at(x)) {
                x = to;
            }
        }
    }
    return x - pitch_ * std::floor(x / pitch_);
}

std::vector<double> Skyline::valleys() const
{
    constexpr int samples = 96;
    const double step = pitch_ / samples;
    std::vector<double> found;
    for (int i = 0; i < samples; ++i) {
        const double here = at(i * step);
        if (here <= at((i - 1) * step) && here < at((i + 1) * step)) {
            found.push_back(refined_valley(i * step, step));
        }
    }
    return found;
}

} // namespace rhombloom::nesting
