#include "core/form/spring_energy.h"

#include <algorithm>

namespace rhombloom {

double barrier_ratio(double la, double lb)
{
    return std::min(0.75, 0.9 * la / lb);
}

SpringResponse spring_response(const SpringLaw& law, double rest, double length)
{
    const double change = length - rest;
    const double weight = (change > 0 ? law.stretched_weight : law.compressed_weight) / rest;
    SpringResponse out{weight * change * change, 0, 2 * weight * change, 2 * weight};
    const double excess = length - law.barrier_ratio * rest;
    if (excess < 0) {
        const double barrier = law.barrier_weight / rest;
        out.barrier = barrier * excess * excess;
        out.force += 2 * barrier * excess;
        out.stiffness += 2 * barrier;
    }
    return out;
}

} // namespace rhombloom
