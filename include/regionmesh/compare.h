// Distances between two labelled surfaces: as a whole, by region, by interface and by line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "regionmesh/check.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/statistics.h"

namespace regionmesh {

/// One model of a comparison. Holds references.
struct ComparedMesh {
    const Mesh& mesh;
    const LabelTable& labels;
};

struct CompareOptions {
    std::uint64_t samples = 1'000'000;      // on the faces of each model; its lines get a tenth of that
    std::vector<InputLabel> background{0};  // not compared as regions; their faces with the exterior are ignored
    bool vertex_distances = false;          // fill CompareReport::vertex_distances
    std::uint32_t threads = 0;              // 0: one per core. The result does not depend on it
};

/// Distances from samples on A to B, from samples on B to A, and of both sets together, weighted by area or length (so
/// `max` is the larger of the two). Null where one model lacks this region, interface or line.
struct TwoSidedDistance {
    std::optional<DistanceStatistics> a_to_b, b_to_a, both;
};

/// The boundary of a region in A and in B. A measure is null where that model lacks the region.
struct RegionComparison {
    Label label = 0;
    std::array<std::optional<RegionReport>, 2> measures;  // in A and B; `label` is the common one
    TwoSidedDistance distance;
};

/// An interface (two labels) or a line (three or more) in A and the one with the same labels in B.
struct StratumComparison {
    std::vector<Label> labels;                      // ascending; the exterior last, in a line once per side of the box
    std::array<std::optional<double>, 2> measures;  // area or length in A and B
    TwoSidedDistance distance;
};

struct CompareReport {
    LabelTable labels;  // of both models, ascending; the labels below are its dense labels, or exterior(0)
    std::array<std::uint64_t, 2> faces{}, vertices{};
    TwoSidedDistance distance;  // of the whole surfaces, without regard to labels
    std::vector<RegionComparison> regions;
    std::vector<StratumComparison> interfaces, lines;
    std::array<QualityReport, 2> quality;
    std::vector<double> vertex_distances;  // by vertex id of A, to the whole surface of B; empty unless asked for, and
                                           // where B has no faces
};

/// Compares by sampling. Labels correspond when they are equal in the input. The result does not depend on the number
/// of threads. docs/compare.md has the method and its cost.
CompareReport compare(const ComparedMesh& a, const ComparedMesh& b, const CompareOptions& options = {});

}  // namespace regionmesh
