// How far are two labelled surfaces apart: as a whole, region by region, interface by interface, line by line?
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

/// What is compared. Refers to both.
struct ComparedMesh {
    const Mesh& mesh;
    const LabelTable& labels;
};

struct CompareOptions {
    std::uint64_t samples = 1'000'000;      // on the faces of each model; a tenth as many on its lines
    std::vector<InputLabel> background{0};  // no regions; their faces with the exterior count nowhere
    bool vertex_distances = false;          // make CompareReport::vertex_distances
    std::uint32_t threads = 0;              // at work at a time; 0: one per core. The result is the same
};

/// Distances of samples on A to B, of samples on B to A, and of all of them together, where each counts by its area or
/// length (so that `max` is the greater of both). Null where one of both has nothing of the kind.
struct TwoSidedDistance {
    std::optional<DistanceStatistics> a_to_b, b_to_a, both;
};

/// The boundary of a region in A against that in B. Null where it has none there.
struct RegionComparison {
    Label label = 0;
    std::array<std::optional<RegionReport>, 2> measures;  // in A and B; their `label` is the common one
    TwoSidedDistance distance;
};

/// An interface (two labels) or a line (three or more) in A against the one with the same labels in B.
struct StratumComparison {
    std::vector<Label> labels;                      // ascending; the exterior last, in a line once for each side
    std::array<std::optional<double>, 2> measures;  // area or length in A and B
    TwoSidedDistance distance;
};

struct CompareReport {
    LabelTable labels;  // of both models, as numbers ascending: the labels below are its dense ones, or exterior(0)
    std::array<std::uint64_t, 2> faces{}, vertices{};
    TwoSidedDistance distance;  // of the surfaces as a whole, whatever their labels
    std::vector<RegionComparison> regions;
    std::vector<StratumComparison> interfaces, lines;
    std::array<QualityReport, 2> quality;
    std::vector<double> vertex_distances;  // by vertex id of A, to the whole surface of B; where asked, and B has faces
};

/// Compares by sampling (see sample.h); labels correspond when they are equal in the input. Deterministic, on any
/// number of threads. Cost: see docs/compare.md.
CompareReport compare(const ComparedMesh& a, const ComparedMesh& b, const CompareOptions& options = {});

}  // namespace regionmesh
