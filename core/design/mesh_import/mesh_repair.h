#pragma once

#include <functional>
#include <string>

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

//! \brief A closed, connected, oriented manifold and what had to be done to get it.
struct RepairedMesh
{
    MeshTree tree;
    std::vector<std::string> repairs; //!< for people, one sentence each; empty when the mesh was sound
};

struct RepairOptions
{
    //! Elements that the result is meant for: detail far below an element may get lost where a mesh has to be wrapped.
    int elements = 600;
    //! Told what is being done; false stops. Empty: nobody listens.
    std::function<bool(const std::string&)> progress;
};

//! \brief Make of a mesh from anywhere one that can be remeshed.
//! \details Points that are not finite, degenerate and duplicate triangles are dropped, equal points welded, triangles
//! turned to agree, holes closed. Where shells cross each other, more than two triangles share an edge, or a surface
//! crosses itself, the solid is wrapped anew (mesh_wrap.h). Refuses one-sided surfaces, open sheets, several solids of
//! similar size, and meshes that enclose nothing.
Expected<RepairedMesh> repair(const TriangleMesh& mesh, const RepairOptions& options);

} // namespace rhombloom
