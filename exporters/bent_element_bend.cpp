#include "exporters/bent_element_bend.h"

#include <deque>

#include "exporters/bent_element_energy.h"

namespace rhombloom {

namespace {

using Vector = SheetMechanics::Vector;
using Matrix = SheetMechanics::Matrix;

struct Correction
{
    Vector step;
    Vector change;
    double curvature; //!< 1 / step.change
};

//! The L-BFGS direction on top of the factored model.
Vector direction(const SheetMechanics& m, const std::deque<Correction>& memory, Vector q)
{
    std::vector<double> shares(memory.size());
    for (std::size_t k = memory.size(); k-- > 0;) {
        shares[k] = memory[k].curvature * memory[k].step.dot(q);
        q -= shares[k] * memory[k].change;
    }
    Vector r = m.model.solve(q);
    for (std::size_t k = 0; k < memory.size(); ++k) {
        r += memory[k].step * (shares[k] - memory[k].curvature * memory[k].change.dot(r));
    }
    return -r;
}

void remember(std::deque<Correction>& memory, const Vector& step, const Vector& change)
{
    constexpr std::size_t most = 8;
    const double curvature = change.dot(step);
    if (curvature > 0) {
        memory.push_back({step, change, 1 / curvature});
    }
    if (memory.size() > most) {
        memory.pop_front();
    }
}

//! \p patch with its offsets from the bilinear patch of its corners carried over to \p corners.
BentPatch carried_over(const BentPatch& patch, const std::array<Vec3, 4>& corners)
{
    std::array<Vec3, 4> shift;
    for (int k = 0; k < 4; ++k) {
        shift[k] = corners[k] - patch.control.col(BentPatch::corners[k]);
    }
    BentPatch moved = patch;
    for (int i = 0; i < BentPatch::controls; ++i) {
        const double u = static_cast<double>(i / (BentPatch::degree_across + 1)) / BentPatch::degree_along;
        const double v = static_cast<double>(i % (BentPatch::degree_across + 1)) / BentPatch::degree_across;
        moved.control.col(i) += bilinear(shift, u, v);
    }
    return moved;
}

} // namespace

BentPatch bend_by_newton(const SheetMechanics& m, BentPatch patch, const std::array<Vec3, 4>& corners)
{
    const SeatPlaces places = seat_places(m, corners);
    Vector gradient;
    double value = sheet_energy(m, patch, places, gradient);
    double damping = 1e-3;
    for (int iteration = 0; iteration < 200 && damping < 1e8; ++iteration) {
        Matrix h = model_matrix(m, patch, Stress::Counted);
        h.diagonal() *= 1 + damping;
        Eigen::LLT<Matrix> factor(h);
        if (factor.info() != Eigen::Success) {
            h = model_matrix(m, patch, Stress::Ignored);
            h.diagonal() *= 1 + damping;
            factor.compute(h);
        }
        const BentPatch next = stepped(patch, factor.solve(-gradient));
        Vector next_gradient;
        const double better = sheet_energy(m, next, places, next_gradient);
        if (!(better < value)) {
            damping *= 8;
            continue;
        }
        const bool done = value - better < 1e-7 * value;
        patch = next;
        value = better;
        gradient = next_gradient;
        damping /= 8;
        if (done) {
            break;
        }
    }
    return patch;
}

BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, const BentPatch& start,
               const BendOptions& options)
{
    const SeatPlaces places = seat_places(mechanics, corners);
    BentPatch patch = carried_over(start, corners);
    Vector gradient;
    double value = sheet_energy(mechanics, patch, places, gradient);
    std::deque<Correction> memory;
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
        Vector step = direction(mechanics, memory, gradient);
        const double slope = step.dot(gradient);
        Vector next_gradient;
        BentPatch next = stepped(patch, step);
        double better = sheet_energy(mechanics, next, places, next_gradient);
        for (int half = 0; !(better <= value + 1e-4 * slope) && half < 8; ++half) {
            step *= 0.4;
            next = stepped(patch, step);
            better = sheet_energy(mechanics, next, places, next_gradient);
        }
        if (!(better < value)) {
            break;
        }
        remember(memory, step, next_gradient - gradient);
        const bool done = value - better < options.stop * value;
        patch = next;
        value = better;
        gradient = next_gradient;
        if (done) {
            break;
        }
    }
    return patch;
}

} // namespace rhombloom
