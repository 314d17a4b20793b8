#include "exporters/kit.h"

#include <future>
#include <mutex>

#include "core/building/bulb_hatch.h"
#include "core/design/mesh_import/import_warning.h"
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

//! Tells what is being made, from whichever thread makes it.
void tell(const KitOptions& options, const std::string& what)
{
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    if (options.progress) {
        options.progress(what);
    }
}

void warn_of_imports(const Design& design, const Element& element, Kit& kit)
{
    for (const Operation& operation : design.operations) {
        const auto* import = std::get_if<Import>(&operation);
        const std::string far = import != nullptr ? distance_warning(*import, element) : std::string();
        if (!far.empty()) {
            kit.warnings.push_back(far);
        }
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

Expected<void> add_booklet(Kit& kit, const Design& design, const Replay& replay, const AssemblyPlan& plan,
                           const Piece& piece, const KitOptions& options)
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
    preview.thumbnail_size = 512; // enough for a mail or a list of designs
    preview.lamp = options.lamp;
    preview.hooks = piece.parameters.hook;
    preview.target = options.target;
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
    auto made = hook_files(piece.parameters, design.title);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    add(kit.files, std::move(*made));
    return {};
}

//! What a maker needs at the table: sheets, then the booklet, whose cover names them.
Expected<void> add_paper(Kit& kit, const Design& design, const Replay& replay, const AssemblyPlan& plan,
                         const Piece& piece, const KitOptions& options)
{
    if (options.parts.contains(KitPart::Cut)) {
        if (auto ok = add_cut(kit, piece, options); !ok) {
            return ok;
        }
    }
    return options.parts.contains(KitPart::Booklet) ? add_booklet(kit, design, replay, plan, piece, options)
                                                    : Expected<void>{};
}

Expected<void> add_models(Kit& kit, const Design& design, const Replay& replay, const AssemblyPlan& plan,
                          const Piece& piece, const KitOptions& options)
{
    if (options.parts.contains(KitPart::Preview)) {
        if (auto ok = add_preview(kit, design, replay, plan, piece, options); !ok) {
            return ok;
        }
    }
    return options.parts.contains(KitPart::Hooks) ? add_hooks(kit, design, piece, options) : Expected<void>{};
}

//! Paper and models know nothing of each other: each on its own thread, into its own kit, then put together.
Expected<void> add_parts(Kit& kit, const Design& design, const Replay& replay, const AssemblyPlan& plan,
                         const Piece& piece, const KitOptions& options)
{
    Kit models;
    auto models_made =
        std::async(std::launch::async, [&] { return add_models(models, design, replay, plan, piece, options); });
    const auto paper_made = add_paper(kit, design, replay, plan, piece, options);
    const auto models_ok = models_made.get();
    add(kit.files, std::move(models.files));
    return paper_made ? models_ok : paper_made;
}

} // namespace

Expected<void> check_names(const Design& design, const KitOptions& options)
{
    return options.parts.contains(KitPart::Booklet) ? check_booklet_names(design) : Expected<void>{};
}

Expected<Kit> make_kit(const Design& design, const Replay& replay, const Piece& piece, const KitOptions& options)
{
    if (auto ok = check_names(design, options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const Buildability build = buildability(replay, piece);
    if (!build.ok()) {
        return refuse(build.problems.front() + (build.problems.size() > 1 ? " (rhombloom check tells more)" : ""));
    }
    Kit kit;
    kit.warnings = build.warnings;
    warn_of_imports(design, piece.element, kit);
    tell(options, "assembly plan");
    const AssemblyPlan plan = design_plan(design, replay, piece.element, options.order);
    kit.scorecard = plan.scorecard;
    kit.files["surface.json"] = surface_json(replay.surface, piece.element, replay.embedding);
    if (auto ok = add_parts(kit, design, replay, plan, piece, options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const std::vector<BulbFit> bulbs = bulbs_in_middle(replay.surface);
    const Summary summary{design.title, piece, build, kit.cut, kit.scorecard, kit.warnings, options, design, bulbs};
    kit.files["README.txt"] = readme_text(summary, kit.files);
    kit.files["kit.json"] = manifest_json(summary, kit.files);
    return kit;
}

} // namespace rhombloom
