#include "exporters/buildability.h"

#include <algorithm>
#include <cmath>

#include "core/model/angular_defect.h"
#include "core/model/validity.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double defect_margin = radians(10);

//! The preset of polypropylene, the classic of these lamps, nearest in
//! thickness.
Expected<Material> nearest_polypropylene(double thickness)
{
    auto presets = materials();
    if (!presets) {
        return tl::make_unexpected(presets.error());
    }
    const Material* best = nullptr;
    for (const Material& m : *presets) {
        const bool nearer =
            best == nullptr || std::abs(m.thickness - thickness) < std::abs(best->thickness - thickness);
        if (m.name.starts_with("pp-") && nearer) {
            best = &m;
        }
    }
    if (best == nullptr) {
        return machine_failure("the material presets have no polypropylene: the "
                               "installation is damaged");
    }
    Material chosen = *best;
    if (chosen.thickness != thickness) {
        chosen.title = "Polypropylene " + to_fixed(thickness, 2) + " mm";
        chosen.thickness = thickness;
    }
    return chosen;
}

//! Which elements stretch further than \p limit: how many, and where the worst is.
std::string overstretched(const Surface& surface, const Element& element, double limit)
{
    int count = 0;
    Face worst(0);
    for (const Face f : surface.faces()) {
        count += element_stretch(surface, element, f) > limit ? 1 : 0;
        worst = element_stretch(surface, element, f) > element_stretch(surface, element, worst) ? f : worst;
    }
    return std::to_string(count) + (count == 1 ? " element: " : " elements, most of all ") +
           std::to_string(worst.idx()) + " in \"" + surface.components[surface.data(worst).component] + "\"";
}

void judge_stretch(Buildability& report, const Surface& surface, const Piece& piece)
{
    const double stretch = report.embedding.max_stretch;
    const std::string percent = to_fixed(100 * stretch, 3) + " %";
    if (stretch > piece.stretch_limit) {
        report.problems.push_back("an element would have to stretch by " + percent + ", possible is " +
                                  to_text(100 * piece.stretch_limit) + " %: ease the tightest limb or junction (" +
                                  overstretched(surface, piece.element, piece.stretch_limit) +
                                  "), or cut a sheet that gives and allow it with --max-stretch");
    } else if (stretch > usual_stretch_limit) {
        report.warnings.push_back("elements have to stretch by up to " + percent + ", a usual sheet gives " +
                                  to_text(100 * usual_stretch_limit) + " %: hooks may jump out (" +
                                  overstretched(surface, piece.element, usual_stretch_limit) + ")");
    }
}

//! The element that is bent most, for a sentence.
std::string most_compressed(const Surface& surface, const Element& element)
{
    const auto compression = [&](Face f) { return element_compression(surface, element, f); };
    const Face worst = *std::max_element(surface.faces_begin(), surface.faces_end(),
                                         [&](Face a, Face b) { return compression(a) < compression(b); });
    return "element " + std::to_string(worst.idx()) + " in \"" + surface.components[surface.data(worst).component] +
           "\", pressed together to " + to_fixed(100 * (1 - compression(worst)), 0) + " % of a length";
}

void judge_embedding(Buildability& report, const Surface& surface, const Element& element)
{
    const EmbedReport& e = report.embedding;
    if (!e.converged) {
        report.problems.push_back("the shape did not come to rest (largest gradient " + to_text(e.gradient_norm) +
                                  "): " + e.message);
    } else if (!e.message.empty()) {
        report.warnings.push_back(e.message + " (most of all " + most_compressed(surface, element) +
                                  "): give that part more elements or fewer folds");
    }
}

void judge_defects(Buildability& report, const Surface& surface, const Element& element)
{
    const DefectRange limits = permissible_defect(element);
    int tight = 0;
    for (const Vertex v : surface.vertices()) {
        if (!surface.is_boundary(v) && angular_defect(surface, element, v) < limits.min + defect_margin) {
            ++tight;
        }
    }
    if (tight > 0) {
        report.warnings.push_back(std::to_string(tight) + " vertices are within 10 degrees of the most "
                                                          "elements that fit: hard to hook");
    }
}

} // namespace

Expected<Piece> make_piece(const Element& element, const std::optional<std::string>& material_name,
                           const std::vector<ParameterSetting>& settings)
{
    Piece piece;
    piece.element = element;
    auto chosen = material_name ? material(*material_name) : nearest_polypropylene(element.thickness);
    if (!chosen) {
        return tl::make_unexpected(chosen.error());
    }
    piece.material = std::move(*chosen);
    if (piece.material.thickness != element.thickness) {
        piece.notes.push_back("cut for " + piece.material.title + ": its " + to_fixed(piece.material.thickness, 2) +
                              " mm replace the design's " + to_fixed(element.thickness, 2) + " mm");
        piece.element.thickness = piece.material.thickness;
    }
    auto parameters = piece_parameters(piece.element, settings);
    if (!parameters) {
        return tl::make_unexpected(parameters.error());
    }
    piece.parameters = *parameters;
    return piece;
}

Buildability buildability(const Replay& replay, const Piece& piece)
{
    Buildability report;
    const Surface& surface = replay.surface;
    const Validity validity = validate(surface, piece.element);
    report.elements = static_cast<int>(surface.n_faces());
    for (const Face f : surface.faces()) {
        report.flipped += surface.data(f).facing == Facing::Back ? 1 : 0;
    }
    report.boundary_loops = validity.boundary_loops;
    report.euler_characteristic = validity.euler_characteristic;
    report.defects = defect_range(surface, piece.element);
    report.embedding = replay.embedding;
    report.problems = validity.problems;
    judge_embedding(report, surface, piece.element);
    judge_stretch(report, surface, piece);
    judge_defects(report, surface, piece.element);
    report.hooks = hook_checks(piece.parameters.hook, {piece.parameters.kerf, piece.material.strain_limit,
                                                       piece.material.finger_strain_limit});
    for (const HookCheck& check : report.hooks) {
        if (!check.ok) {
            report.problems.push_back(check.id + ": " + check.sentence);
        }
    }
    report.warnings.insert(report.warnings.end(), piece.notes.begin(), piece.notes.end());
    return report;
}

} // namespace rhombloom
