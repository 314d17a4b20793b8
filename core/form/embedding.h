#pragma once

#include <functional>

#include "core/model/surface.h"

namespace rhombloom {

struct EmbedProgress
{
    int iteration = 0;
    double energy = 0;        //!< mm
    double gradient_norm = 0; //!< largest absolute component, dimensionless
};

//! \brief Where the positions that embed() is given come from.
enum class Start
{
    Unknown, //!< anywhere: sharp concavities are taken for dimples and folds, and repaired
    Edited   //!< an equilibrium that was changed here and there: its creases are meant, nothing is repaired
};

struct EmbedOptions
{
    double concavity_weight = 1; //!< times la: the shape does not depend on the unit (DESIGN.md section 3)
    double convex_weight = 0;    //!< cost of convex hinges relative to concave ones; 0 is the paper's energy
    double tolerance = 1e-9;     //!< largest absolute gradient component accepted as an equilibrium
    int max_iterations = 10000;  //!< most of them cheap
    //! Of these, by Newton's method at the end of one descent; each costs as much as dozens of others.
    int max_newton_iterations = 10000;
    double time_budget_s = 0; //!< 0: none. A small budget is the coarse mode for dragging
    Start start = Start::Unknown;
    bool keep_guards = false; //!< look for no equilibrium without the guards where they bear load: quicker
    int threads = 0;          //!< 0: the machine's, one for small surfaces. The result does not depend on it
    //! Called once per iteration; return false to stop. Empty: never called.
    std::function<bool(const EmbedProgress&)> progress;
};

struct EmbedReport
{
    bool converged = false;
    int iterations = 0;
    double energy = 0;           //!< spring + concavity, mm
    double spring_energy = 0;    //!< mm
    double concavity_energy = 0; //!< mm, with the convex hinges' share
    double concavity_weight = 1;
    double convex_weight = 0;
    //! Energy of the barrier against collapse and of the ridge at folded hinges (not in \c energy), mm. 0, except on a
    //! shape that has no equilibrium without them.
    double guard_energy = 0;
    double gradient_norm = 0; //!< largest absolute component of the gradient of energy + guard_energy
    double max_stretch = 0;   //!< largest (l - L) / L over all springs; negative when all are compressed
    std::string message;      //!< why it did not converge; empty when it did
};

//! \brief Move the vertices of \p surface to the shape its elements settle in (Sec. 3.2).
//! \details Starts at the current positions and leaves the best iterate behind, converged or not.
EmbedReport embed(Surface& surface, const Element& element, const EmbedOptions& options = {});

//! \brief The report for the positions as they are, without moving anything.
EmbedReport measure(const Surface& surface, const Element& element, const EmbedOptions& options = {});

} // namespace rhombloom
