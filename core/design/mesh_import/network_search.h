#pragma once

#include <functional>

#include "core/design/mesh_import/mesh_distance.h"
#include "core/form/embedding.h"

namespace rhombloom {

struct SearchOptions
{
    int elements = 600;
    bool rescale = true; //!< the target may be scaled to suit the elements; if not, thin parts take some more of them
    EmbedOptions embedding;
    //! Told what is being done; false stops. Empty: nobody listens.
    std::function<bool(const std::string&)> progress;
};

struct FoundNetwork
{
    Surface surface; //!< embedded, where the scaled target is
    EmbedReport embedding;
    Distance distance;       //!< mm
    double target_scale = 1; //!< about the origin
    TriangleMesh target;     //!< in even triangles, scaled
    double thickened = 0;    //!< share of the target's area that was too thin for elements, and was made thicker
    double filled = 0;       //!< share of the target's area that lay in gaps too narrow for elements; they were filled
    int elements = 0;        //!< that were looked for
};

//! \brief Edge length of the triangles whose edges carry elements, as it settles, mm.
double triangle_edge(const Element& element);

//! \brief Area of the target per element, when its triangles have edges of that length.
double area_per_element(double edge);

//! \brief The network of about that many elements that settles nearest to \p target (closed, mm).
//! \details Triangulations whose curvature fits better and better are embedded; the one that can be built and ends
//! nearest is kept. Refuses when none comes to rest.
Expected<FoundNetwork> search_network(const TriangleMesh& target, const Element& element, const SearchOptions& options);

} // namespace rhombloom
