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
    DracoMesh decoded; //!< read back from the bytes: what a viewer will see, in its order
};

//! \brief Bits per coordinate so that no point of a mesh this wide moves by more than \p tolerance (same unit).
int quantisation_bits(double extent, double tolerance);

//! \brief Compress with \p point_bits per coordinate and \p normal_bits per normal, and decode again.
Expected<DracoStream> compress(const DracoMesh& mesh, int point_bits, int normal_bits);

//! \brief The largest side of the bounding box.
double extent(const std::vector<Eigen::Vector3f>& points);

} // namespace rhombloom
