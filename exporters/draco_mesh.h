#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/expected.h"

namespace rhombloom {

//! \brief What goes into a Draco stream, and what comes out of it again.
struct DracoMesh
{
    std::vector<Eigen::Vector3f> points;
    std::vector<Eigen::Vector3f> normals;
    std::vector<std::uint16_t> elements; //!< the element of each point; may be empty
    std::vector<std::uint16_t> order;    //!< any number per point that must survive the compression; may be empty
    std::vector<std::array<int, 3>> triangles;
};

struct DracoStream
{
    std::string bytes;
    int point_id = -1; //!< Draco's unique ids of the attributes; -1: absent
    int normal_id = -1;
    int element_id = -1;
    int order_id = -1;
};

//! \brief The lattice on which a stream keeps its points: `origin + step * (i, j, k)`, every number of \p bits bits.
struct PointGrid
{
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    double step = 1;
    int bits = 1;
};

//! \brief The coarsest lattice on which no point moves by more than \p tolerance (same unit).
PointGrid point_grid(const std::vector<Eigen::Vector3f>& points, double tolerance);

//! \brief The normals of \p mesh, turned to what a decoder expects from the triangles, which costs nothing, where that
//! is within \p within_deg of them.
//! \details The expectation is the sum of the adjacent triangles' area vectors: smooth where the mesh is.
std::vector<Eigen::Vector3f> expected_normals(const DracoMesh& mesh, const PointGrid& grid, int normal_bits,
                                              double within_deg);

//! \brief Compress with points on \p grid and \p normal_bits per normal.
Expected<DracoStream> compress(const DracoMesh& mesh, const PointGrid& grid, int normal_bits);

//! \brief Read back from the bytes: what a viewer will see, in its order.
Expected<DracoMesh> decompress(const DracoStream& stream);

//! \brief Where a decoder will put \p points.
std::vector<Eigen::Vector3f> on_grid(const std::vector<Eigen::Vector3f>& points, const PointGrid& grid);

} // namespace rhombloom
