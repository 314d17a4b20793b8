#include <map>

#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "core/model/angular_defect.h"
#include "core/model/base_shapes.h"
#include "core/model/layers.h"
#include "core/model/validity.h"
#include "core/text.h"

namespace rhombloom::cli {

namespace {

struct Row
{
    std::string name;
    std::string summary;
    int elements = 0;
    int flips = 0;
    int layers = 0;
    bool closed = true;
    std::map<int, int> valences;        //!< valence -> number of interior vertices
    std::map<std::string, int> defects; //!< degrees -> number of interior vertices
};

Row describe(const BaseShape& shape, const Element& element)
{
    Row row;
    row.name = shape.name;
    row.summary = shape.summary;
    row.elements = static_cast<int>(shape.surface.n_faces());
    row.layers = static_cast<int>(layers(shape.surface, shape.seed).size());
    row.closed = validate(shape.surface, element).boundary_loops == 0;
    for (const Face f : shape.surface.faces()) {
        row.flips += shape.surface.data(f).facing == Facing::Back ? 1 : 0;
    }
    for (const Vertex v : shape.surface.vertices()) {
        if (!shape.surface.is_boundary(v)) {
            ++row.valences[valence(shape.surface, v)];
            ++row.defects[to_fixed(degrees(angular_defect(shape.surface, element, v)), 1)];
        }
    }
    return row;
}

std::string padded(std::string text, std::size_t width)
{
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string as_text(const std::vector<Row>& rows)
{
    std::string text = "name         elements flips layers  valences                defects (degrees)\n";
    for (const Row& row : rows) {
        std::string valences;
        for (const auto& [value, count] : row.valences) {
            valences += std::to_string(count) + "x" + std::to_string(value) + " ";
        }
        std::string defects;
        for (const auto& [value, count] : row.defects) {
            defects += std::to_string(count) + " x " + value + "  ";
        }
        text += padded(row.name, 13) + padded(std::to_string(row.elements), 9) + padded(std::to_string(row.flips), 6) +
                padded(std::to_string(row.layers), 8) + padded(valences, 24) + defects + "\n";
    }
    return text + "Families take other numbers too: ball-N, rhombic-N, checker-N, polar-NxM, tube-NxM, torus-NxM, "
                  "dome-NxM, sheet-NxM.\n";
}

std::string as_json(const std::vector<Row>& rows)
{
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        auto valences = nlohmann::ordered_json::object();
        for (const auto& [value, count] : row.valences) {
            valences[std::to_string(value)] = count;
        }
        list.push_back({{"name", row.name},
                        {"summary", row.summary},
                        {"elements", row.elements},
                        {"flips", row.flips},
                        {"layers", row.layers},
                        {"closed", row.closed},
                        {"valences", valences},
                        {"defects_deg", row.defects}});
    }
    return list.dump(1) + "\n";
}

} // namespace

void add_shapes(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("shapes", "List the base-shape library.");
    command->footer("Example: rhombloom shapes --json");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "machine-readable");
    command->callback([&run, json] {
        run = [json]() -> Expected<int> {
            std::vector<Row> rows;
            for (const std::string& name : base_shape_names()) {
                rows.push_back(describe(*base_shape(name, Element{}), Element{}));
            }
            return print(*json ? as_json(rows) : as_text(rows)).map([] { return 0; });
        };
    });
}

} // namespace rhombloom::cli
