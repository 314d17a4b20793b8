#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exporters/bent_element.h"

namespace rhombloom {

enum class Background
{
    Studio,
    Transparent
};
enum class LampLook
{
    Off,
    On
};

//! \brief Where the picture is taken from, mm. Other renderers can take the same picture with it.
struct PictureCamera
{
    Vec3 eye = Vec3::Zero();
    Vec3 right = Vec3::UnitX();
    Vec3 up = Vec3::UnitZ();
    Vec3 back = Vec3::UnitY(); //!< from the surface to the eye
    double tangent = 0.2;      //!< of half the vertical field of view
};

struct PictureOptions
{
    int width = 768; //!< pixels, 16 to 8192
    int height = 768;
    Vec3 view = Vec3(0.75, -1, 0.55); //!< from the surface towards the viewer, z is up
    double field_of_view_deg = 24;    //!< vertical
    double margin = 0.06;             //!< free border, as a share of the picture
    Background background = Background::Studio;
    LampLook lamp = LampLook::Off;
    std::optional<PictureCamera> camera; //!< instead of the nearest one from which all can be seen
    std::optional<Eigen::Vector3f> tint; //!< of everything, linear light; not given: by side
};

//! \brief Pixels row by row from the top: red, green, blue and alpha (not premultiplied).
struct Picture
{
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

//! \brief The nearest eye on the line through the bounds' middle along options.view from which all points fit.
PictureCamera fitted_camera(const std::vector<Vec3>& points, const PictureOptions& options);

//! \brief A picture of bent elements: front and flipped elements in two tints, soft shadows, or lit from inside.
//! \details Anti-aliased (3 x 3 samples), the same bytes every time. An own z-buffer: two-dimensional drawing libraries
//! leave seams between triangles.
Expected<Picture> picture(const BentSurface& bent, const PictureOptions& options = {});

//! \brief The file's bytes.
Expected<std::string> png_of(const Picture& picture);

//! \brief The same as PNG.
Expected<std::string> picture_png(const BentSurface& bent, const PictureOptions& options = {});

//! \brief Bend the elements of \p surface and take their picture.
Expected<std::string> surface_picture_png(const Surface& surface, const Element& element,
                                          const PictureOptions& options = {});

} // namespace rhombloom
