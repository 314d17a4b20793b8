#include "exporters/preview_steps.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "core/building/build_history.h"

namespace rhombloom {

namespace {

std::vector<std::array<int, 4>> find_neighbours(const Surface& surface)
{
    std::vector<std::array<int, 4>> neighbours;
    for (const Face f : surface.faces()) {
        std::array<int, 4> around{};
        for (int k = 0; k < 4; ++k) {
            const Halfedge other = surface.opposite_halfedge_handle(side_halfedge(surface, f, k));
            around[k] = surface.is_boundary(other) ? -1 : surface.face_handle(other).idx();
        }
        neighbours.push_back(around);
    }
    return neighbours;
}

//! An element that a stage and the finished model share.
struct Shared
{
    Face there;
    Face here;
};

Vec3 middle(const Surface& surface, Face f)
{
    Vec3 sum = Vec3::Zero();
    for (const int v : quad(surface, f)) {
        sum += 0.25 * surface.point(Vertex(v));
    }
    return sum;
}

std::vector<Shared> shared_elements(const Replay& replay, const AssemblyPlan& plan, int stage)
{
    const std::vector<int> faces = faces_of_elements(replay, plan, stage);
    std::vector<Shared> shared;
    for (std::size_t e = 0; e < replay.surface.n_faces(); ++e) {
        if (faces[e] >= 0) {
            shared.push_back({Face(faces[e]), Face(static_cast<int>(e))});
        }
    }
    return shared;
}

//! The motion that carries the corners of the nearest shared elements from the stage to the finished model.
Eigen::Isometry3d motion_near(const Surface& stage, const Surface& last, Face f, std::vector<Shared> shared)
{
    constexpr std::size_t most = 8;
    const Vec3 centre = middle(stage, f);
    std::stable_sort(shared.begin(), shared.end(), [&](const Shared& a, const Shared& b) {
        return (middle(stage, a.there) - centre).norm() < (middle(stage, b.there) - centre).norm();
    });
    shared.resize(std::min(shared.size(), most));
    if (shared.empty()) {
        return Eigen::Isometry3d::Identity();
    }
    Eigen::Matrix3Xd from(3, 4 * shared.size());
    Eigen::Matrix3Xd to(3, 4 * shared.size());
    for (std::size_t i = 0; i < shared.size(); ++i) {
        // The piece's own corners: the two surfaces may start the face at different vertices.
        const std::array<int, 4> there = piece_corners(stage, shared[i].there);
        const std::array<int, 4> here = piece_corners(last, shared[i].here);
        for (int k = 0; k < 4; ++k) {
            from.col(static_cast<int>(4 * i) + k) = stage.point(Vertex(there[k]));
            to.col(static_cast<int>(4 * i) + k) = last.point(Vertex(here[k]));
        }
    }
    return Eigen::Isometry3d(Eigen::umeyama(from, to, false));
}

void move(BentElement& e, const Eigen::Isometry3d& motion)
{
    for (Vec3& p : e.points) {
        p = motion * p;
    }
    for (Vec3& n : e.normals) {
        n = motion.linear() * n;
    }
    for (int i = 0; i < BentPatch::controls; ++i) {
        e.patch.control.col(i) = motion * Vec3(e.patch.control.col(i));
    }
}

} // namespace

Expected<PreviewSteps> preview_steps(const Replay& replay, const AssemblyPlan& plan, const Element& element,
                                     const HookParameters& hooks)
{
    PreviewSteps result;
    result.steps = plan.steps;
    result.neighbours = find_neighbours(replay.surface);
    std::map<int, std::vector<int>> faces_of_stage;
    for (const TemporaryElement& t : plan.temporary) {
        faces_of_stage[t.stage].push_back(t.face);
    }
    std::map<int, BentSurface> bent;
    std::map<int, std::vector<Shared>> shared;
    for (const auto& [stage, faces] : faces_of_stage) {
        Expected<BentSurface> made = bent_faces(stage_surface(replay, stage), element, hooks, faces);
        if (!made) {
            return tl::make_unexpected(made.error());
        }
        bent.emplace(stage, std::move(*made));
        shared.emplace(stage, shared_elements(replay, plan, stage));
    }
    for (const TemporaryElement& t : plan.temporary) {
        BentElement e = bent.at(t.stage).elements.at(t.face);
        move(e, motion_near(stage_surface(replay, t.stage), replay.surface, Face(t.face), shared.at(t.stage)));
        result.temporary.push_back(std::move(e));
    }
    return result;
}

} // namespace rhombloom
