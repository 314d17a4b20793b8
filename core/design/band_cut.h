#pragma once

#include <optional>

#include "core/design/interface.h"

namespace rhombloom {

//! \brief Elements of a band that are retained or discarded together, and how far that leaves the union of the inputs.
struct BandChange
{
    std::vector<Face> elements;
    double cost = 0; //!< sum of their depths, mm
};

//! \brief Cuts a surface again and again inside a band of elements, at the cost of the band alone.
//! \details The other elements are kept or not as the first mask says and never change; none of them may touch an
//! element of the other kind.
class BandCut
{
public:
    BandCut(const Surface& surface, const Element& element, const std::vector<Face>& band, std::vector<char> kept);

    const std::vector<char>& kept() const { return kept_; }

    //! Keep the elements that are not kept and the other way round.
    void toggle(const std::vector<Face>& elements);

    //! Would the elements kept at every vertex form one run (or all or none) after toggling these?
    bool runs_after_toggling(const std::vector<Face>& elements);

    //! Toggle groups of elements, each time the one with the least cost for its gain, until that is so or none helps.
    void repair(const std::vector<BandChange>& groups);

    //! \brief The cut, or nothing: see cut().
    //! \pre the elements kept at every vertex form one run.
    std::optional<Cut> cut() const;

private:
    struct Border
    {
        int from, to;    //!< numbers of fans
        int left, right; //!< elements
    };
    struct Fan
    {
        int vertex = 0;
        bool open = false;          //!< on an opening of the surface
        std::vector<int> elements;  //!< counter-clockwise; -1 for the opening
        std::vector<double> angles; //!< of their corners
    };

    int fan_number(Vertex v);
    bool is_broken(const Fan& fan) const;
    bool is_kept(int element) const { return element >= 0 && kept_[element] != 0; }
    void flip(const std::vector<Face>& elements);
    void measure(const Fan& fan, Interface& loop) const;
    int broken_round(Face f) const;

    const Surface& surface_;
    const Element& element_;
    std::vector<char> kept_;
    std::vector<Fan> fans_;
    std::vector<int> fan_of_;                 //!< per vertex; -1 outside the band
    std::vector<std::array<int, 4>> fans_of_; //!< per element of the surface; only those of the band are filled
    std::vector<Border> borders_;
    int broken_ = 0; //!< fans
};

} // namespace rhombloom
