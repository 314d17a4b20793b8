#pragma once

#include "core/design/symmetry.h"
#include "core/form/embedding.h"
#include "core/model/base_shapes.h"

namespace rhombloom {

//! \brief Sweep a brush from a vertex of the target (Sec. 4.3).
struct ExtrudeRequest
{
    Vertex apex;
    Vec3 drag = Vec3::Zero(); //!< from the apex to where the new tip is wanted, mm
    std::string component;    //!< name of the new elements' part
    Symmetry symmetry;        //!< of the design; see \c all_images
    int candidate = 0;        //!< which of the candidates that settle is taken for the first period
    bool all_images = false;  //!< do the same at every image of the apex
    int first_serial = -1;    //!< of the added elements; -1: the one after the target's largest
};

//! \brief One way to join the brush to the target, with the numbers that ranked it.
struct ExtrudeCandidate
{
    int target_layers = 0;   //!< taken away round the apex; 0: the apex is opened
    int brush_layers = 0;    //!< kept round the brush's seed
    int size_difference = 0; //!< of the two loops before zipping
    double min_defect = 0;   //!< of the merged vertices and zipped valleys, radians
    double max_defect = 0;
    double tip_distance = 0; //!< predicted distance of the new tip from where the drag ends, mm
    double misfit = 0;       //!< rms distance of the merged vertices after the rigid alignment, mm
    double asymmetry = 0;    //!< rms distance of the added vertices from their images, mm; 0 off the plane or axis
    Graft change;
};

//! \brief The candidates, best first (Sec. 4.3): equal loops before zipped ones, then the largest minimum defect; ties
//! are decided by the design's symmetry and by how close the tip comes to the drag.
//! \details The loops are those between the layers of target and brush, the opened apex, the brush opened at its far
//! end and the brush's own opening. Candidates that would not add elements are left out. At most \p count are
//! returned; when there is none, the refusal says what was tried.
Expected<std::vector<ExtrudeCandidate>> extrude_candidates(const Surface& target, const Element& element,
                                                           const BaseShape& brush, const ExtrudeRequest& request,
                                                           int count = 12);

struct Extrusion
{
    Surface surface; //!< embedded, in the pose of the target
    EmbedReport embedding;
    std::vector<Vertex> tips;    //!< the vertices whose middle is the new tip: one, or the rim of an open brush
    Vec3 reached = Vec3::Zero(); //!< from the old apex to the new tip, mm
    int periods = 0;             //!< how often the brush was applied
    int next_serial = 0;         //!< the first serial not used yet
    ExtrudeCandidate first;      //!< the choice of the first period
};

//! \brief Extrude and embed. A drag longer than the brush repeats it at the new tip as long as that brings the tip
//! closer to the end of the drag.
//! \details Of the candidates the first is taken that embeds and follows the drag within 30 degrees, else the closest;
//! or, when the request names a rank, the one of that rank among those that settle.
Expected<Extrusion> extrude(const Surface& target, const Element& element, const BaseShape& brush,
                            const ExtrudeRequest& request, const EmbedOptions& embedding = {});

} // namespace rhombloom
