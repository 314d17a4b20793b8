#pragma once

#include <vector>

#include "exporters/nesting_depth.h"
#include "exporters/nesting_layout.h"

namespace rhombloom::nesting {

//! \brief A copy in a crowd: where its middle is, not its origin.
struct Pose
{
    Vec2 at = Vec2::Zero();
    double angle = 0;
    bool mirrored = false;
};

//! \brief A pose as a map from the copy's own coordinates.
struct Frame
{
    Vec2 at = Vec2::Zero();
    Eigen::Matrix2d axes = Eigen::Matrix2d::Identity(); //!< mirrored, then turned
};

//! \brief What one copy is to its neighbours and to the walls: where its boundary points are, and how deep other
//! points lie in it.
class Body
{
public:
    explicit Body(const Piece& piece);

    Pose pose(const Placement& placement) const;
    Placement placement(const Pose& pose) const;

    //! Copies whose middles are further apart than this do not meet.
    double diameter() const { return 2 * reach_; }
    std::size_t probes() const { return probes_.size(); }

private:
    friend class Crowd;

    //! Neighbouring boundary points with a circle round them.
    struct Chunk
    {
        Vec2 centre = Vec2::Zero();
        double radius = 0;
        std::size_t first = 0, last = 0;
    };

    Body(const Piece& piece, const Vec2& middle);

    //! Calls \p found(point, its depth in the owner) for every boundary point of the prober in the owner or its rim;
    //! both in the owner's frame.
    template <class Found>
    void each_contact(const Frame& owner, const Frame& prober, const Found& found) const;

    Vec2 middle_;
    Polygon outline_; //!< inflated, about the middle
    DepthField field_;
    Polygon probes_;
    std::vector<Chunk> chunks_;
    Polygon hull_; //!< about the middle
    double reach_ = 0;
    double gyration_ = 1; //!< radius of gyration: a turn by 1 radian counts as a move by this many mm
};

//! \brief Copies in a room that may still overlap; overlaps are taken away by moving and turning all of them at once.
//! \details Every boundary point of a copy that lies in another one gives a residual, its depth; so does every corner
//! that sticks out of the room. The sum of their squares, weighted by pair, falls by damped Gauss-Newton steps.
class Crowd
{
public:
    Crowd(const Body& body, const Room& room, std::vector<Pose> poses, bool may_turn);

    //! \brief At most \p steps steps downwards. \return are all copies apart now?
    bool relax(int steps);

    //! \brief Pairs that still overlap weigh more from now on.
    void blame();

    //! \brief The weighted squares of the depths between \p pose and all copies but \p except, and of its overhang.
    double pressure(const Pose& pose, std::size_t except, double limit = 1e300) const;

    double energy() const;

    const std::vector<Pose>& poses() const { return poses_; }
    void replace(std::size_t i, const Pose& pose);
    void add(const Pose& pose);

private:
    struct System;

    double assemble(System& system) const;
    void add_pair(std::size_t owner, std::size_t prober, System& system, Eigen::Matrix3d& block) const;
    bool may_meet(const Pose& a, const Pose& b) const;
    void move_all(const Eigen::VectorXd& move);
    void add_walls(std::size_t i, System& system) const;
    double& weight(std::size_t i, std::size_t j) { return weights_[i * poses_.size() + j]; }
    double weight(std::size_t i, std::size_t j) const { return weights_[i * poses_.size() + j]; }

    const Body& body_;
    Room room_;
    std::vector<Pose> poses_;
    std::vector<Frame> frames_;
    std::vector<double> weights_;
    bool may_turn_;
};

} // namespace rhombloom::nesting
