#pragma once

#include <functional>
#include <optional>
#include <set>

#include "core/building/assembly_plan.h"
#include "core/design/mesh_import/triangle_mesh.h"
#include "exporters/buildability.h"
#include "exporters/cut_sheet.h"
#include "exporters/save.h"
#include "exporters/thumbnail.h"

namespace rhombloom {

enum class KitPart
{
    Cut,
    Booklet,
    Preview,
    Hooks
};

struct KitOptions
{
    std::set<KitPart> parts = {KitPart::Cut, KitPart::Booklet, KitPart::Preview, KitPart::Hooks};
    CutOptions cut; //!< kerf and density are taken from the piece
    Paper paper = Paper::A4;
    Order order = Order::Best;
    LampLook lamp = LampLook::Off;
    std::optional<TriangleMesh> target; //!< of an import, mm: shown beside and within the preview
    std::string program_version;
    //! Told what is being made. Empty: nobody listens.
    std::function<void(const std::string&)> progress;
};

struct Kit
{
    FileSet files; //!< relative to the kit's folder (DESIGN.md section 6)
    CutReport cut;
    Scorecard scorecard;
    std::vector<std::string> warnings;
};

//! \brief Refuses a design whose names the kit cannot write. Quick: to be asked before the design is replayed.
Expected<void> check_names(const Design& design, const KitOptions& options);

//! \brief Everything a person needs to make the design. Refuses a design that
//! cannot be built, with the reason.
Expected<Kit> make_kit(const Design& design, const Replay& replay, const Piece& piece, const KitOptions& options);

} // namespace rhombloom
