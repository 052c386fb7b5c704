// Shapes of faces and edges that matter to a volume mesher, as histograms.
#pragma once

#include <array>
#include <cstdint>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// A histogram with bins of one width; what is below the first or beyond the last counts there.
template <std::size_t kBins>
struct Histogram {
    double first = 0, width = 1;  // where the first bin begins, and how wide each is
    std::array<std::uint64_t, kBins> counts{};

    void add(double value) {
        const double bin = (value - first) / width;
        ++counts[bin >= kBins - 1 ? kBins - 1 : bin > 0 ? static_cast<std::size_t>(bin) : 0];
    }
    void append(const Histogram& other) {
        for (std::size_t n = 0; n < kBins; ++n) counts[n] += other.counts[n];
    }
};

/// All are 0 for a mesh without faces.
struct ShapeReport {
    double unit = 0;  // edge of an equilateral face of mean area (typical_edge)
    double shortest_edge = 0, longest_edge = 0;
    double least_dihedral = 0;          // angle inside a region between two faces at an edge, in degrees
    double largest_ratio = 0;           // of the longest edge at a vertex over the shortest
    std::uint32_t largest_valence = 0;  // edges at a vertex

    Histogram<31> lengths{0, 0.1};   // of edges, in units
    Histogram<36> dihedrals{0, 10};  // in degrees: one for each region at each edge
    Histogram<19> ratios{1, 0.5};    // of edges at each vertex
    Histogram<41> valences{0, 1};    // of vertices
};

/// Measures all edges and vertices, on at most `threads` threads (0: one per core); the report does not depend on it.
ShapeReport measure_shapes(const Mesh& mesh, std::uint32_t threads = 0);

}  // namespace regionmesh
