// Overlaps weighed by pair and taken away by local descent: the guided search of J. Egeblad, B. Nielsen and A. Odgaard,
// European Journal of Operational Research 183 (2007), with Gauss-Newton steps in all positions and angles at once.
#include "exporters/nesting_crowd.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace rhombloom::nesting {

namespace {

//! Copies are kept this much further apart than they must be (mm), so that the end does not hang on rounding.
constexpr double rim = 0.01;
constexpr double wall_rim = 0.001;

constexpr double longest_probe_step = 5;
constexpr std::size_t chunk_size = 12;

Polygon moved(Polygon polygon, const Vec2& by)
{
    for (Vec2& p : polygon) {
        p += by;
    }
    return polygon;
}

Polygon probes_of(const Polygon& polygon)
{
    Polygon probes;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / longest_probe_step)));
        for (int k = 0; k < parts; ++k) {
            probes.push_back(a + (b - a) * (static_cast<double>(k) / parts));
        }
    }
    return probes;
}

Vec2 perpendicular(const Vec2& v)
{
    return {-v.y(), v.x()};
}

Frame frame(const Pose& pose)
{
    const Turn t = turn(pose.angle);
    const double m = pose.mirrored ? -1 : 1;
    return {pose.at, (Eigen::Matrix2d() << m * t.c, -t.s, m * t.s, t.c).finished()};
}

} // namespace

Body::Body(const Piece& piece) : Body(piece, 0.5 * (box_of(piece.hull).min + box_of(piece.hull).max)) {}

Body::Body(const Piece& piece, const Vec2& middle)
    : middle_(middle), outline_(moved(piece.inflated, -middle)), field_(outline_, rim), probes_(probes_of(outline_)),
      hull_(moved(piece.hull, -middle))
{
    double squares = 0;
    for (const Vec2& p : probes_) {
        squares += p.squaredNorm();
        reach_ = std::max(reach_, p.norm() + rim);
    }
    gyration_ = std::sqrt(squares / static_cast<double>(probes_.size()));
    for (std::size_t first = 0; first < probes_.size(); first += chunk_size) {
        Chunk chunk{Vec2::Zero(), 0, first, std::min(first + chunk_size, probes_.size())};
        Box box;
        for (std::size_t i = chunk.first; i < chunk.last; ++i) {
            box.min = box.min.cwiseMin(probes_[i]);
            box.max = box.max.cwiseMax(probes_[i]);
        }
        chunk.centre = 0.5 * (box.min + box.max);
        for (std::size_t i = chunk.first; i < chunk.last; ++i) {
            chunk.radius = std::max(chunk.radius, (probes_[i] - chunk.centre).norm());
        }
        chunks_.push_back(chunk);
    }
}

Pose Body::pose(const Placement& placement) const
{
    Pose pose{Vec2::Zero(), placement.angle, placement.mirrored};
    pose.at = placement.offset + frame(pose).axes * middle_;
    return pose;
}

Placement Body::placement(const Pose& pose) const
{
    return {pose.angle, pose.mirrored, pose.at - frame(pose).axes * middle_};
}

//! The normal equations of one step: only pairs in contact have a block beside the diagonal.
struct Crowd::System
{
    struct Link
    {
        std::size_t i, j;
        Eigen::Matrix3d block; //!< row i, column j
    };
    std::vector<Eigen::Matrix3d> diagonal;
    std::vector<Link> links;
    Eigen::VectorXd g;
    double energy = 0;
    double deepest = 0; //!< largest residual over its rim

    void clear(std::size_t n)
    {
        diagonal.assign(n, Eigen::Matrix3d::Zero());
        links.clear();
        g.setZero(static_cast<Eigen::Index>(3 * n));
        energy = deepest = 0;
    }

    void add(double weight, double r, std::size_t i, const Eigen::Vector3d& d)
    {
        diagonal[i] += weight * d * d.transpose();
        g.segment<3>(static_cast<Eigen::Index>(3 * i)) += weight * r * d;
    }

    Eigen::VectorXd times(const std::vector<Eigen::Matrix3d>& damped, const Eigen::VectorXd& x) const
    {
        Eigen::VectorXd y(x.size());
        for (std::size_t i = 0; i < damped.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(3 * i);
            y.segment<3>(k) = damped[i] * x.segment<3>(k);
        }
        for (const Link& link : links) {
            const auto a = static_cast<Eigen::Index>(3 * link.i), b = static_cast<Eigen::Index>(3 * link.j);
            y.segment<3>(a) += link.block * x.segment<3>(b);
            y.segment<3>(b) += link.block.transpose() * x.segment<3>(a);
        }
        return y;
    }

    //! The damped Gauss-Newton step by conjugate gradients, preconditioned copy by copy.
    Eigen::VectorXd step(double damping, bool may_turn) const
    {
        constexpr int most = 40;
        constexpr double accuracy = 1e-2;
        std::vector<Eigen::Matrix3d> damped = diagonal, inverse(diagonal.size());
        for (std::size_t i = 0; i < damped.size(); ++i) {
            damped[i].diagonal().array() += damping * (1 + diagonal[i].diagonal().array());
            if (!may_turn) {
                damped[i](2, 2) = 1e30;
            }
            inverse[i] = damped[i].inverse();
        }
        const auto preconditioned = [&](const Eigen::VectorXd& r) {
            Eigen::VectorXd z(r.size());
            for (std::size_t i = 0; i < inverse.size(); ++i) {
                const auto k = static_cast<Eigen::Index>(3 * i);
                z.segment<3>(k) = inverse[i] * r.segment<3>(k);
            }
            return z;
        };
        Eigen::VectorXd x = Eigen::VectorXd::Zero(g.size()), r = -g, z = preconditioned(r), p = z;
        double rz = r.dot(z);
        const double enough = accuracy * accuracy * rz;
        for (int k = 0; k < most && rz > enough; ++k) {
            const Eigen::VectorXd hp = times(damped, p);
            const double alpha = rz / p.dot(hp);
            x += alpha * p;
            r -= alpha * hp;
            z = preconditioned(r);
            const double before = rz;
            rz = r.dot(z);
            p = z + rz / before * p;
        }
        return x;
    }
};

//! Calls \p found(point of the prober, its depth in the owner) for every boundary point in the owner or its rim; both
//! in the owner's frame.
template <class Found>
void Body::each_contact(const Frame& owner, const Frame& prober, const Found& found) const
{
    const Eigen::Matrix2d spin = owner.axes.transpose() * prober.axes;
    const Vec2 move = owner.axes.transpose() * (prober.at - owner.at);
    for (const Chunk& chunk : chunks_) {
        if (field_.far_from(spin * chunk.centre + move, chunk.radius)) {
            continue;
        }
        for (std::size_t k = chunk.first; k < chunk.last; ++k) {
            const Vec2 p = spin * probes_[k] + move;
            const Depth depth = field_.at(p);
            if (depth.depth > -rim) {
                found(p, depth);
            }
        }
    }
}

Crowd::Crowd(const Body& body, const Room& room, std::vector<Pose> poses, bool may_turn)
    : body_(body), room_(room), poses_(std::move(poses)), weights_(poses_.size() * poses_.size(), 1.0),
      may_turn_(may_turn)
{
    for (const Pose& pose : poses_) {
        frames_.push_back(frame(pose));
    }
}

void Crowd::replace(std::size_t i, const Pose& pose)
{
    poses_[i] = pose;
    frames_[i] = frame(pose);
    for (std::size_t j = 0; j < poses_.size(); ++j) {
        weight(i, j) = weight(j, i) = 1;
    }
}

void Crowd::add(const Pose& pose)
{
    poses_.push_back(pose);
    frames_.push_back(frame(pose));
    weights_.assign(poses_.size() * poses_.size(), 1.0);
}

void Crowd::add_pair(std::size_t owner, std::size_t prober, System& system, Eigen::Matrix3d& block) const
{
    const Frame &a = frames_[owner], &b = frames_[prober];
    const double w = weight(owner, prober);
    body_.each_contact(a, b, [&](const Vec2& local, const Depth& depth) {
        const Vec2 n = a.axes * depth.outward, arm = a.axes * local;
        const double r = depth.depth + rim;
        const double turn_a = n.dot(perpendicular(arm)) / body_.gyration_;
        const double turn_b = n.dot(perpendicular(arm + a.at - b.at)) / body_.gyration_;
        const Eigen::Vector3d da(n.x(), n.y(), turn_a), db(-n.x(), -n.y(), -turn_b);
        system.add(w, r, owner, da);
        system.add(w, r, prober, db);
        system.energy += w * r * r;
        system.deepest = std::max(system.deepest, r / rim);
        block += w * da * db.transpose();
    });
}

void Crowd::add_walls(std::size_t i, System& system) const
{
    for (const Vec2& corner : body_.hull_) {
        const Vec2 arm = frames_[i].axes * corner, p = poses_[i].at + arm, spin = perpendicular(arm) / body_.gyration_;
        const auto wall = [&](double r, const Vec2& d) {
            if (r > 0) {
                system.add(1, r, i, {d.x(), d.y(), d.dot(spin)});
                system.energy += r * r;
                system.deepest = std::max(system.deepest, r / wall_rim);
            }
        };
        wall(wall_rim - p.x(), Vec2(-1, 0));
        wall(wall_rim - p.y(), Vec2(0, -1));
        wall(p.x() + wall_rim - room_.width, Vec2(1, 0));
        wall(p.y() + wall_rim - room_.height, Vec2(0, 1));
    }
}

double Crowd::assemble(System& system) const
{
    system.clear(poses_.size());
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        add_walls(i, system);
        for (std::size_t j = 0; j < i; ++j) {
            if (!may_meet(poses_[i], poses_[j])) {
                continue;
            }
            Eigen::Matrix3d ij = Eigen::Matrix3d::Zero(), ji = ij;
            add_pair(i, j, system, ij);
            add_pair(j, i, system, ji);
            ij += ji.transpose();
            if (!ij.isZero(0)) {
                system.links.push_back({i, j, ij});
            }
        }
    }
    return system.energy;
}

void Crowd::move_all(const Eigen::VectorXd& move)
{
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(3 * i);
        poses_[i].at += move.segment<2>(k);
        poses_[i].angle += may_turn_ ? move[k + 2] / body_.gyration_ : 0;
        frames_[i] = frame(poses_[i]);
    }
}

bool Crowd::relax(int steps)
{
    constexpr double apart = 0.9; // of the rim may remain
    constexpr double longest = 8; // mm in one step
    System system, next;
    assemble(system);
    double damping = 1e-3;
    for (int step = 0; step < steps && system.deepest > apart && damping < 1e4; ++step) {
        Eigen::VectorXd move = system.step(damping, may_turn_);
        move *= std::min(1.0, longest / std::max(move.cwiseAbs().maxCoeff(), 1e-300));
        const std::vector<Pose> poses = poses_;
        const std::vector<Frame> frames = frames_;
        move_all(move);
        if (assemble(next) >= system.energy) {
            poses_ = poses;
            frames_ = frames;
            damping *= 8;
            continue;
        }
        const bool stuck = next.energy > 0.998 * system.energy;
        std::swap(system, next);
        damping = std::max(1e-6, damping / 4);
        if (stuck) {
            break;
        }
    }
    return system.deepest <= apart;
}

double Crowd::pressure(const Pose& pose, std::size_t except, double limit) const
{
    const Frame here = frame(pose);
    double sum = 0;
    for (const Vec2& corner : body_.hull_) {
        const Vec2 p = pose.at + here.axes * corner;
        sum += (p - Vec2(room_.width, room_.height)).cwiseMax(-p).cwiseMax(0.0).squaredNorm();
    }
    for (std::size_t j = 0; j < poses_.size() && sum < limit; ++j) {
        if (j == except || !may_meet(pose, poses_[j])) {
            continue;
        }
        const double w = except < poses_.size() ? weight(except, j) : 1;
        const auto add = [&](const Vec2&, const Depth& depth) { sum += w * std::pow(depth.depth + rim, 2); };
        body_.each_contact(frames_[j], here, add);
        body_.each_contact(here, frames_[j], add);
    }
    return sum;
}

void Crowd::blame()
{
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!may_meet(poses_[i], poses_[j])) {
                continue;
            }
            double deepest = 0;
            const auto look = [&](const Vec2&, const Depth& depth) { deepest = std::max(deepest, depth.depth); };
            body_.each_contact(frames_[i], frames_[j], look);
            body_.each_contact(frames_[j], frames_[i], look);
            double& w = weight(i, j);
            w = deepest > 0 ? w * (1.2 + std::min(1.0, deepest)) : 1 + 0.9 * (w - 1);
            weight(j, i) = w;
        }
    }
}

double Crowd::energy() const
{
    System system;
    return assemble(system);
}

bool Crowd::may_meet(const Pose& a, const Pose& b) const
{
    return (a.at - b.at).squaredNorm() < body_.diameter() * body_.diameter();
}

} // namespace rhombloom::nesting
