// The outline that OpenSCAD draws against ours, point by point and as an area. OpenSCAD prints six digits only, so
// the points are compared inside OpenSCAD and the answer is a verdict and a deviation.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>
#include <polyclipping/clipper.hpp>
#include <unistd.h>

#include "core/text.h"
#include "exporters/kerf.h"
#include "exporters/scad.h"

namespace rhombloom {

namespace {

namespace fs = std::filesystem;

constexpr int segments = 720; // of the template
constexpr int finest = 1080;  // that its slider offers
constexpr int parameter_sets = 80;

//! A folder of its own, removed at the end.
struct Folder
{
    fs::path path = fs::path(testing::TempDir()) / ("rhombloom-scad-" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

struct Outcome
{
    bool ok = false;
    std::string log;
    std::string output;
};

bool has_openscad()
{
    return std::system("openscad --version >/dev/null 2>&1") == 0;
}

std::string text_of(const fs::path& path)
{
    return fs::exists(path) ? load_file(path.string(), 1 << 26).value_or("") : "";
}

//! OpenSCAD on \p scad; the kind of output follows from the suffix.
Outcome openscad(const fs::path& folder, const std::string& scad, const std::string& suffix)
{
    const std::string in = (folder / "in.scad").string();
    const std::string out = (folder / "out").string() + suffix;
    const std::string log = (folder / "log").string();
    EXPECT_TRUE(save_file(in, scad));
    fs::remove(out);
    const int status = std::system(("openscad --hardwarnings -o " + out + " " + in + " >" + log + " 2>&1").c_str());
    return {status == 0, text_of(log), text_of(out)};
}

//! Every dimension away from its rule, by a third at most; la 40 to 200 mm, alpha 50 to 80 degrees.
HookParameters random_parameters(std::mt19937& random)
{
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    Element element;
    element.la = uniform(40, 200);
    element.lb = element.la * uniform(1.02, 1.5);
    element.alpha = radians(uniform(50, 80));
    element.thickness = uniform(0.2, 0.8);
    HookParameters p = hook_parameters(element);
    if (random() % 4 == 0) {
        return p;
    }
    for (double* size : {&p.finger_width, &p.hole_radius, &p.finger_length, &p.lip, &p.neck_setback, &p.lip_rounding,
                         &p.scoop_depth, &p.barb}) {
        *size *= uniform(0.75, 1.33);
    }
    p.finger_turn = random() % 2 ? radians(uniform(0, 10)) : 0;
    p.relief = random() % 2 ? uniform(0.1, 0.6) : 0;
    p.barb = random() % 4 ? p.barb : 0;
    return p;
}

bool in_range(const HookParameters& p)
{
    for (const Parameter& row : scad_parameters(ScadPart::Connector)) {
        const double value = row.get({p, {}});
        if (value < row.min || value > row.max) {
            return false;
        }
    }
    return true;
}

std::vector<HookParameters> valid_parameters(int count)
{
    std::mt19937 random(20150815);
    std::vector<HookParameters> sets;
    while (static_cast<int>(sets.size()) < count) {
        const HookParameters p = random_parameters(random);
        if (in_range(p) && element_outline(p)) {
            sets.push_back(p);
        }
    }
    return sets;
}

std::string element_scad(const PieceParameters& p)
{
    return hook_files(p, "parity").value().at("hooks/element.scad");
}

std::string element_scad(const HookParameters& p)
{
    return element_scad(PieceParameters{p, {}});
}

//! With arcs drawn so finely that their chords cut off less area than what is allowed.
std::string fine_scad(const PieceParameters& p)
{
    return with_literal(element_scad(p), "segments", std::to_string(finest)).value();
}

//! The template and a comparison of its points with \p points.
std::string comparison(const std::string& scad, const std::vector<Vec2>& points)
{
    std::string list;
    for (const Vec2& p : points) {
        list += (list.empty() ? "[" : ",\n[") + to_text(p.x()) + "," + to_text(p.y()) + "]";
    }
    return scad + "\ncpp_points = [" + list +
           "];\nscad_points = element_points();\n"
           "deviation = len(cpp_points) != len(scad_points) ? 1e9 :\n"
           "    max([for (i = [0 : len(cpp_points) - 1]) norm(cpp_points[i] - scad_points[i])]);\n"
           "echo(str(\"deviation=\", deviation, \"=\"));\n";
}

double deviation(const Outcome& run)
{
    const std::size_t at = run.output.find("deviation=");
    return at == std::string::npos ? 1e9 : std::atof(run.output.c_str() + at + 10);
}

//! \name Areas. OpenSCAD writes six digits, 0.0001 mm only below 100 mm: it exports large elements in windows.
//! \{

constexpr double window = 199;   // mm, centred on the origin
constexpr double clipper = 1e-6; // mm

ClipperLib::Path clipper_path(const std::vector<Vec2>& points)
{
    ClipperLib::Path path;
    for (const Vec2& p : points) {
        path.push_back({std::llround(p.x() / clipper), std::llround(p.y() / clipper)});
    }
    return path;
}

ClipperLib::Paths combined(ClipperLib::ClipType type, const ClipperLib::Paths& a, const ClipperLib::Paths& b)
{
    ClipperLib::Clipper engine;
    engine.AddPaths(a, ClipperLib::ptSubject, true);
    engine.AddPaths(b, ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    engine.Execute(type, result, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
    return result;
}

//! mm2
double total_area(const ClipperLib::Paths& paths)
{
    double sum = 0;
    for (const auto& path : paths) {
        sum += ClipperLib::Area(path) * clipper * clipper;
    }
    return std::abs(sum);
}

//! The contours of an SVG by OpenSCAD, y up again.
ClipperLib::Paths svg_paths(const std::string& svg)
{
    ClipperLib::Paths paths;
    std::vector<Vec2> points;
    const std::size_t start = svg.find(" d=\"");
    const std::string data = svg.substr(start + 4, svg.find('"', start + 4) - start - 4);
    for (std::size_t i = data.find_first_of("MLz"); i != std::string::npos; i = data.find_first_of("MLz", i + 1)) {
        double x = 0;
        double y = 0;
        if (data[i] == 'z') {
            paths.push_back(clipper_path(points));
            points.clear();
        } else if (std::sscanf(data.c_str() + i + 1, " %lf,%lf", &x, &y) == 2) {
            points.emplace_back(x, -y);
        }
    }
    return paths;
}

//! Ours, arcs as good as exact.
std::vector<Vec2> exact_points(const PieceParameters& p)
{
    const Path outline = element_outline(p.hook).value();
    return flatten(p.kerf.x > 0 ? tool_path(outline, p.kerf).value().contour : outline, 1e-5);
}

Vec2 middle(const HookParameters& p)
{
    return Vec2(p.lb + p.la * std::cos(p.alpha), p.la * std::sin(p.alpha)) / 2;
}

//! What the template of \p p exports and \p ours differ by in the window about \p centre (relative to the middle), mm2.
double difference_in_window(const fs::path& folder, const PieceParameters& p, const PieceParameters& ours,
                            const Vec2& centre)
{
    const std::string shift = "[" + to_text(-centre.x()) + ", " + to_text(-centre.y()) + "]";
    const std::string view = "\n!intersection() { square(" + to_text(window) + ", center = true); translate(" + shift +
                             ") sheet() translate(-middle) polygon(points); }\n";
    const Outcome run = openscad(folder, fine_scad(p) + view, ".svg");
    EXPECT_TRUE(run.ok) << run.log;
    std::vector<Vec2> points = exact_points(ours);
    for (Vec2& q : points) {
        q -= middle(ours.hook) + centre;
    }
    const double h = window / 2;
    const ClipperLib::Paths frame = {clipper_path({{-h, -h}, {h, -h}, {h, h}, {-h, h}})};
    const auto clipped = combined(ClipperLib::ctIntersection, {clipper_path(points)}, frame);
    return total_area(combined(ClipperLib::ctXor, clipped, svg_paths(run.output)));
}

//! mm2, over as many windows as the element of \p p needs.
double symmetric_difference(const fs::path& folder, const PieceParameters& p, const PieceParameters& ours)
{
    const Box box = bounds(element_outline(p.hook).value());
    const Vec2 size = box.max - box.min;
    const int columns = static_cast<int>(std::ceil(size.x() / window));
    const int rows = static_cast<int>(std::ceil(size.y() / window));
    double sum = 0;
    for (int i = 0; i < columns * rows; ++i) {
        const Vec2 cell(i % columns - (columns - 1) / 2.0, i / columns - (rows - 1) / 2.0);
        sum += difference_in_window(folder, p, ours, window * cell);
    }
    return sum;
}
//! \}

//! Largest distance from a point of \p from to the polygon \p to.
double one_sided_distance(const std::vector<Vec2>& from, const std::vector<Vec2>& to)
{
    double worst = 0;
    for (const Vec2& p : from) {
        double nearest = 1e300;
        for (std::size_t i = 0; i < to.size(); ++i) {
            const Vec2& a = to[i];
            const Vec2 ab = to[(i + 1) % to.size()] - a;
            const double t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
            nearest = std::min(nearest, (p - a - t * ab).squaredNorm());
        }
        worst = std::max(worst, nearest);
    }
    return std::sqrt(worst);
}

#define REQUIRE_OPENSCAD()                                                                                             \
    if (!has_openscad()) {                                                                                             \
        GTEST_SKIP() << "OpenSCAD is not installed: the templates' outline was NOT compared with ours";                \
    }

} // namespace

TEST(ScadOutline, HasThePointsOfOurs)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    double worst = 0;
    for (const HookParameters& p : valid_parameters(parameter_sets)) {
        const Outcome run = openscad(folder.path, comparison(element_scad(p), *outline_points(p, segments)), ".echo");
        EXPECT_TRUE(run.ok) << run.log << run.output;
        EXPECT_NE(run.output.find("matches the project"), std::string::npos) << run.output;
        EXPECT_LE(deviation(run), 1e-9);
        worst = std::max(worst, deviation(run));
    }
    std::printf("%d parameter sets, largest deviation of a point %.2g mm\n", parameter_sets, worst);
}

TEST(ScadOutline, CoversTheAreaOfOurs)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    double worst = 0;
    for (const HookParameters& p : valid_parameters(parameter_sets)) {
        const double difference = symmetric_difference(folder.path, {p, {}}, {p, {}});
        EXPECT_LE(difference, 0.05) << "la " << p.la;
        worst = std::max(worst, difference);
    }
    std::printf("%d parameter sets, largest symmetric difference %.3g mm2\n", parameter_sets, worst);
}

// The kerf of OpenSCAD's offset against our exact one: same edge on every side, different widths in x and y too.
TEST(ScadOutline, IsCutWithTheKerfOfOurs)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    for (const Kerf& kerf : {Kerf{0.1, 0.1}, Kerf{0.25, 0.25}, Kerf{0.15, 0.3}}) {
        const PieceParameters p{hook_parameters({}), kerf};
        EXPECT_LE(symmetric_difference(folder.path, p, p), 0.05) << "kerf " << kerf.x << ", " << kerf.y;
        EXPECT_GT(symmetric_difference(folder.path, p, {p.hook, {}}), 10);
    }
}

// As it comes out of the template, without finer arcs.
TEST(ScadOutline, IsWithinAHundredthOfAMillimetreAsItComes)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    for (const double la : {40.0, 80.0, 200.0}) {
        Element element;
        element.la = la;
        element.lb = 1.1 * la;
        const HookParameters p = hook_parameters(element);
        const auto paths = svg_paths(openscad(folder.path, element_scad(p), ".svg").output);
        ASSERT_EQ(paths.size(), 1u);
        const Path outline = element_outline(p).value();
        EXPECT_NEAR(total_area(paths) / area(outline), 1, 1e-4);
        std::vector<Vec2> theirs;
        for (const auto& q : paths[0]) {
            theirs.push_back(middle(p) + clipper * Vec2(static_cast<double>(q.X), static_cast<double>(q.Y)));
        }
        const auto ours = flatten(outline, 1e-3);
        EXPECT_LE(one_sided_distance(theirs, ours), 0.01);
        EXPECT_LE(one_sided_distance(ours, theirs), 0.01);
    }
}

// The comparisons above can fail: a hundredth of a millimetre in one dimension is seen by each of them.
TEST(ScadOutline, IsSeenToDifferWhenPerturbed)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    const HookParameters p = hook_parameters({});
    HookParameters perturbed = p;
    perturbed.hole_radius += 0.01;
    const Outcome points =
        openscad(folder.path, comparison(element_scad(p), *outline_points(perturbed, segments)), ".echo");
    EXPECT_GT(deviation(points), 0.005);
    EXPECT_GT(symmetric_difference(folder.path, {p, {}}, {perturbed, {}}), 0.05);
    EXPECT_LE(symmetric_difference(folder.path, {p, {}}, {p, {}}), 0.05);
}

// A template that no longer draws our outline says so itself.
TEST(ScadOutline, StopsWhenTheFingerprintIsBroken)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    std::string scad = element_scad(hook_parameters({}));
    const std::string run_length = "run = 0.35 * ";
    scad.replace(scad.find(run_length), run_length.size(), "run = 0.36 * ");
    const Outcome run = openscad(folder.path, scad, ".svg");
    EXPECT_FALSE(run.ok);
    EXPECT_NE(run.log.find("draw different outlines"), std::string::npos) << run.log;
}

// What a design is called stays a comment.
TEST(ScadOutline, IsNotChangedByTheTitle)
{
    REQUIRE_OPENSCAD();
    const Folder folder;
    const auto svg_of = [&](const std::string& title) {
        const auto files = hook_files(hook_parameters({}), title);
        return openscad(folder.path, files.value().at("hooks/element.scad"), ".svg").output;
    };
    const std::string plain = svg_of("");
    ASSERT_FALSE(plain.empty());
    for (const char* title :
         {"a\nla = 100;", "*/ cube(9); /*", "\"; square(500); //", "\r\nsquare(500);", "x\\\nlb=1;"}) {
        EXPECT_EQ(svg_of(title), plain) << title;
    }
}

} // namespace rhombloom
