#include "exporters/bending_modes_settle.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/form/parallel.h"
#include "exporters/bent_element_relax.h"
#include "exporters/sheet_edges.h"

namespace rhombloom {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double core_anchor = 0.003;
constexpr double hook_anchor = 0.05;
constexpr double corner_anchor = 1e4;
constexpr double rim_stiffness = 20;

//! What all elements share. Points are the sheet's, then the four corners.
struct Model
{
    std::vector<SheetEdge> segments;
    double rim = 0; //!< length of the flat outline
    Vector anchors; //!< one per point
    Vector mean;
    Matrix modes;
    Matrix segment_modes; //!< 3 rows per segment: difference of its ends' modes
    Matrix anchored;      //!< modes^T anchors modes
};

Vector find_anchors(const FlatSheet& sheet, const Element& element, const HookParameters& hooks)
{
    Vector anchors = Vector::Constant(static_cast<int>(sheet.points.size()) + 4, core_anchor);
    for (const HookPoint& h : find_hooks(sheet, element, hooks).points) {
        anchors(h.point) = core_anchor + h.share * (hook_anchor - core_anchor);
    }
    anchors.tail<4>().setConstant(corner_anchor);
    return anchors;
}

//! Points and corners of an element in its pose.
Vector local_points(const BentElement& e, const BentPose& pose, const std::array<Vec2, 4>& flat)
{
    Vector local(3 * (e.points.size() + 4));
    int row = 0;
    const auto put = [&](const Vec3& p) {
        local.segment<3>(row) = pose.axes.transpose() * (p - pose.origin);
        row += 3;
    };
    for (const Vec3& p : e.points) {
        put(p);
    }
    for (const Vec2& p : flat) {
        put(bent_position(e.patch, p));
    }
    return local;
}

void finish(Model& model)
{
    const int count = static_cast<int>(model.modes.cols());
    model.segment_modes.resize(3 * model.segments.size(), count);
    for (std::size_t s = 0; s < model.segments.size(); ++s) {
        model.segment_modes.middleRows<3>(static_cast<int>(3 * s)) =
            model.modes.middleRows<3>(3 * model.segments[s].a) - model.modes.middleRows<3>(3 * model.segments[s].b);
    }
    Matrix weighted = model.modes;
    for (int i = 0; i < model.anchors.size(); ++i) {
        weighted.middleRows<3>(3 * i) *= model.anchors(i);
    }
    model.anchored = model.modes.transpose() * weighted;
}

//! The first of \p directions, without those along which no element differs by a micrometre.
Matrix needed(const Matrix& directions, const Matrix& data)
{
    const Matrix weights = directions.transpose() * data;
    Eigen::Index count = 0;
    while (count < weights.rows() && weights.row(count).cwiseAbs().maxCoeff() > 1e-3) {
        ++count;
    }
    return directions.leftCols(count);
}

//! Normal equations of one Gauss-Newton step in the weights and, last, translation and rotation in the own frame.
struct System
{
    Matrix matrix;
    Vector right;
};

void add_segments(const Model& model, const Vector& shape, System& system)
{
    const int count = static_cast<int>(model.modes.cols());
    Matrix rows(model.segments.size() + 1, count);
    Vector residual(model.segments.size() + 1);
    Eigen::RowVectorXd rim_row = Eigen::RowVectorXd::Zero(count);
    double rim = -model.rim;
    for (std::size_t s = 0; s < model.segments.size(); ++s) {
        const SheetEdge& segment = model.segments[s];
        const int row = static_cast<int>(s);
        const Vec3 d = shape.segment<3>(3 * segment.a) - shape.segment<3>(3 * segment.b);
        const double length = std::max(d.norm(), 1e-9);
        const double k = std::sqrt(segment.stiffness);
        rows.row(row).noalias() = d.transpose() * (1 / length) * model.segment_modes.middleRows<3>(3 * row);
        if (segment.rim) {
            rim_row += rows.row(row);
            rim += length;
        }
        rows.row(row) *= k;
        residual(row) = k * (length - segment.length);
    }
    rows.bottomRows<1>() = std::sqrt(rim_stiffness) * rim_row;
    residual(residual.size() - 1) = std::sqrt(rim_stiffness) * rim;
    system.matrix.topLeftCorner(count, count).noalias() += rows.transpose() * rows;
    system.right.head(count).noalias() -= rows.transpose() * residual;
}

//! How a point moves with translation and rotation.
Eigen::Matrix<double, 3, 6> rigid_rows(const Vec3& p)
{
    Eigen::Matrix<double, 3, 6> rows;
    rows << 1, 0, 0, 0, p.z(), -p.y(), 0, 1, 0, -p.z(), 0, p.x(), 0, 0, 1, p.y(), -p.x(), 0;
    return rows;
}

void add_anchors(const Model& model, const Vector& shape, const Vector& places, System& system)
{
    const int count = static_cast<int>(model.modes.cols());
    Matrix rigid(shape.size(), 6);
    Vector gap = shape - places;
    for (int i = 0; i < model.anchors.size(); ++i) {
        rigid.middleRows<3>(3 * i) = model.anchors(i) * rigid_rows(shape.segment<3>(3 * i));
        gap.segment<3>(3 * i) *= model.anchors(i);
    }
    system.matrix.topLeftCorner(count, count) += model.anchored;
    system.matrix.topRightCorner(count, 6).noalias() += model.modes.transpose() * rigid;
    system.matrix.bottomLeftCorner(6, count) = system.matrix.topRightCorner(count, 6).transpose();
    system.right.head(count).noalias() -= model.modes.transpose() * gap;
    for (int i = 0; i < model.anchors.size(); ++i) {
        const Eigen::Matrix<double, 3, 6> rows = rigid_rows(shape.segment<3>(3 * i));
        system.matrix.bottomRightCorner<6, 6>() += rows.transpose() * rigid.middleRows<3>(3 * i);
        system.right.tail<6>() -= rows.transpose() * gap.segment<3>(3 * i);
    }
}

//! Turn and move \p pose by a small motion given in its own frame.
void move(BentPose& pose, const Eigen::Matrix<double, 6, 1>& motion)
{
    const Vec3 turn = motion.tail<3>();
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
    pose.origin += pose.axes * motion.head<3>();
    pose.axes *= rotation;
}

//! Where the points belong, in the frame of \p pose.
Vector places_of(const Model& model, const BentElement& e, const BentPose& pose, const std::array<Vec2, 4>& flat)
{
    expects(model.mean.size() == static_cast<Eigen::Index>(3 * (e.points.size() + 4)), "settle: one sheet for all");
    return local_points(e, pose, flat);
}

void settle_element(const Model& model, const BentElement& e, const std::array<Vec2, 4>& flat, int iterations,
                    BentPose& pose)
{
    const int count = static_cast<int>(model.modes.cols());
    for (int iteration = 0; iteration < iterations; ++iteration) {
        const Vector shape = model.mean + model.modes * pose.weights;
        System system{Matrix::Zero(count + 6, count + 6), Vector::Zero(count + 6)};
        add_segments(model, shape, system);
        add_anchors(model, shape, places_of(model, e, pose, flat), system);
        system.matrix.diagonal().array() += 1e-9 * system.matrix.diagonal().maxCoeff();
        const Vector step = system.matrix.ldlt().solve(system.right);
        pose.weights += step.head(count);
        move(pose, step.tail<6>());
    }
}

//! The modes of the normals: what goes with the weights, by least squares over all elements.
Matrix normal_model(const BentSurface& bent, const std::vector<BentPose>& poses)
{
    const int count = static_cast<int>(poses.front().weights.size());
    const int elements = static_cast<int>(poses.size());
    Matrix normals(3 * bent.sheet.points.size(), elements);
    Matrix weights(count + 1, elements);
    for (int f = 0; f < elements; ++f) {
        weights.col(f) << 1, poses[f].weights;
        for (std::size_t i = 0; i < bent.sheet.points.size(); ++i) {
            normals.col(f).segment<3>(static_cast<int>(3 * i)) =
                poses[f].axes.transpose() * bent.elements[f].normals[i];
        }
    }
    Matrix square = weights * weights.transpose();
    square.diagonal().array() += 1e-6 * square.diagonal().maxCoeff();
    return square.ldlt().solve(weights * normals.transpose()).transpose();
}

//! \brief Round modes and the normals' modes so that what they do to a sheet's two faces is in whole numbers of 8 bits.
//! \details Elements settle in the rounded modes: files can hold them exactly. Modes that move points far stay as they
//! are, for rounding would shake the short segments of the hooks.
Vector put_on_grain(Model& model, Matrix& normals, const std::vector<BentPose>& poses, double thickness)
{
    constexpr double coarsest = 0.02; // mm, at the largest weight
    constexpr int most = 126;         // one less than 8 bits hold: two roundings may add up
    const double half = 0.5 * thickness;
    Vector grain(model.modes.cols());
    for (int k = 0; k < grain.size(); ++k) {
        auto mode = model.modes.col(k).head(normals.rows());
        auto turn = normals.col(k + 1);
        grain(k) = std::max((mode.cwiseAbs() + half * turn.cwiseAbs()).maxCoeff() / most, 1e-12);
        double largest = 0;
        for (const BentPose& pose : poses) {
            largest = std::max(largest, std::abs(pose.weights(k)));
        }
        if (grain(k) * largest > coarsest) {
            grain(k) = 0;
            continue;
        }
        mode = (mode / grain(k)).array().round() * grain(k);
        turn = (half * turn / grain(k)).array().round() * (grain(k) / half);
    }
    return grain;
}

//! Replace points and normals of every element by what the modes say.
void adopt(BentSurface& bent, const Model& model, const Matrix& normals, const BendingModes& modes,
           SettleReport& report)
{
    const std::array<Vec2, 4> flat = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    for (std::size_t f = 0; f < bent.elements.size(); ++f) {
        BentElement& e = bent.elements[f];
        const BentPose& pose = modes.poses[f];
        const Vector shape = model.mean + model.modes * pose.weights;
        const Vector turned = normals.col(0) + normals.rightCols(pose.weights.size()) * pose.weights;
        const auto at = [&](int i) -> Vec3 { return pose.origin + pose.axes * shape.segment<3>(3 * i); };
        const int count = static_cast<int>(e.points.size());
        for (int i = 0; i < count; ++i) {
            e.points[i] = at(i);
            e.normals[i] = pose.axes * turned.segment<3>(3 * i);
        }
        double rim = 0;
        for (std::size_t i = 0; i < bent.sheet.rim; ++i) {
            rim += (e.points[(i + 1) % bent.sheet.rim] - e.points[i]).norm();
        }
        report.max_rim_distortion = std::max(report.max_rim_distortion, std::abs(rim / model.rim - 1));
        for (int k = 0; k < 4; ++k) {
            const Vec3 vertex = bent_position(e.patch, e.patch.to_unit.inverse() * flat[k]);
            report.max_corner_error_mm = std::max(report.max_corner_error_mm, (at(count + k) - vertex).norm());
        }
    }
}

enum class Round
{
    Rough, //!< the shapes will be relaxed again
    Last   //!< modes in whole numbers, weights to the end
};

//! Modes of the elements as they are, and every element settled in them.
BendingModes settle_once(BentSurface& bent, const Element& element, const HookParameters& hooks, int count, Round round,
                         SettleReport& report)
{
    BendingModes modes = aligned_elements(bent);
    const std::array<Vec2, 4> flat = flat_corners(element);
    const int elements = static_cast<int>(bent.elements.size());
    Matrix data(3 * (bent.sheet.points.size() + 4), elements);
    for (int f = 0; f < elements; ++f) {
        data.col(f) = local_points(bent.elements[f], modes.poses[f], flat);
    }
    Model model{sheet_edges(bent.sheet, element),
                rim_length(bent.sheet),
                find_anchors(bent.sheet, element, hooks),
                data.rowwise().mean(),
                {},
                {},
                {}};
    data.colwise() -= model.mean;
    model.modes = needed(principal_directions(data, count), data);
    const auto settle_all = [&](int iterations) {
        finish(model);
        parallel_tasks(default_threads(), elements,
                       [&](int f) { settle_element(model, bent.elements[f], flat, iterations, modes.poses[f]); });
    };
    for (int f = 0; f < elements; ++f) {
        modes.poses[f].weights = model.modes.transpose() * data.col(f);
    }
    settle_all(3);
    Matrix normals = normal_model(bent, modes.poses);
    if (round == Round::Last) {
        modes.grain = put_on_grain(model, normals, modes.poses, element.thickness);
        settle_all(5);
    }
    adopt(bent, model, normals, modes, report);
    const Eigen::Index rows = 3 * static_cast<Eigen::Index>(bent.sheet.points.size());
    modes.mean = model.mean.head(rows);
    modes.modes = model.modes.topRows(rows);
    return modes;
}

//! Draw the lengths true again, with the points held part of the way back to where they came from.
void relax(BentSurface& bent, const BentSurface& original, const Element& element, const SheetRelaxation& relaxation)
{
    constexpr double back = 0.3; // measured: less lifts fingers off their neighbours, more leaves lengths untrue
    const std::array<Vec2, 4> flat = flat_corners(element);
    parallel_tasks(default_threads(), static_cast<int>(bent.elements.size()), [&](int f) {
        BentElement& e = bent.elements[f];
        const std::vector<Vec3>& from = original.elements[f].points;
        SheetRelaxation::Rows rows(e.points.size(), 3);
        for (std::size_t i = 0; i < from.size(); ++i) {
            rows.row(static_cast<int>(i)) = (1 - back) * e.points[i] + back * from[i];
        }
        std::array<Vec3, 4> corners;
        for (int k = 0; k < 4; ++k) {
            corners[k] = bent_position(e.patch, flat[k]);
        }
        rows = relaxation.relaxed(rows, corners);
        for (std::size_t i = 0; i < from.size(); ++i) {
            e.points[i] = rows.row(static_cast<int>(i));
        }
        e.normals = original.elements[f].normals;
    });
}

double largest_shift(const BentSurface& a, const BentSurface& b)
{
    double worst = 0;
    for (std::size_t f = 0; f < a.elements.size(); ++f) {
        for (std::size_t i = 0; i < a.elements[f].points.size(); ++i) {
            worst = std::max(worst, (a.elements[f].points[i] - b.elements[f].points[i]).norm());
        }
    }
    return worst;
}

} // namespace

BendingModes settle(BentSurface& bent, const Element& element, const HookParameters& hooks, int count,
                    SettleReport* report)
{
    constexpr int rounds = 4;
    const BentSurface original = bent;
    const SheetRelaxation relaxation(bent.sheet, element, hooks, find_hooks(bent.sheet, element, hooks));
    BendingModes modes;
    SettleReport measured;
    for (int round = 0; round < rounds; ++round) {
        if (round > 0) {
            relax(bent, original, element, relaxation);
        }
        measured = {};
        modes = settle_once(bent, element, hooks, count, round + 1 < rounds ? Round::Rough : Round::Last, measured);
    }
    const std::vector<SheetEdge> segments = sheet_edges(bent.sheet, element);
    measured.max_shift_mm = largest_shift(bent, original);
    measured.p99_before = p99_distortion(original, segments);
    measured.p99_after = p99_distortion(bent, segments);
    if (report != nullptr) {
        *report = measured;
    }
    return modes;
}

} // namespace rhombloom
