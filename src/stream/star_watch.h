// Finds vertices round which a surface that comes in strips is not generic.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "cells/tetrahedron_mesher.h"
#include "check/generic_star.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Meshes may touch themselves, and where tetrahedra have the labels any number of regions may meet at a node. Such
/// vertices are pinned, as fix_unsound() does in a model that is whole. Holds the faces of vertices that have not
/// ended.
class StarWatch {
public:
    explicit StarWatch(const StripOptions& options);

    void add(const MeshedStrip& strip);
    /// Pins those of the vertices ended whose stars are not generic. All their faces must have been added.
    void judge(std::span<VertexEnd> ended);

private:
    /// Begins anew with the faces that somebody still needs, once most are not.
    void pack();

    CheckOptions options_;
    Mesh mesh_;
    std::unordered_map<std::uint32_t, VertexId> ids_;  // of vertices that have not been forgotten
    std::vector<std::uint32_t> numbers_;               // by id
    std::vector<bool> is_judged_;                      // by id
    std::uint32_t judged_ = 0;
};

}  // namespace regionmesh
