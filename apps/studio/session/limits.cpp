#include "apps/studio/session/limits.h"

#include "core/model/base_shapes.h"
#include "core/text.h"

namespace rhombloom::studio {

namespace {

constexpr std::size_t most_elements = 3000;
constexpr double most_sides = 100;

Expected<void> check_shape(const std::string& name, const Element& element)
{
    const auto shape = base_shape(name, element);
    if (shape && shape->surface.n_faces() > most_elements) {
        return refuse(name + " has " + std::to_string(shape->surface.n_faces()) +
                      " elements: the studio takes shapes of up to " + std::to_string(most_elements));
    }
    return {}; // an unknown name is refused when the operation is carried out
}

} // namespace

Expected<void> check_size(const Operation& operation, const Element& element)
{
    if (const auto* place = std::get_if<Place>(&operation)) {
        return check_shape(place->shape, element);
    }
    if (const auto* extrude = std::get_if<Extrude>(&operation)) {
        if (extrude->by.norm() > most_sides * element.la) {
            return refuse("the pull is " + to_fixed(extrude->by.norm(), 0) + " mm long: the studio takes up to " +
                          to_fixed(most_sides * element.la, 0) + " mm at once");
        }
        return check_shape(extrude->brush, element);
    }
    return {};
}

} // namespace rhombloom::studio
