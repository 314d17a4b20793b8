#include "core/design/scene.h"

#include <algorithm>

#include "core/design/edit.h"
#include "core/design/extrude.h"
#include "core/design/merge.h"
#include "core/design/mesh_import/network.h"
#include "core/design/planar_layout.h"
#include "core/design/pose.h"
#include "core/text.h"

namespace rhombloom {

namespace {

struct Context
{
    const Design& design;
    const EmbedOptions& embedding;
    Scene& scene;

    const Element& element() const { return design.element; }
    Symmetry symmetry(bool symmetric) const { return symmetric ? design.symmetry : Symmetry{}; }
};

Expected<ScenePart*> part(Scene& scene, const std::string& id)
{
    for (ScenePart& candidate : scene.parts) {
        if (candidate.id == id) {
            return &candidate;
        }
    }
    std::string known;
    for (const ScenePart& candidate : scene.parts) {
        known += (known.empty() ? "" : ", ") + candidate.id;
    }
    return refuse("there is no part \"" + id +
                  "\" at this point of the history; there are: " + (known.empty() ? "none" : known));
}

Expected<void> check_symmetric(const Design& design, bool symmetric)
{
    if (symmetric && design.symmetry.kind == Symmetry::Kind::None) {
        return refuse("the operation is marked symmetric, but the design declares no symmetry");
    }
    return {};
}

Expected<void> add_part(const std::string& id, Surface surface, const EmbedReport& report, Scene& scene)
{
    if (part(scene, id)) {
        return refuse("there is already a part \"" + id + "\": choose another id");
    }
    surface.components = {id};
    for (const Face f : surface.faces()) {
        surface.data(f).serial = scene.next_serial++;
        surface.data(f).component = 0;
    }
    scene.parts.push_back({id, std::move(surface), report});
    return {};
}

//! Of a Place or a Layout.
template <class Posed>
Eigen::Isometry3d pose(const Posed& place)
{
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translate(place.position);
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.z()), Vec3::UnitZ()));
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.y()), Vec3::UnitY()));
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.x()), Vec3::UnitX()));
    return result;
}

Expected<const BaseShape*> embedded_brush(const std::string& name, const Context& context)
{
    if (const auto known = context.scene.brushes.find(name); known != context.scene.brushes.end()) {
        return &known->second;
    }
    auto shape = base_shape(name, context.element());
    if (!shape) {
        return tl::make_unexpected(shape.error());
    }
    embed_in_place(shape->surface, context.element(), context.embedding);
    return &context.scene.brushes.emplace(name, std::move(*shape)).first->second;
}

Expected<void> run(const Place& place, const Context& context)
{
    auto shape = base_shape(place.shape, context.element());
    if (!shape) {
        return tl::make_unexpected(shape.error());
    }
    Surface surface = std::move(shape->surface);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, pose(place) * surface.point(v));
    }
    const EmbedReport report = embed_in_place(surface, context.element(), context.embedding);
    return add_part(place.id, std::move(surface), report, context.scene);
}

Expected<void> run(const Layout& layout, const Context& context)
{
    auto surface = planar_layout(layout, context.element());
    if (!surface) {
        return tl::make_unexpected(surface.error());
    }
    const EmbedReport report = unfold(*surface, context.element(), context.embedding);
    for (const Vertex v : surface->vertices()) {
        surface->set_point(v, pose(layout) * surface->point(v));
    }
    return add_part(layout.id, std::move(*surface), report, context.scene);
}

Expected<void> run(const Import& import, const Context& context)
{
    auto surface = network(import);
    if (!surface) {
        return tl::make_unexpected(surface.error());
    }
    EmbedOptions options = context.embedding;
    options.start = Start::Edited; // as it settled when it was made: its creases are meant
    const EmbedReport report = embed_in_place(*surface, context.element(), options);
    return add_part(import.id, std::move(*surface), report, context.scene);
}

Expected<void> run(const Merge& merge, const Context& context)
{
    auto on = part(context.scene, merge.on);
    auto with = part(context.scene, merge.with);
    if (!on || !with) {
        return tl::make_unexpected(on ? with.error() : on.error());
    }
    if (*on == *with) {
        return refuse("\"" + merge.on + "\" cannot be merged with itself");
    }
    MergeOptions options;
    options.symmetry = context.design.symmetry;
    options.all_images = merge.symmetric;
    options.first_serial = context.scene.next_serial;
    options.embedding = context.embedding;
    auto merged = rhombloom::merge((*on)->surface, (*with)->surface, context.element(), merge.candidate, options);
    if (!merged) {
        return tl::make_unexpected(merged.error());
    }
    context.scene.next_serial = merged->next_serial;
    (*on)->surface = std::move(merged->surface);
    (*on)->embedding = merged->embedding;
    context.scene.parts.erase(context.scene.parts.begin() + (*with - context.scene.parts.data()));
    return {};
}

Expected<void> run(const Extrude& extrude, const Context& context)
{
    auto on = part(context.scene, extrude.on);
    auto brush = embedded_brush(extrude.brush, context);
    if (!on || !brush) {
        return tl::make_unexpected(on ? brush.error() : on.error());
    }
    const auto apex = find_vertex((*on)->surface, extrude.apex);
    if (!apex) {
        return tl::make_unexpected(apex.error());
    }
    ExtrudeRequest request;
    request.apex = *apex;
    request.drag = extrude.by;
    request.component = extrude.id.empty() ? "limb " + std::to_string(context.scene.operations + 1) : extrude.id;
    request.candidate = extrude.candidate;
    request.symmetry = context.design.symmetry;
    request.all_images = extrude.symmetric;
    request.first_serial = context.scene.next_serial;
    auto made = rhombloom::extrude((*on)->surface, context.element(), **brush, request, context.embedding);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    context.scene.next_serial = made->next_serial;
    (*on)->surface = std::move(made->surface);
    (*on)->embedding = made->embedding;
    return {};
}

Expected<std::vector<Face>> find_elements(const ScenePart& on, const std::vector<Reference>& references,
                                          const Symmetry& symmetry, const Element& element)
{
    std::vector<Face> elements;
    for (const Reference& reference : references) {
        const auto f = find_element(on.surface, reference);
        if (!f) {
            return tl::make_unexpected(f.error());
        }
        elements.push_back(*f);
    }
    return with_images(on.surface, element, symmetry, elements);
}

//! Without a few elements an equilibrium keeps its creases and its symmetry: only when it does not come to rest like
//! that, it is repaired. (A flipped element may leave a dimple that has to be popped out.)
EmbedReport embed_opened(Surface& surface, const Surface& before, const std::vector<int>& number,
                         const Context& context)
{
    const Surface start = surface;
    EmbedOptions edited = context.embedding;
    edited.start = Start::Edited;
    const EmbedReport report = embed_in_place(surface, before, number, context.element(), edited);
    if (report.converged) {
        return report;
    }
    surface = start;
    return embed_in_place(surface, before, number, context.element(), context.embedding);
}

Expected<void> run(const Open& open, const Context& context)
{
    auto on = part(context.scene, open.on);
    if (!on) {
        return tl::make_unexpected(on.error());
    }
    const auto elements = find_elements(**on, open.elements, context.symmetry(open.symmetric), context.element());
    if (!elements) {
        return tl::make_unexpected(elements.error());
    }
    auto opened = open_elements((*on)->surface, *elements);
    if (!opened) {
        return tl::make_unexpected(opened.error());
    }
    const Surface before = std::move((*on)->surface);
    (*on)->embedding = embed_opened(opened->surface, before, opened->number, context);
    (*on)->surface = std::move(opened->surface);
    return {};
}

Expected<void> run(const Flip& flip, const Context& context)
{
    auto on = part(context.scene, flip.on);
    if (!on) {
        return tl::make_unexpected(on.error());
    }
    const auto elements = find_elements(**on, {flip.element}, context.symmetry(flip.symmetric), context.element());
    if (!elements) {
        return tl::make_unexpected(elements.error());
    }
    auto flipped = flip_elements((*on)->surface, context.element(), *elements);
    if (!flipped) {
        return tl::make_unexpected(flipped.error());
    }
    (*on)->embedding = embed_in_place(*flipped, context.element(), context.embedding);
    (*on)->surface = std::move(*flipped);
    return {};
}

bool is_symmetric(const Operation& operation)
{
    return std::visit(
        [](const auto& op) {
            if constexpr (requires { op.symmetric; }) {
                return op.symmetric;
            } else {
                return false;
            }
        },
        operation);
}

std::string text(const Vec3& p)
{
    return "(" + to_fixed(p.x(), 0) + ", " + to_fixed(p.y(), 0) + ", " + to_fixed(p.z(), 0) + ")";
}

struct Describe
{
    std::string operator()(const Place& op) const { return "place " + op.shape + " as " + op.id; }
    std::string operator()(const Merge& op) const { return "merge " + op.on + " with " + op.with; }
    std::string operator()(const Extrude& op) const
    {
        return "extrude " + op.brush + " from " + op.on + " by " + text(op.by) + " mm";
    }
    std::string operator()(const Open& op) const
    {
        return "open " + std::to_string(op.elements.size()) + " of " + op.on +
               (op.purpose.empty() ? "" : ": " + op.purpose);
    }
    std::string operator()(const Flip& op) const { return "flip an element of " + op.on; }
    std::string operator()(const Layout& op) const
    {
        return "lay out " + std::to_string(op.elements.size()) + " elements as " + op.id;
    }
    std::string operator()(const Import& op) const
    {
        return "import " + std::to_string(op.quads.size()) + " elements as " + op.id;
    }
};

} // namespace

std::string describe(const Operation& operation)
{
    return std::visit(Describe(), operation);
}

Expected<void> carry_out(const Operation& operation, const Design& design, const EmbedOptions& embedding, Scene& scene)
{
    if (auto ok = check_symmetric(design, is_symmetric(operation)); !ok) {
        return ok;
    }
    const Context context{design, embedding, scene};
    auto done = std::visit([&](const auto& op) { return run(op, context); }, operation);
    ++scene.operations;
    return done;
}

Expected<Surface> whole(const Scene& scene)
{
    expects(!scene.parts.empty(), "whole: the scene has a part");
    SurfaceLists all = lists(scene.parts.front().surface);
    for (std::size_t i = 1; i < scene.parts.size(); ++i) {
        const SurfaceLists more = lists(scene.parts[i].surface);
        const int vertices = static_cast<int>(all.positions.size());
        const int components = static_cast<int>(all.components.size());
        all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
        all.sides.insert(all.sides.end(), more.sides.begin(), more.sides.end());
        all.facing.insert(all.facing.end(), more.facing.begin(), more.facing.end());
        all.serial.insert(all.serial.end(), more.serial.begin(), more.serial.end());
        all.components.insert(all.components.end(), more.components.begin(), more.components.end());
        for (const int c : more.component) {
            all.component.push_back(c + components);
        }
        for (Quad q : more.quads) {
            std::transform(q.begin(), q.end(), q.begin(), [&](int v) { return v + vertices; });
            all.quads.push_back(q);
        }
    }
    return make_surface(all);
}

} // namespace rhombloom
