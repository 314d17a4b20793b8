#include "exporters/thumbnail.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <png.h>

#include "core/form/parallel.h"
#include "exporters/thumbnail_raster.h"

namespace rhombloom {

namespace {

using Color = Eigen::Vector3f; // linear light

constexpr int supersampling = 3;

RasterScene scene_of(const BentSurface& bent)
{
    RasterScene scene;
    for (std::size_t f = 0; f < bent.elements.size(); ++f) {
        const BentElement& e = bent.elements[f];
        const int first = static_cast<int>(scene.points.size());
        scene.points.insert(scene.points.end(), e.points.begin(), e.points.end());
        scene.normals.insert(scene.normals.end(), e.normals.begin(), e.normals.end());
        for (const auto& t : bent.sheet.triangles) {
            scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
        scene.elements.insert(scene.elements.end(), bent.sheet.triangles.size(), static_cast<std::int32_t>(f));
    }
    return scene;
}

//! \name Light
//! \{

struct Lights
{
    Projection shadow_projection;
    Samples shadow;
    Vec3 key;    //!< towards the key light
    Vec3 fill;   //!< towards the fill light
    Vec3 centre; //!< where the bulb hangs
    double radius = 1;
};

Projection parallel_projection(const std::vector<Vec3>& points, const Vec3& direction, int size)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) {
        box.extend(p);
    }
    Projection projection;
    const double radius = 0.5 * box.diagonal().norm() + 1;
    projection.camera.back = direction.normalized();
    projection.camera.right = Vec3::UnitZ().cross(direction).normalized();
    projection.camera.up = projection.camera.back.cross(projection.camera.right);
    projection.camera.eye = box.center() + projection.camera.back * radius;
    projection.camera.tangent = 0;
    projection.extent = radius;
    projection.width = projection.height = size;
    return projection;
}

Lights make_lights(const RasterScene& scene, const PictureCamera& camera)
{
    Lights lights;
    lights.key = (camera.back * 0.75 + camera.up * 0.85 - camera.right * 0.7).normalized();
    lights.fill = (camera.back * 0.6 + camera.right * 0.9 + camera.up * 0.1).normalized();
    lights.shadow_projection = parallel_projection(scene.points, lights.key, 1024);
    lights.shadow = rasterise(scene, lights.shadow_projection, 0);
    lights.centre = lights.shadow_projection.camera.eye - lights.key * lights.shadow_projection.extent;
    lights.radius = lights.shadow_projection.extent;
    return lights;
}

//! How much of the key light reaches \p p, 0..1: the mean of 7 x 7 soft comparisons.
float key_light(const Lights& lights, const Vec3& p)
{
    const Vec3 s = lights.shadow_projection(p);
    const double slack = 0.012 * lights.radius;
    double lit = 0;
    int asked = 0;
    for (int dy = -3; dy <= 3; ++dy) {
        for (int dx = -3; dx <= 3; ++dx) {
            const int x = static_cast<int>(s.x()) + dx;
            const int y = static_cast<int>(s.y()) + dy;
            if (x >= 0 && y >= 0 && x < lights.shadow.width && y < lights.shadow.height) {
                const double behind = (s.z() - lights.shadow.depth[lights.shadow.at(x, y)]) / slack;
                lit += std::clamp(2 - behind, 0.0, 1.0);
                ++asked;
            }
        }
    }
    return asked == 0 ? 1.0F : static_cast<float>(lit) / static_cast<float>(asked);
}

//! Darkening in clefts: how many of 32 places round the sample lie clearly before it.
float openness(const Samples& s, int x, int y, double reach_px, double reach_mm)
{
    const float here = s.depth[s.at(x, y)];
    double hidden = 0;
    for (int k = 0; k < 32; ++k) {
        const double angle = 2.399963 * k;
        const double r = reach_px * std::sqrt((k + 0.5) / 32);
        const int sx = std::clamp(x + static_cast<int>(std::lround(r * std::cos(angle))), 0, s.width - 1);
        const int sy = std::clamp(y + static_cast<int>(std::lround(r * std::sin(angle))), 0, s.height - 1);
        const double before = std::min<double>(here - s.depth[s.at(sx, sy)], 2 * reach_mm) / reach_mm;
        hidden += std::clamp((before - 0.05) / 0.6, 0.0, 1.0);
    }
    return static_cast<float>(1 - hidden / 32);
}

//! The line of shadow that a sheet throws on one close behind it: how the hooks and rims are told apart.
float contact(const Samples& s, int x, int y, double reach_px)
{
    const std::size_t here = s.at(x, y);
    double shade = 0;
    for (int k = 0; k < 12; ++k) {
        const double angle = 2.399963 * k;
        const double r = reach_px * std::sqrt((k + 0.5) / 12);
        const int sx = std::clamp(x + static_cast<int>(std::lround(r * std::cos(angle))), 0, s.width - 1);
        const int sy = std::clamp(y + static_cast<int>(std::lround(r * std::sin(angle))), 0, s.height - 1);
        const std::size_t there = s.at(sx, sy);
        if (s.element[there] >= 0 && s.element[there] != s.element[here] && s.depth[there] < s.depth[here]) {
            shade += 1;
        }
    }
    return static_cast<float>(1 - 0.6 * std::min(1.0, shade / 6));
}

//! \}

struct Shading
{
    const PictureOptions& options;
    const Samples& samples;
    const Projection& projection;
    const Lights& lights;
    const BentSurface& bent;
    double reach_mm = 20; //!< of the darkening in clefts
};

const std::array<Color, 2> sheet_tints = {Color(0.90F, 0.84F, 0.72F), Color(0.86F, 0.40F, 0.17F)};

//! What varies slowly enough to be found once per pixel.
struct Surroundings
{
    float open = 1;
    float key = 1;
    float contact = 1;
};

Surroundings surroundings(const Shading& s, int x, int y)
{
    const double depth = s.samples.depth[s.samples.at(x, y)];
    const Vec3 p = s.projection.unproject(x + 0.5, y + 0.5, depth);
    const double px = s.reach_mm * 0.5 * s.projection.height / (s.projection.camera.tangent * depth);
    return {openness(s.samples, x, y, px, s.reach_mm), key_light(s.lights, p), contact(s.samples, x, y, 0.09 * px)};
}

//! Opaque-ish plastic under studio light; the inside is dim.
Color plastic(const Shading& s, const Vec3& p, const Vec3& n, const Color& tint, const Surroundings& around,
              bool inside)
{
    const Vec3 view = (s.projection.camera.eye - p).normalized();
    const float wrap = static_cast<float>(std::max(0.0, (n.dot(s.lights.key) + 0.25) / 1.25));
    const float open = around.open;
    const float key = wrap * around.key;
    const float fill = static_cast<float>(std::max(0.0, (n.dot(s.lights.fill) + 0.4) / 1.4));
    const float sky = static_cast<float>(0.5 + 0.5 * n.z());
    const Vec3 half = (view + s.lights.key).normalized();
    const float gloss = static_cast<float>(std::pow(std::max(0.0, n.dot(half)), 60)) * key;
    const float edge = static_cast<float>(std::pow(1 - std::max(0.0, n.dot(view)), 4));
    const Color ambient =
        (0.25F + 0.75F * open) * (sky * Color(0.36F, 0.40F, 0.46F) + (1 - sky) * Color(0.24F, 0.20F, 0.17F));
    const Color light = ambient + key * Color(0.78F, 0.74F, 0.66F) + open * fill * Color(0.16F, 0.17F, 0.20F);
    const Color body = tint.cwiseProduct(light) * (inside ? 0.55F : 1.0F);
    return around.contact * (body + Color::Constant(0.20F * gloss + 0.10F * edge * open));
}

//! Lit by a bulb in the middle: one sheet glows, two together less, the inside is bright.
Color glowing(const Shading& s, const Vec3& p, const Vec3& n, const Color& tint, const Surroundings& around,
              bool inside, int sheets)
{
    const Vec3 to_bulb = s.lights.centre - p;
    const double distance = to_bulb.norm();
    const float facing = static_cast<float>(std::abs(n.dot(to_bulb)) / std::max(distance, 1e-9));
    const auto falloff =
        static_cast<float>(std::pow(0.7 * s.lights.radius / std::max(distance, 0.3 * s.lights.radius), 1.2));
    const float through = inside ? 1.15F : (sheets > 1 ? 0.42F : 0.72F);
    const Color warm = tint.cwiseProduct(Color(1.0F, 0.64F, 0.28F));
    const Color surface = plastic(s, p, n, tint, around, inside);
    return 0.16F * surface + warm * (through * falloff * (0.25F + 0.85F * facing * facing)) *
                                 (0.6F + 0.4F * around.open) * (0.5F + 0.5F * around.contact);
}

Color sample_color(const Shading& s, int x, int y, const Surroundings& around)
{
    const std::size_t i = s.samples.at(x, y);
    const double depth = s.samples.depth[i];
    const Vec3 p = s.projection.unproject(x + 0.5, y + 0.5, depth);
    Vec3 n = s.samples.normal[i].cast<double>();
    const bool inside = n.dot(s.projection.camera.eye - p) < 0;
    if (inside) {
        n = -n;
    }
    const Color& by_side = sheet_tints[s.bent.elements[s.samples.element[i]].outward == Outward::Back ? 1 : 0];
    const Color tint = s.options.tint.value_or(by_side);
    return s.options.lamp == LampLook::On ? glowing(s, p, n, tint, around, inside, s.samples.sheets[i])
                                          : plastic(s, p, n, tint, around, inside);
}

//! A soft spot of light on a wall.
Color backdrop(const PictureOptions& options, double x, double y)
{
    const double dx = x / options.width - 0.5;
    const double dy = y / options.height - 0.46;
    const auto spot = static_cast<float>(std::exp(-4.0 * (dx * dx + dy * dy)));
    return options.lamp == LampLook::On ? Color(Color(0.006F, 0.007F, 0.012F) + spot * Color(0.050F, 0.034F, 0.020F))
                                        : Color(Color(0.40F, 0.42F, 0.45F) + spot * Color(0.40F, 0.39F, 0.38F));
}

std::uint8_t encoded(float linear)
{
    const float soft = linear < 0.7F ? linear : 0.7F + 0.3F * (1 - std::exp(-(linear - 0.7F) / 0.3F));
    const double v = std::clamp(static_cast<double>(soft), 0.0, 1.0);
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * s));
}

//! One pixel from its samples: red, green, blue, alpha (not premultiplied).
std::array<std::uint8_t, 4> pixel(const Shading& shading, int px, int py)
{
    Color sum = Color::Zero();
    Surroundings around;
    int covered = 0;
    for (int dy = 0; dy < supersampling; ++dy) {
        for (int dx = 0; dx < supersampling; ++dx) {
            const int x = px * supersampling + dx;
            const int y = py * supersampling + dy;
            if (std::isfinite(shading.samples.depth[shading.samples.at(x, y)])) {
                around = covered == 0 ? surroundings(shading, x, y) : around;
                sum += sample_color(shading, x, y, around);
                ++covered;
            }
        }
    }
    constexpr int all = supersampling * supersampling;
    if (shading.options.background == Background::Studio) {
        const Color mixed =
            (sum + static_cast<float>(all - covered) * backdrop(shading.options, px + 0.5, py + 0.5)) / all;
        return {encoded(mixed.x()), encoded(mixed.y()), encoded(mixed.z()), 255};
    }
    const Color mean = covered > 0 ? Color(sum / static_cast<float>(covered)) : Color(Color::Zero());
    const auto alpha = static_cast<std::uint8_t>((255 * covered + all / 2) / all);
    return {encoded(mean.x()), encoded(mean.y()), encoded(mean.z()), alpha};
}

} // namespace

Expected<std::string> png_of(const Picture& picture)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgba.data(), 0, nullptr) == 0) {
        return machine_failure(std::string("the picture could not be written as PNG: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

PictureCamera fitted_camera(const std::vector<Vec3>& points, const PictureOptions& options)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) {
        box.extend(p);
    }
    PictureCamera camera;
    camera.back = options.view.normalized();
    const Vec3 pole = std::abs(camera.back.z()) > 0.999 ? Vec3::UnitY() : Vec3::UnitZ();
    camera.right = pole.cross(camera.back).normalized();
    camera.up = camera.back.cross(camera.right);
    camera.tangent = std::tan(radians(options.field_of_view_deg) / 2);
    const double high = camera.tangent * (1 - 2 * options.margin);
    const double wide = high * options.width / options.height;
    double distance = 1;
    for (const Vec3& p : points) {
        const Vec3 r = p - box.center();
        const double needed = std::max(std::abs(r.dot(camera.right)) / wide, std::abs(r.dot(camera.up)) / high);
        distance = std::max(distance, needed + r.dot(camera.back));
    }
    camera.eye = box.center() + camera.back * distance;
    return camera;
}

Expected<Picture> picture(const BentSurface& bent, const PictureOptions& options)
{
    if (std::min(options.width, options.height) < 16 || std::max(options.width, options.height) > 8192) {
        return refuse("the picture is " + std::to_string(options.width) + " x " + std::to_string(options.height) +
                      " pixels: expected 16 to 8192 each way");
    }
    const RasterScene scene = scene_of(bent);
    Projection projection;
    projection.camera = options.camera.value_or(fitted_camera(scene.points, options));
    projection.width = options.width * supersampling;
    projection.height = options.height * supersampling;
    const Samples samples = rasterise(scene, projection, 9);
    const Lights lights = make_lights(scene, projection.camera);
    const Shading shading{options, samples, projection, lights, bent};
    Picture result{options.width, options.height, {}};
    result.rgba.resize(static_cast<std::size_t>(options.width) * options.height * 4);
    parallel_tasks(default_threads(), options.height, [&](int y) {
        for (int x = 0; x < options.width; ++x) {
            const auto p = pixel(shading, x, y);
            std::copy(p.begin(), p.end(),
                      result.rgba.begin() + static_cast<std::ptrdiff_t>((y * options.width + x) * 4));
        }
    });
    return result;
}

Expected<std::string> picture_png(const BentSurface& bent, const PictureOptions& options)
{
    const Expected<Picture> made = picture(bent, options);
    return made ? png_of(*made) : Expected<std::string>(tl::make_unexpected(made.error()));
}

Expected<std::string> surface_picture_png(const Surface& surface, const Element& element, const PictureOptions& options)
{
    const Expected<BentSurface> bent = bent_surface(surface, element);
    if (!bent) {
        return tl::make_unexpected(bent.error());
    }
    return picture_png(*bent, options);
}

} // namespace rhombloom
