// Edges of one wanted length: the same surface with faces that are nearly equilateral and of one size.
#pragma once

#include <cstdint>
#include <functional>

#include "regionmesh/mesh.h"
#include "regionmesh/promises.h"

namespace regionmesh {

struct RemeshOptions {
    Promises promises = {};     // without samples and a largest error: the bound rises by kRemeshError of the length
    double edge_length = 0;     // wanted, without scale_z; above 0
    std::uint32_t sweeps = 10;  // most sweeps of splits, collapses, flips and moves
    std::function<void()> on_progress = {};  // called now and then, on the calling thread
};

/// Share of the wanted length by which the error bound may rise where neither samples nor a largest error hold the
/// surface.
inline constexpr double kRemeshError = 0.5;

/// Edges count as of the wanted length L from 0.7 L to 1.4 L.
inline constexpr double kLeastOfLength = 0.7, kMostOfLength = 1.4;

/// The lengths of all edges of a mesh; all are 0 for a mesh without faces.
struct EdgeLengths {
    std::uint64_t edges = 0, wanted = 0;  // and how many of them are of the wanted length
    double mean = 0, least = 0, largest = 0;

    double share() const { return edges > 0 ? static_cast<double>(wanted) / static_cast<double>(edges) : 0; }
};

struct RemeshResult {
    std::uint64_t splits = 0, collapses = 0, flips = 0, moves = 0;
    std::uint32_t sweeps = 0;
    EdgeLengths before, after;
    double error_bound = 0;  // of simplify() and this together (SimplifyResult)
};

/// Brings all edges near the wanted length L (isotropic remeshing, Botsch and Kobbelt 2004): edges longer than 4/3 L
/// are split, those shorter than 4/5 L collapsed, edges inside interfaces flipped toward six faces at each vertex, and
/// vertices moved within their interface, along their line. Each step keeps the promises: no violation is added, strata
/// stay, lines and edges of the box are divided like the rest, and vertices stay on their sides of the box; edges stay
/// shorter where regions or samples leave no room. Deterministic. Requires that every vertex that is not fixed has all
/// its faces in the mesh. Renumbers vertices and faces. Throws Error(kUsage) for a length out of range, and what
/// simplify() throws.
RemeshResult remesh(Mesh& mesh, const RemeshOptions& options);

}  // namespace regionmesh
