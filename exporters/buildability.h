#pragma once

#include <optional>

#include "core/design/history.h"
#include "core/model/element_stretch.h"
#include "exporters/hook_checks.h"
#include "exporters/materials.h"
#include "exporters/parameter_table.h"

namespace rhombloom {

//! \brief A design with the material and the hook it is to be cut with.
struct Piece
{
    Element element; //!< the design's, with the thickness of the material that
                     //!< was asked for
    PieceParameters parameters;
    Material material;
    double stretch_limit = usual_stretch_limit; //!< largest stretch of an element that is let pass
    std::vector<std::string> notes;             //!< what the user should know about the choice
};

//! \brief Choose the material (by name, or the polypropylene nearest to the
//! design's thickness) and set the hook.
Expected<Piece> make_piece(const Element& element, const std::optional<std::string>& material_name,
                           const std::vector<ParameterSetting>& settings);

//! \brief Can it be built? Everything `rhombloom check` tells.
struct Buildability
{
    int elements = 0;
    int flipped = 0;
    int boundary_loops = 0;
    int euler_characteristic = 0;
    DefectRange defects; //!< radians
    EmbedReport embedding;
    std::vector<HookCheck> hooks;
    std::vector<std::string> problems; //!< it cannot be built: one sentence each
    std::vector<std::string> warnings; //!< it can, but mind this

    bool ok() const { return problems.empty(); }
};

Buildability buildability(const Replay& replay, const Piece& piece);

} // namespace rhombloom
