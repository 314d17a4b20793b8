#include "core/model/base_shapes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include "core/model/shape_generators.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr int max_elements = 20000;

struct Request
{
    std::string name;
    int first = 0;
    int second = 0; // 0 when the name has one number only
};

tl::unexpected<Error> impossible(const Request& request, const std::string& what)
{
    return refuse("shape \"" + request.name + "\" cannot be built: " + what);
}

//! (a, b) with a^2 + ab + b^2 = T, the one with the smallest b; a = 0 when there is none.
std::pair<int, int> geodesic_type(int T)
{
    for (int b = 0; b * b <= T; ++b) {
        for (int a = std::max(1, b); a * a <= T; ++a) {
            if (a * a + a * b + b * b == T) {
                return {a, b};
            }
        }
    }
    return {0, 0};
}

Expected<SurfaceLists> ball(const Request& request)
{
    const std::pair<Deltahedron, int> bases[] = {
        {Deltahedron::Icosahedron, 30}, {Deltahedron::Octahedron, 12}, {Deltahedron::Tetrahedron, 6}};
    for (const auto& [base, edges] : bases) {
        if (request.first % edges == 0) {
            if (const auto [a, b] = geodesic_type(request.first / edges); a > 0) {
                return join(geodesic(base, a, b));
            }
        }
    }
    return impossible(request, "a ball has 30 T, 12 T or 6 T elements with T = 1, 3, 4, 7, 9, 12, 13, 16, ... (30, 90, "
                               "120, 210, 270 are the round ones)");
}

Expected<SurfaceLists> rhombic(const Request& request, const Element& element)
{
    switch (request.first) {
    case 6:
        return polar_stack(3, 2, element);
    case 12:
        return join(geodesic(Deltahedron::Octahedron, 1, 0));
    case 20:
        return polar_stack(5, 4, element);
    case 30:
        return join(geodesic(Deltahedron::Icosahedron, 1, 0));
    default:
        return impossible(request, "the rhombic solids have 6, 12, 20 or 30 elements");
    }
}

Expected<SurfaceLists> checker(const Request& request, const Element& element)
{
    for (const int base : {30, 20, 12, 6}) {
        const int k = static_cast<int>(std::lround(std::sqrt(request.first / static_cast<double>(base))));
        if (k >= 2 && base * k * k == request.first) {
            return subdivide(*rhombic({request.name, base, 0}, element), k);
        }
    }
    return impossible(request, "a checkered solid has 30, 20, 12 or 6 times k x k elements, k = 2, 3, ... (24, 48, 54, "
                               "108, 120, 270, 480)");
}

Expected<SurfaceLists> polar(const Request& request, const Element& element)
{
    if (request.first < 3 || request.first > 8 || request.second < 2) {
        return impossible(request, "a polar stack has 3 to 8 elements round its poles and at least 2 rows");
    }
    return polar_stack(request.first, request.second, element);
}

Expected<SurfaceLists> open_dome(const Request& request, const Element& element)
{
    if (request.first < 3 || request.first > 8 || request.second < 1) {
        return impossible(request, "a dome has 3 to 8 elements round its top and at least 1 row");
    }
    return dome(request.first, request.second, element);
}

Expected<SurfaceLists> open_tube(const Request& request)
{
    if (request.first < 3 || request.second < 1) {
        return impossible(request, "a tube has at least 3 elements round and at least 1 row");
    }
    return tube(request.first, request.second);
}

Expected<SurfaceLists> ring(const Request& request)
{
    const bool rows_fit = request.second >= 6 && request.second % 4 == 2;
    if (!rows_fit || request.first < request.second || request.first > 4 * request.second) {
        return impossible(request, "a torus NxM has M = 6, 10, 14, ... rows and N = M to 4 M elements round the ring");
    }
    return torus(request.first, request.second);
}

Expected<SurfaceLists> patch(const Request& request)
{
    if (request.first < 1 || request.second < 1) {
        return impossible(request, "a sheet has at least 1 x 1 elements");
    }
    return sheet(request.first, request.second);
}

struct Family
{
    const char* prefix;
    bool two_numbers;
    const char* summary;
    Expected<SurfaceLists> (*make)(const Request&, const Element&);
};

// clang-format off
const Family families[] = {
    {"ball", false, "join of a geodesic ball, all front",
     [](const Request& r, const Element&) { return ball(r); }},
    {"rhombic", false, "rhombic solid", rhombic},
    {"polar", true, "polar stack: elements round the poles x rows", polar},
    {"checker", false, "rhombic solid divided k x k, checkerboard flips", checker},
    {"tube", true, "open tube: elements round x rows", [](const Request& r, const Element&) { return open_tube(r); }},
    {"torus", true, "torus: elements round the ring x rows round the tube",
     [](const Request& r, const Element&) { return ring(r); }},
    {"dome", true, "open dome: elements round the top x rows", open_dome},
    {"sheet", true, "flat patch: columns x rows", [](const Request& r, const Element&) { return patch(r); }},
};
// clang-format on

//! "12" or "5x4" -> numbers of at most five digits; nothing when the text is anything else.
bool read_numbers(std::string_view text, bool two, Request& request)
{
    const auto number = [&](int& value) {
        const auto end = std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 5), value);
        const bool ok = end.ec == std::errc() && value > 0;
        text.remove_prefix(static_cast<std::size_t>(end.ptr - text.data()));
        return ok;
    };
    if (!number(request.first)) {
        return false;
    }
    if (two) {
        if (text.empty() || text[0] != 'x') {
            return false;
        }
        text.remove_prefix(1);
        if (!number(request.second)) {
            return false;
        }
    }
    return text.empty();
}

//! Scale so that the edges are la long on average: where every embedding starts.
void scale_to(SurfaceLists& lists, double la)
{
    double sum = 0;
    for (const Quad& q : lists.quads) {
        for (int i = 0; i < 4; ++i) {
            sum += (lists.positions[q[i]] - lists.positions[q[(i + 1) % 4]]).norm();
        }
    }
    const double scale = la / (sum / static_cast<double>(4 * lists.quads.size()));
    for (Vec3& p : lists.positions) {
        p *= scale;
    }
}

tl::unexpected<Error> unknown_shape(const std::string& name)
{
    std::string text = "unknown shape \"" + name.substr(0, 60) + "\"; known are";
    for (const Family& family : families) {
        text += std::string(" ") + family.prefix + (family.two_numbers ? "-NxM" : "-N");
    }
    return refuse(text + ", for example ball-30 or polar-5x4 (`rhombloom shapes` lists them)");
}

} // namespace

std::vector<std::string> base_shape_names()
{
    return {"ball-6",      "ball-12",     "ball-30",   "ball-36",    "ball-48",    "ball-90",    "ball-120",
            "ball-210",    "ball-270",    "rhombic-6", "rhombic-12", "rhombic-20", "rhombic-30", "polar-3x3",
            "polar-3x4",   "polar-4x3",   "polar-5x3", "polar-4x4",  "polar-5x4",  "polar-3x7",  "polar-4x6",
            "polar-5x6",   "polar-5x8",   "polar-6x6", "checker-24", "checker-48", "checker-54", "checker-108",
            "checker-120", "checker-270", "tube-4x4",  "tube-6x6",   "tube-8x10",  "torus-12x6", "torus-16x6",
            "dome-3x2",    "dome-5x3",    "dome-6x4",  "sheet-1x1",  "sheet-2x1",  "sheet-4x4"};
}

Expected<BaseShape> base_shape(std::string_view name, const Element& element)
{
    Request request{std::string(name)};
    const std::size_t dash = name.find('-');
    const std::string_view prefix = name.substr(0, dash);
    const auto family =
        std::find_if(std::begin(families), std::end(families), [&](const Family& f) { return f.prefix == prefix; });
    if (family == std::end(families) || dash == std::string_view::npos ||
        !read_numbers(name.substr(dash + 1), family->two_numbers, request)) {
        return unknown_shape(request.name);
    }
    if (static_cast<long>(request.first) * std::max(1, request.second) > max_elements) {
        return impossible(request, "at most " + std::to_string(max_elements) + " elements are supported");
    }
    auto lists = family->make(request, element);
    if (!lists) {
        return tl::make_unexpected(lists.error());
    }
    scale_to(*lists, element.la);
    auto surface = make_surface(*lists);
    if (!surface) {
        return impossible(request, surface.error().message);
    }
    if (const Validity validity = validate(*surface, element); !validity.ok()) {
        return impossible(request, validity.problems.front());
    }
    const bool centred = family->prefix == std::string_view("sheet");
    const int seed = centred ? (request.second / 2) * (request.first + 1) + request.first / 2 : 0;
    return BaseShape{request.name, family->summary, std::move(*surface), Vertex(seed)};
}

} // namespace rhombloom
