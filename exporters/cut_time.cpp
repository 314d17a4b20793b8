#include "exporters/cut_time.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace rhombloom {

namespace {

constexpr double corner = radians(5);

//! A stretch driven without a stop inside.
struct Stretch
{
    double length;
    double limit;           //!< mm/s
    double heading;         //!< at its start, radians
    double heading_end = 0; //!< at its end
};

Stretch stretch(const PathVertex& from, const Vec2& to, const Speeds& speeds, double speed)
{
    const Vec2 chord = to - from.point;
    const double half_sweep = 2 * std::atan(from.bulge);
    const double heading = std::atan2(chord.y(), chord.x());
    if (from.bulge == 0) {
        return {chord.norm(), speed, heading, heading};
    }
    const double radius = chord.norm() / (2 * std::abs(std::sin(half_sweep)));
    const double limit = std::min(speed, std::sqrt(speeds.acceleration * radius));
    return {radius * 2 * std::abs(half_sweep), limit, heading - half_sweep, heading + half_sweep};
}

std::vector<Stretch> stretches(const Path& path, const Speeds& speeds, double speed)
{
    std::vector<Stretch> result;
    const std::size_t n = path.vertices.size();
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < n; ++i) {
        result.push_back(stretch(path.vertices[i], path.vertices[(i + 1) % n].point, speeds, speed));
    }
    return result;
}

double seconds(double length, double entry, double exit, double limit, double acceleration)
{
    const double reachable = std::sqrt(acceleration * length + (entry * entry + exit * exit) / 2);
    const double peak = std::min(limit, reachable);
    const double ramps = (2 * peak * peak - entry * entry - exit * exit) / (2 * acceleration);
    return (2 * peak - entry - exit) / acceleration + std::max(0.0, length - ramps) / peak;
}

//! From rest to rest.
double path_seconds(const std::vector<Stretch>& way, double acceleration)
{
    std::vector<double> speed(way.size() + 1, 0.0); // at the joints
    for (std::size_t i = 1; i < way.size(); ++i) {
        const double turn = std::remainder(way[i].heading - way[i - 1].heading_end, two_pi);
        const double reach = std::sqrt(speed[i - 1] * speed[i - 1] + 2 * acceleration * way[i - 1].length);
        speed[i] = std::abs(turn) > corner ? 0 : std::min({way[i - 1].limit, way[i].limit, reach});
    }
    double sum = 0;
    for (std::size_t i = way.size(); i-- > 0;) {
        speed[i] = std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + 2 * acceleration * way[i].length));
        sum += seconds(way[i].length, speed[i], speed[i + 1], way[i].limit, acceleration);
    }
    return sum;
}

double move_seconds(double length, const Speeds& speeds)
{
    return length > 0 ? seconds(length, 0, 0, speeds.travel, speeds.acceleration) : 0;
}

} // namespace

CutWork cut_work(const Drawing& drawing, const Speeds& speeds)
{
    CutWork work;
    Vec2 position = Vec2::Zero();
    const auto move_to = [&](const Vec2& target) {
        const double distance = (target - position).norm();
        work.travel += distance;
        work.seconds += move_seconds(distance, speeds);
        position = target;
    };
    for (const Layer& layer : drawing.layers) {
        if (layer.use == LayerUse::Sheet || layer.use == LayerUse::Reference) {
            continue;
        }
        const bool engraved = layer.use == LayerUse::Engrave;
        for (const Path& path : layer.paths) {
            move_to(path.vertices.front().point);
            const double speed = engraved ? speeds.engrave : speeds.cut;
            work.seconds += speeds.pierce + path_seconds(stretches(path, speeds, speed), speeds.acceleration);
            (engraved ? work.engrave : work.cut) += length(path);
            ++work.pierces;
            position = path.closed ? position : path.vertices.back().point;
        }
    }
    move_to(Vec2::Zero());
    return work;
}

} // namespace rhombloom
