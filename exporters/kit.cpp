#include "exporters/kit.h"

#include "exporters/booklet.h"
#include "exporters/manifest.h"
#include "exporters/preview.h"
#include "exporters/scad.h"
#include "exporters/surface_file.h"

namespace rhombloom {

namespace {

void add(FileSet& files, FileSet more)
{
    files.merge(std::move(more));
}

void tell(const KitOptions& options, const std::string& what)
{
    if (options.progress) {
        options.progress(what);
    }
}

CutOptions cut_options(const Piece& piece, const KitOptions& options)
{
    CutOptions cut = options.cut;
    cut.kerf_x = piece.parameters.kerf.x;
    cut.kerf_y = piece.parameters.kerf.y;
    cut.density = piece.material.density;
    cut.paper = options.paper;
    cut.notes.push_back("material: " + piece.material.name);
    return cut;
}

Expected<void> add_cut(Kit& kit, const Piece& piece, const KitOptions& options)
{
    tell(options, "nesting and cut sheets");
    auto made =
        cut_files(piece.element, piece.parameters.hook, kit.scorecard.parts_needed, cut_options(piece, options));
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    add(kit.files, std::move(made->files));
    kit.cut = std::move(made->report);
    kit.warnings.insert(kit.warnings.end(), kit.cut.warnings.begin(), kit.cut.warnings.end());
    return {};
}

Expected<void> add_booklet(Kit& kit, const Design& design, const Replay& replay, AssemblyPlan& plan, const Piece& piece,
                           const KitOptions& options)
{
    tell(options, "booklet");
    BookletOptions booklet;
    booklet.paper = options.paper;
    booklet.sheets = kit.cut.sheets;
    booklet.material = piece.material.title;
    auto made = booklet_files(design, replay, plan, booklet);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    add(kit.files, std::move(made->files));
    kit.scorecard.view_turns = made->report.view_turns;
    return {};
}

Expected<void> add_preview(Kit& kit, const Design& design, const Replay& replay, const AssemblyPlan& plan,
                           const Piece& piece, const KitOptions& options)
{
    tell(options, "preview");
    PreviewOptions preview;
    preview.title = design.title;
    preview.lamp = options.lamp;
    auto made = preview_files(replay, plan, piece.element, preview);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    add(kit.files, std::move(made->files));
    return {};
}

Expected<void> add_hooks(Kit& kit, const Design& design, const Piece& piece, const KitOptions& options)
{
    tell(options, "OpenSCAD templates");
    auto made = hook_files(piece.parameters.hook, design.title);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    add(kit.files, std::move(*made));
    return {};
}

Expected<void> add_parts(Kit& kit, const Design& design, const Replay& replay, AssemblyPlan& plan, const Piece& piece,
                         const KitOptions& options)
{
    const auto wanted = [&](KitPart part) { return options.parts.contains(part); };
    Expected<void> ok;
    ok = wanted(KitPart::Cut) ? add_cut(kit, piece, options) : ok;
    ok = ok && wanted(KitPart::Booklet) ? add_booklet(kit, design, replay, plan, piece, options) : ok;
    ok = ok && wanted(KitPart::Preview) ? add_preview(kit, design, replay, plan, piece, options) : ok;
    return ok && wanted(KitPart::Hooks) ? add_hooks(kit, design, piece, options) : ok;
}

} // namespace

Expected<Kit> make_kit(const Design& design, const Replay& replay, const Piece& piece, const KitOptions& options)
{
    const Buildability build = buildability(replay, piece);
    if (!build.ok()) {
        return refuse(build.problems.front() + (build.problems.size() > 1 ? " (rhombloom check tells more)" : ""));
    }
    Kit kit;
    kit.warnings = build.warnings;
    tell(options, "assembly plan");
    AssemblyPlan plan = assembly_plan(replay, piece.element, options.order);
    kit.scorecard = plan.scorecard;
    kit.files["surface.json"] = surface_json(replay.surface, piece.element, replay.embedding);
    if (auto ok = add_parts(kit, design, replay, plan, piece, options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const Summary summary{design.title, piece, build, kit.cut, kit.scorecard, kit.warnings, options};
    kit.files["README.txt"] = readme_text(summary, kit.files);
    kit.files["kit.json"] = manifest_json(summary, kit.files);
    return kit;
}

} // namespace rhombloom
