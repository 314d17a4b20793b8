#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief A closed edge loop that divides a surface, as seen from the elements that are kept (Sec. 4.1).
//! \details The kept elements lie to the left of the loop. All lists run along it, entry i belongs to loop vertex i.
struct Interface
{
    std::vector<int> vertices;  //!< numbers in the surface; a copy of an opened apex is n_vertices + k
    std::vector<Vec3> points;   //!< mm
    std::vector<double> angles; //!< sum of the kept corner angles, radians
    std::vector<int> elements;  //!< number of kept corners

    //! Pairs of loop vertices that were made one (the second is gone) to shorten the loop.
    std::vector<std::pair<int, int>> zipped;
    //! Smallest defect of the valleys closed by that; none: +infinity.
    double zipped_defect = 1e300;

    int size() const { return static_cast<int>(vertices.size()); }
};

//! \brief A surface with some elements taken away: the loops that are open now, and what was done to open them.
struct Cut
{
    std::vector<Interface> loops;
    std::vector<int> removed; //!< elements
    //! Opened apex only: the corners of its ring's elements, each of which gets a copy of the apex of its own.
    std::vector<std::pair<int, Quad>> rewritten;
    std::vector<Vec3> copies; //!< positions of those copies, numbered from n_vertices
};

//! \brief A mountain has fewer kept elements than both neighbours on the loop; a valley has more.
bool is_mountain(const Interface& loop, int i);
bool is_valley(const Interface& loop, int i);

//! \brief Cut \p surface between the kept and the other elements (\p kept has one entry per element).
//! \details Refuses, by name: nothing kept, nothing removed, a loop that touches itself or another loop, a loop that
//! runs into an opening of the surface.
Expected<Cut> cut(const Surface& surface, const Element& element, const std::vector<char>& kept);

//! \brief Split \p apex along its incident edges without taking any element away (Sec. 4.3): the free corners of its
//! ring become the mountains of a sawtooth loop of twice its valence.
//! \details Refuses an apex on the boundary and a ring that touches itself.
Expected<Cut> opened_apex(const Surface& surface, const Element& element, Vertex apex);

//! \brief The existing openings of \p surface as loops; nothing is removed.
Cut openings(const Surface& surface, const Element& element);

//! \brief The ways to shorten \p loop to \p size vertices (Sec. 4.1): two mountains are made one, which closes the
//! valley between them, the valley with the largest resulting defect first. At most \p count variants, none when no
//! triple keeps the permissible defects.
std::vector<Interface> shortened(const Interface& loop, int size, const DefectRange& limits, int count);

} // namespace rhombloom
