#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "exporters/bent_element.h"

namespace rhombloom {

//! \brief A binary glTF 2.0 file in the making: the JSON document and one buffer.
//! \details An own writer, because the libraries print floats with 17 digits and cannot leave out what Draco replaces.
struct Glb
{
    nlohmann::ordered_json json;
    std::string buffer;
};

//! Component types of glTF accessors.
enum class Component : int
{
    Int8 = 5120,
    UInt8 = 5121,
    Int16 = 5122,
    UInt16 = 5123,
    UInt32 = 5125,
    Float = 5126
};

//! What a buffer view is bound to; None for data that no graphics card reads as it is.
enum class ViewTarget : int
{
    None = 0,
    Vertices = 34962,
    Indices = 34963
};

//! \brief An empty document with asset, one scene and a buffer.
Glb make_glb(const std::string& title);

//! \brief Append \p bytes as a buffer view, 4-byte aligned; returns its number. \p stride 0: tightly packed.
int add_view(Glb& glb, const std::string& bytes, ViewTarget target, int stride = 0);

//! \brief An accessor of \p count values; \p view -1 leaves the data out (Draco, or all zero). Returns its number.
int add_accessor(Glb& glb, int view, Component component, const std::string& type, std::size_t count);

//! \brief VEC3 floats with min and max, in their own view.
int add_points(Glb& glb, const std::vector<Eigen::Vector3f>& points);

//! \brief Unit VEC3 floats in their own view.
int add_normals(Glb& glb, const std::vector<Eigen::Vector3f>& normals);

//! \brief Triangle corners as the smallest integers that hold them.
int add_indices(Glb& glb, const std::vector<std::array<int, 3>>& triangles);

//! \brief Write min and max of \p points into accessor \p accessor.
void set_bounds(Glb& glb, int accessor, const std::vector<Eigen::Vector3f>& points);

//! \brief The file's bytes: header, JSON chunk, binary chunk.
std::string glb_bytes(const Glb& glb);

//! \brief The shortest decimal that reads back as the same float.
double short_float(float value);

//! \brief mm, z up -> m, y up.
Eigen::Vector3f to_gltf(const Vec3& mm);

//! \brief Directions: z up -> y up.
Eigen::Vector3f to_gltf_direction(const Vec3& direction);

//! \brief The two materials, front and flipped (and their emission when lit). Double-sided is not needed: elements are
//! closed.
void add_materials(Glb& glb, bool lit);

} // namespace rhombloom
