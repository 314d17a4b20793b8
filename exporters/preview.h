#pragma once

#include <optional>

#include "core/building/assembly_plan.h"
#include "core/design/mesh_import/triangle_mesh.h"
#include "exporters/save.h"
#include "exporters/thumbnail.h"

namespace rhombloom {

struct PreviewOptions
{
    std::string title;
    double tolerance_mm = 0.05;                 //!< largest distance of a decoded point from its place, 0.001 to 5
    LampLook lamp = LampLook::Off;              //!< On: warm emission in the 3D files, a lit thumbnail
    int thumbnail_size = 768;                   //!< pixels
    Background background = Background::Studio; //!< of the thumbnail
    std::optional<HookParameters> hooks;        //!< the default ones for the element when not given
    std::optional<TriangleMesh> target;         //!< of an import, mm: a scene in preview-plain.glb, a key in the page
};

//! How preview.glb holds the elements.
enum class PreviewEncoding
{
    BendingModes, //!< one Draco element with morph targets, one node per element
    Merged        //!< one Draco mesh per side with an element number per point
};

struct PreviewReport
{
    BendingReport bending;
    PreviewEncoding encoding = PreviewEncoding::Merged;
    int modes = 0;                    //!< bending modes used, 0 when merged
    double max_position_error_mm = 0; //!< of preview.glb's points as a viewer decodes them
    double html_position_error_mm = 0;
    std::size_t glb_bytes = 0;
    std::size_t plain_bytes = 0;
    std::size_t html_bytes = 0;
    std::size_t thumbnail_bytes = 0;
};

//! \brief preview.glb, preview-plain.glb, preview.html and thumbnail.png; with a target also target.png.
struct PreviewFiles
{
    FileSet files;
    PreviewReport report;
};

//! \brief The 3D previews of an embedded design.
//! \details glTF in metres, y up, materials "front" and "flipped", an element per node named "E001" ... (face number +
//! 1) with `step`, `side` and `component` in its extras. preview-plain.glb uses no extension and opens anywhere;
//! preview.glb needs KHR_draco_mesh_compression. Deterministic. Refuses a tolerance or size out of range.
Expected<PreviewFiles> preview_files(const Replay& replay, const AssemblyPlan& plan, const Element& element,
                                     const PreviewOptions& options = {});

} // namespace rhombloom
