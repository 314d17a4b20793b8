#pragma once

#include <vector>

#include "exporters/nesting_no_fit.h"

namespace rhombloom::nesting {

//! Which way round a no-fit region is read: of the upper row's copy over the lower one's, or the other way.
enum class Sense
{
    Forward,
    Reversed
};

//! \brief How high a copy must stand over an endless row of copies: the upper envelope of a no-fit region repeated
//! with a pitch along x.
class Skyline
{
public:
    //! \param region  turned by \p t first, so that the row runs along x; Reversed takes -region
    Skyline(const NoFit& region, const Turn& t, Sense sense, double pitch);

    //! \brief The least height at which a copy shifted by \p x clears the row and everything below it.
    double at(double x) const;

    double pitch() const { return pitch_; }

    //! \brief Shifts in [0, pitch) at which the height has a local minimum.
    std::vector<double> valleys() const;

private:
    //! Part of a contour that may be seen from above, moved into the first period.
    struct Slope
    {
        double x0, y0, x1, y1;
        double at(double x) const { return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : std::max(y0, y1); }
    };

    void add(const Vec2& a, const Vec2& b);
    void drop_hidden();
    double bucket_start(std::size_t k) const;
    double refined_valley(double x, double reach) const;

    double pitch_;
    std::vector<std::vector<Slope>> buckets_;
};

} // namespace rhombloom::nesting
