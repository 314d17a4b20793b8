#include "core/design/mesh_import/mesh_import.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/import_warning.h"
#include "core/design/mesh_import/mesh_repair.h"
#include "core/design/mesh_import/network.h"
#include "core/design/mesh_import/network_crossings.h"
#include "core/design/mesh_import/network_search.h"
#include "core/design/mesh_import/working_target.h"
#include "core/model/angular_defect.h"
#include "core/model/validity.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr int fewest_elements = 20;
constexpr int usual_elements = 600;
constexpr int most_acute_corners = 5; // that makers report at one node
constexpr double defect_margin = radians(10);

//! What the sizes asked for come to.
struct Sizing
{
    double factor = 1; //!< from file coordinates to the mm in which the network is searched
    int elements = 0;
    bool rescale = true; //!< the target may be scaled to suit the elements
    double height = 0;   //!< mm that the result is scaled to in the end, elements and all; 0: it is not
};

double element_area(const Element& element)
{
    return area_per_element(triangle_edge(element));
}

Expected<Sizing> sizing(const TriangleMesh& mesh, const ImportOptions& options)
{
    const ImportSize& size = options.size;
    if (size.elements && size.la && size.height) {
        return refuse("elements, la and height are all given: two of them settle the third, leave one out");
    }
    const double own_height = bounds(mesh).sizes().z();
    const double own_area = area(mesh);
    Sizing result;
    if (size.la && !size.elements) {
        result.factor = size.height ? *size.height / own_height : options.mm_per_unit;
        result.rescale = false;
        const double count = own_area * result.factor * result.factor / element_area(options.element);
        if (!(count >= fewest_elements && count <= most_import_elements)) {
            return refuse("with la " + to_fixed(*size.la, 1) + " mm a target " +
                          to_fixed(own_height * result.factor, 1) + " mm high would take " + to_fixed(count, 0) +
                          " elements: expected " + std::to_string(fewest_elements) + " to " +
                          std::to_string(most_import_elements) + "; give --elements or another --height");
        }
        result.elements = static_cast<int>(std::lround(count));
        return result;
    }
    result.elements = size.elements.value_or(usual_elements);
    if (result.elements < fewest_elements || result.elements > most_import_elements) {
        return refuse(std::to_string(result.elements) + " elements were asked for: expected " +
                      std::to_string(fewest_elements) + " to " + std::to_string(most_import_elements));
    }
    result.factor = std::sqrt(result.elements * element_area(options.element) / own_area);
    result.height = size.height.value_or(0);
    return result;
}

//! Multiply all lengths, the element's too.
void rescale(ImportedMesh& result, Surface& surface, double factor)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, factor * surface.point(v));
    }
    transform(result.target, factor, Vec3::Zero());
    result.element.la *= factor;
    result.element.lb *= factor;
    result.report.scale *= factor;
}

//! Stand the target on the ground, its middle above the origin, and the network with it.
void stand(ImportedMesh& result, Surface& surface)
{
    const Eigen::AlignedBox3d box = bounds(result.target);
    const Vec3 shift(-box.center().x(), -box.center().y(), -box.min().z());
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, surface.point(v) + shift);
    }
    transform(result.target, 1, shift);
    result.report.shift = shift;
}

int hard_nodes(const Surface& surface, const Element& element)
{
    const DefectRange limits = permissible_defect(element);
    int count = 0;
    for (const Vertex v : surface.vertices()) {
        if (surface.is_boundary(v)) {
            continue;
        }
        int acute = 0;
        for (const Face f : surface.vf_range(v)) {
            acute += corner_angle(surface, element, f, v) < pi / 2 ? 1 : 0;
        }
        count += acute > most_acute_corners || angular_defect(surface, element, v) < limits.min + defect_margin ? 1 : 0;
    }
    return count;
}

//! That a share of the target is too thin for elements; empty when it is not.
std::string thickness_remark(double share, const Element& element)
{
    if (share == 0) {
        return {};
    }
    return to_fixed(100 * share, 0) + " % of the target is thinner than " + to_fixed(least_thickness(element), 0) +
           " mm, the thinnest that elements of la " + to_fixed(element.la, 0) +
           " mm can follow, and becomes as thick as that; with more elements less of it";
}

//! That a share of the target lies in gaps that are too narrow for elements; empty when none does.
std::string gap_remark(double share, const Element& element)
{
    if (share == 0) {
        return {};
    }
    const std::string percent = share < 0.01 ? "less than 1" : to_fixed(100 * share, 0);
    return percent + " % of the target lies in gaps or holes narrower than " + to_fixed(least_gap_width(element), 0) +
           " mm, the narrowest that elements of la " + to_fixed(element.la, 0) +
           " mm leave open, and these are filled; with more elements fewer of them";
}

void fill_report(const Surface& surface, const FoundNetwork& found, ImportedMesh& result)
{
    ImportReport& report = result.report;
    report.elements = static_cast<int>(surface.n_faces());
    report.la = result.element.la;
    report.defects = defect_range(surface, result.element);
    report.hard_nodes = hard_nodes(surface, result.element);
    report.embedding = found.embedding;
    report.crosses = has_crossings(surface);
}

//! To 0.001 mm, like the positions.
ImportDistance stored(const Distance& distance)
{
    const auto rounded = [](double mm) { return std::round(1000 * mm) / 1000; };
    return {rounded(distance.to_target.rms), rounded(distance.to_target.max), rounded(distance.from_target.rms),
            rounded(distance.from_target.max)};
}

} // namespace

Expected<ImportedMesh> import_mesh(const TriangleMesh& mesh, const ImportOptions& options)
{
    RepairOptions repairing;
    repairing.elements = options.size.elements.value_or(usual_elements);
    repairing.progress = options.progress;
    auto repaired = repair(mesh, repairing);
    if (!repaired) {
        return tl::make_unexpected(repaired.error());
    }
    ImportedMesh result;
    result.element = options.element;
    result.report.repairs = repaired->repairs;
    const auto size = sizing(repaired->tree.mesh(), options);
    if (!size) {
        return tl::make_unexpected(size.error());
    }
    MeshTree& whole = repaired->tree; // the target in all its detail: what distances are measured from
    whole.transform(size->factor, Vec3::Zero());
    auto found = search_network(whole.mesh(), result.element,
                                {size->elements, size->rescale, options.embedding, options.progress});
    if (!found) {
        return tl::make_unexpected(found.error());
    }
    result.target = std::move(found->target);
    result.report.elements_asked = found->elements;
    result.report.scale = size->factor * found->target_scale;
    if (size->height > 0) {
        const double height = bounds(whole.mesh()).sizes().z() * found->target_scale;
        rescale(result, found->surface, size->height / height);
    }
    stand(result, found->surface);
    whole.transform(result.report.scale / size->factor, result.report.shift);
    result.report.distance = distance(found->surface, whole);
    fill_report(found->surface, *found, result);
    result.operation = import_of(found->surface, options.id);
    result.operation.distance = stored(result.report.distance);
    for (const std::string& remark :
         {thickness_remark(found->thickened, result.element), gap_remark(found->filled, result.element)}) {
        if (!remark.empty()) {
            result.report.repairs.push_back(remark);
        }
    }
    if (result.report.embedding.converged && !result.report.embedding.message.empty()) {
        result.report.warnings.push_back(result.report.embedding.message);
    }
    if (const std::string far = distance_warning(result.operation, result.element); !far.empty()) {
        result.report.warnings.push_back(far);
    }
    return result;
}

} // namespace rhombloom
