#include "apps/studio/server/geometry.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "core/model/angular_defect.h"
#include "core/model/element_stretch.h"
#include "exporters/bent_element.h"

namespace rhombloom::studio {

namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little endian numbers");

struct Arrays
{
    std::vector<float> positions;
    std::vector<float> defects;
    std::vector<float> strains;
    std::vector<int> quads;
    std::vector<int> first;
    std::vector<int> facing;
    std::vector<int> component;
    std::vector<int> part;
    std::vector<int> opening;
    std::vector<std::string> components;
};

void add_vertices(const Surface& surface, const Element& element, Arrays& arrays)
{
    for (const Vertex v : surface.vertices()) {
        const bool opening = surface.is_boundary(v);
        for (const double x : surface.point(v)) {
            arrays.positions.push_back(static_cast<float>(x));
        }
        arrays.defects.push_back(opening ? std::numeric_limits<float>::quiet_NaN()
                                         : static_cast<float>(degrees(angular_defect(surface, element, v))));
        arrays.opening.push_back(opening ? 1 : 0);
    }
}

void add_elements(const Surface& surface, const Element& element, int part, int first_vertex, Arrays& arrays)
{
    const int first_component = static_cast<int>(arrays.components.size());
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const int corner = piece_corners(surface, f)[0];
        for (int k = 0; k < 4; ++k) {
            arrays.quads.push_back(first_vertex + q[k]);
            if (q[k] == corner) {
                arrays.first.push_back(k);
            }
        }
        arrays.strains.push_back(static_cast<float>(element_stretch(surface, element, f)));
        arrays.facing.push_back(surface.data(f).facing == Facing::Back ? 1 : 0);
        arrays.component.push_back(first_component + surface.data(f).component);
        arrays.part.push_back(part);
    }
    arrays.components.insert(arrays.components.end(), surface.components.begin(), surface.components.end());
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values)
{
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

} // namespace

std::string geometry_bytes(const std::vector<const Surface*>& parts, const Element& element,
                           nlohmann::ordered_json header)
{
    Arrays arrays;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const int first_vertex = static_cast<int>(arrays.defects.size());
        add_vertices(*parts[k], element, arrays);
        add_elements(*parts[k], element, static_cast<int>(k), first_vertex, arrays);
    }
    header["vertices"] = arrays.defects.size();
    header["elements"] = arrays.strains.size();
    header["components"] = arrays.components;
    std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = static_cast<std::uint32_t>(text.size());
    std::string bytes(sizeof size, '\0');
    std::memcpy(bytes.data(), &size, sizeof size);
    bytes += text;
    append(bytes, arrays.positions);
    append(bytes, arrays.defects);
    append(bytes, arrays.strains);
    append(bytes, arrays.quads);
    append(bytes, arrays.first);
    append(bytes, arrays.facing);
    append(bytes, arrays.component);
    append(bytes, arrays.part);
    append(bytes, arrays.opening);
    return bytes;
}

} // namespace rhombloom::studio
