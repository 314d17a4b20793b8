#pragma once

#include <optional>
#include <set>

#include "core/design/mesh_import/network_search.h"

namespace rhombloom {

//! \brief What all trials of one search have in common.
struct Trials
{
    const MeshTree& target;
    const Element& element;
    const SearchOptions& options;
    int max_iterations = 1500;       //!< of the embedding of one trial; what has not settled by then is no good
    int max_newton_iterations = 100; //!< of these
};

//! \brief What a network is judged by.
enum class Aim
{
    Near,    //!< little distance from the target
    Straight //!< corners where they were meant to be
};

//! \brief The two corners that an element of a join connects, the lower number first.
using Corners = std::pair<int, int>;

//! \brief What a network is made from.
struct Plan
{
    TriangleMesh triangles;    //!< corners on the target, or where they settled
    std::vector<Vec3> middles; //!< of the triangles
    std::set<Corners> flipped; //!< elements that are turned over
    double scale = 1;          //!< of the points, relative to elements of their own size
    std::vector<Vec3> meant{}; //!< where its corners were on the target; empty when that is not known any more
    std::vector<int> origin{}; //!< of a part of another plan: its corners' numbers there, -1 for new ones; or empty
};

//! \brief How good one element is, and where it is relative to the target as it was searched.
struct ElementRating
{
    Vec3 middle = Vec3::Zero();
    double stretch = 0;  //!< the largest of its sides and diagonals
    double distance = 0; //!< of the middle from the target, la; if judged for that
    double bend = 0;     //!< square of the difference of the turns of its two corners; if judged for straightness
};

//! \brief A plan, the network made of it, and how good that is.
struct Trial
{
    Plan plan; //!< points where they settled, on the target as it was searched
    FoundNetwork found;
    std::vector<ElementRating> ratings;
    double rms = 0;    //!< distance, both ways, la; if judged for that
    double astray = 0; //!< distance of the corners from where they were meant to be, rms, la; 0 when not known
    double excess = 0; //!< stretch beyond what a sheet gives, summed over the elements
    long cost = 0;     //!< iterations times elements
};

//! \brief Distance in la, and \p price times the excess of stretch; small is good.
double score(const Trial& trial, double price);

//! \brief The join of \p plan, its points as they are.
Expected<Surface> surface_of(const Plan& plan);

//! \brief Are the defects of all inner vertices permissible?
bool has_permissible_defects(const Surface& surface, const Element& element);

//! \brief Stretch of one element beyond what a sheet gives.
double excess_stretch(double stretch);

//! \brief Is every element stretched by a little less than a sheet gives, and none crosses another?
bool can_be_built(const Trial& trial);

//! \brief Most triangles at a corner that the element's permissible defects allow.
int max_degree(const Element& element);

//! \brief The same, within reason, for changes of a network.
int max_move_degree(const Element& element);

//! \brief Is the join of \p plan a surface with permissible defects?
bool is_permissible(const Plan& plan, const Trials& trials);

//! \brief Embed the join of \p plan and judge it. Empty when that is no surface, does not settle, or has impermissible
//! defects.
//! \details Of networks that are judged for straightness the distance is not asked, which would take half the time.
std::optional<Trial> settle(const Plan& plan, const Trials& trials, Aim aim = Aim::Near);

//! \brief Change the plan by flips, splits and elements turned over, as long as the score falls and less than \p work
//! iterations times elements are spent. Returns what is left.
//! \details It is changed where elements are overstretched, and where they are far from the target or bent against it:
//! one wrong element at its root turns a whole limb, which is far away at its end.
long polish(Trial& best, const Trials& trials, Aim aim, double price, long work);

} // namespace rhombloom
