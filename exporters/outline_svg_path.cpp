#include "exporters/outline_svg_path.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "core/units.h"
#include "exporters/outline_pieces.h"

namespace rhombloom::reading {

namespace {

bool is_gap(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == ',';
}

//! Reads numbers and commands off the front of a text.
struct Scanner
{
    std::string_view rest;
    std::size_t length = rest.size();

    void skip_gaps()
    {
        while (!rest.empty() && is_gap(rest.front())) {
            rest.remove_prefix(1);
        }
    }

    bool at_end()
    {
        skip_gaps();
        return rest.empty();
    }

    bool number(double& value)
    {
        skip_gaps();
        std::string_view text = rest;
        if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
            text.remove_prefix(1);
        }
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || !std::isfinite(value)) {
            return false;
        }
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        return true;
    }

    //! Flags of an arc may stand without a gap: "a5 5 0 0110 0".
    bool flag(double& value)
    {
        skip_gaps();
        if (rest.empty() || (rest.front() != '0' && rest.front() != '1')) {
            return false;
        }
        value = rest.front() - '0';
        rest.remove_prefix(1);
        return true;
    }

    std::size_t position() const { return length - rest.size() + 1; }
};

//! Numbers a command takes.
int arity(char command)
{
    switch (command) {
    case 'M':
    case 'L':
    case 'T':
        return 2;
    case 'H':
    case 'V':
        return 1;
    case 'Q':
    case 'S':
        return 4;
    case 'C':
        return 6;
    case 'A':
        return 7;
    case 'Z':
        return 0;
    default:
        return -1;
    }
}

//! Builds paths from commands with absolute or relative numbers.
class Plotter
{
public:
    explicit Plotter(Pen& pen) : pen_(pen) {}

    void draw(char command, bool relative, const std::array<double, 7>& n);
    std::vector<Path> finished()
    {
        end_path();
        return std::move(paths_);
    }

private:
    void end_path()
    {
        if (path_.vertices.size() > 1) {
            paths_.push_back(path_);
        }
        path_ = {{}, false, {}};
    }
    void start_if_needed()
    {
        if (path_.vertices.empty()) {
            path_.vertices.push_back({pen_.to_mm * at_, 0});
        }
    }
    void line_to(const Vec2& p)
    {
        start_if_needed();
        path_.vertices.push_back({pen_.to_mm * p, 0});
        at_ = p;
    }
    void cubic_to(const Vec2& c1, const Vec2& c2, const Vec2& p);
    void quadratic_to(const Vec2& c, const Vec2& p) { cubic_to(at_ + 2.0 / 3 * (c - at_), p + 2.0 / 3 * (c - p), p); }

    Pen& pen_;
    std::vector<Path> paths_;
    Path path_{{}, false, {}};
    Vec2 at_ = Vec2::Zero(), start_ = Vec2::Zero(), control_ = Vec2::Zero();
    char last_ = ' ';
};

void Plotter::cubic_to(const Vec2& c1, const Vec2& c2, const Vec2& p)
{
    start_if_needed();
    pen_.curves = true;
    const Vec2 p0 = at_;
    const double bend = 6 * std::max((p0 - 2 * c1 + c2).norm(), (c1 - 2 * c2 + p).norm()) * pen_.to_mm.scale();
    const int n = std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / (8 * curve_tolerance)))), 1, 2000);
    for (int i = 1; i <= n; ++i) {
        const double t = static_cast<double>(i) / n, s = 1 - t;
        const Vec2 q = s * s * s * p0 + 3 * s * s * t * c1 + 3 * s * t * t * c2 + t * t * t * p;
        path_.vertices.push_back({pen_.to_mm * (i == n ? p : q), 0});
    }
    at_ = p;
}

void Plotter::draw(char command, bool relative, const std::array<double, 7>& n)
{
    const Vec2 base = relative ? at_ : Vec2::Zero();
    const auto point = [&](std::size_t i) { return Vec2(base + Vec2(n[i], n[i + 1])); };
    const auto mirrored_control = [&](const char* after) {
        return std::string_view(after).find(last_) != std::string_view::npos ? Vec2(2 * at_ - control_) : at_;
    };
    Vec2 control = at_;
    switch (command) {
    case 'M':
        end_path();
        at_ = start_ = point(0);
        break;
    case 'L':
        line_to(point(0));
        break;
    case 'H':
        line_to({base.x() + n[0], at_.y()});
        break;
    case 'V':
        line_to({at_.x(), base.y() + n[0]});
        break;
    case 'C':
        control = point(2);
        cubic_to(point(0), control, point(4));
        break;
    case 'S': {
        const Vec2 c1 = mirrored_control("CS");
        control = point(0);
        cubic_to(c1, control, point(2));
        break;
    }
    case 'Q':
        control = point(0);
        quadratic_to(control, point(2));
        break;
    case 'T':
        control = mirrored_control("QT");
        quadratic_to(control, point(0));
        break;
    case 'A':
        start_if_needed();
        add_svg_arc(path_, at_, point(5), {n[0], n[1], radians(n[2]), n[3] != 0, n[4] != 0}, pen_);
        at_ = point(5);
        break;
    case 'Z':
        path_.closed = path_.vertices.size() > 1;
        end_path();
        at_ = start_;
        break;
    default:
        break;
    }
    control_ = control;
    last_ = command;
}

bool read_numbers(Scanner& scan, char command, std::array<double, 7>& n)
{
    for (int i = 0; i < arity(command); ++i) {
        const bool is_flag = command == 'A' && (i == 3 || i == 4);
        if (!(is_flag ? scan.flag(n[static_cast<std::size_t>(i)]) : scan.number(n[static_cast<std::size_t>(i)]))) {
            return false;
        }
    }
    return true;
}

bool at_number(const Scanner& scan)
{
    return !scan.rest.empty() && (std::string_view("+-.0123456789").find(scan.rest.front()) != std::string_view::npos);
}

} // namespace

Affine Affine::operator*(const Affine& i) const
{
    return {a * i.a + c * i.b, b * i.a + d * i.b,     a * i.c + c * i.d,
            b * i.c + d * i.d, a * i.e + c * i.f + e, b * i.e + d * i.f + f};
}

double Affine::scale() const
{
    return std::max(std::hypot(a, b), std::hypot(c, d));
}

bool Affine::keeps_circles() const
{
    const double tolerance = 1e-9 * scale() * scale();
    return std::abs(a * c + b * d) <= tolerance && std::abs(a * a + b * b - c * c - d * d) <= tolerance;
}

Expected<std::vector<double>> svg_numbers(std::string_view text)
{
    Scanner scan{text};
    std::vector<double> numbers;
    while (!scan.at_end()) {
        double value = 0;
        if (!scan.number(value)) {
            return refuse("\"" + std::string(text.substr(0, 60)) + "\" should be a list of numbers");
        }
        numbers.push_back(value);
    }
    return numbers;
}

Expected<std::vector<Path>> svg_path(std::string_view data, Pen& pen)
{
    Scanner scan{data};
    Plotter plotter(pen);
    char command = ' ';
    bool relative = false, first = true;
    while (!scan.at_end()) {
        if (!at_number(scan)) {
            const char letter = scan.rest.front();
            relative = letter >= 'a';
            command = relative ? static_cast<char>(letter - 'a' + 'A') : letter;
            scan.rest.remove_prefix(1);
        } else if (command == 'M') {
            command = 'L'; // further pairs after a move are lines
        } else if (command == 'Z') {
            command = ' ';
        }
        std::array<double, 7> n{};
        if (arity(command) < 0 || (first && command != 'M') || !read_numbers(scan, command, n)) {
            return refuse("the path data is malformed at character " + std::to_string(scan.position()));
        }
        first = false;
        plotter.draw(command, relative, n);
    }
    return plotter.finished();
}

} // namespace rhombloom::reading
