#pragma once

#include "exporters/bending_modes.h"
#include "exporters/draco_mesh.h"
#include "exporters/gltf.h"
#include "exporters/preview.h"

namespace rhombloom {

//! \brief What a viewer may tell about an element.
struct ElementLabel
{
    std::string name; //!< "E001"
    int step = 0;     //!< the step that inserts it, from 1; 0: the plan does not
    Facing facing = Facing::Front;
    int component = 0;
};

//! \brief The scene that every preview file shows.
struct PreviewModel
{
    BentSurface bent;
    BendingModes modes;               //!< of the bent elements
    std::vector<ElementLabel> labels; //!< by face number
    std::vector<std::string> components;
    double thickness = 0;
    std::string title;
    TriangleMesh ghost; //!< the target of an import in few triangles; empty without one
};

//! \brief Names, steps and sides of all elements.
std::vector<ElementLabel> element_labels(const Surface& surface, const AssemblyPlan& plan);

//! \brief step, side and component of an element as glTF extras.
nlohmann::ordered_json label_extras(const PreviewModel& model, const ElementLabel& label);

//! \brief A glTF node without data for every use: no extension, floats, one mesh per element.
std::string plain_glb(const PreviewModel& model, const PreviewOptions& options);

struct CompressedPreview
{
    std::string bytes;
    double max_error_mm = 0; //!< measured on the decoded mesh
    int modes = 0;
};

//! \brief Some elements of one side as one Draco mesh.
struct MergedPart
{
    Outward outward = Outward::Front;
    DracoMesh mesh; //!< what was compressed
    PointGrid grid;
    DracoStream stream;
};

struct MergedPreview
{
    std::string bytes;
    std::vector<MergedPart> parts;
};

//! \brief Draco meshes of up to 96 elements of one side, `_ELEMENT_ID` = face number on every point; the labels stand
//! in the node's extras.
Expected<MergedPreview> encoded_merged(const PreviewModel& model, const PreviewOptions& options);

//! \brief The largest distance of a point, decoded, from its place, mm. Refuses streams that do not read back.
Expected<double> decoded_error_mm(const std::vector<MergedPart>& parts);

//! \brief The file encoded and its error measured.
Expected<CompressedPreview> merged_glb(const PreviewModel& model, const PreviewOptions& options);

//! \brief One Draco element with bending modes as morph targets (and a last target that lays it flat); a node with
//! weights per element, grouped by component and side. Its error says whether the modes were enough.
Expected<CompressedPreview> modes_glb(const PreviewModel& model, const PreviewOptions& options);

} // namespace rhombloom
