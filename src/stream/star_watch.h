// Finds the vertices with a non-generic star in a surface that comes in strips.
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
/// vertices are pinned, as lock_violations() does in a whole mesh. Holds the faces of vertices that are not finalized.
class StarWatch {
public:
    explicit StarWatch(const StripOptions& options);

    void add(const MeshedStrip& strip);
    /// Pins the finalized vertices whose stars are not generic. All their faces must have been added.
    void judge(std::span<FinalizedVertex> finalized);

private:
    /// Drops the faces that are not needed any more, once these are the most.
    void pack();

    CheckOptions options_;
    Mesh mesh_;
    std::unordered_map<std::uint32_t, VertexId> ids_;  // of the vertices held
    std::vector<std::uint32_t> numbers_;               // by id
    std::vector<bool> is_judged_;                      // by id
    std::uint32_t judged_ = 0;
};

}  // namespace regionmesh
