// Distances between two labelled surfaces: as a whole, by region, by interface and by line.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "regionmesh/check.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

struct MeshPart;  // src/mesh/mesh_part.h

/// A model to compare: a mesh (ComparedMesh), or one that memory does not hold at once and that is read part by part
/// (open_block_folder() in blocks.h).
class ComparedModel {
public:
    virtual ~ComparedModel() = default;
    virtual const LabelTable& labels() const = 0;
    virtual std::uint64_t face_count() const = 0;
    virtual std::uint64_t vertex_count() const = 0;
    /// Whether the model distinguishes the sides of the box: it has no exterior faces, or vertices with sides.
    virtual bool has_sides() const = 0;
    virtual std::uint32_t part_count() const = 0;
    /// Calls visit with a mesh and what of it belongs to a part; nullptr: all. The mesh has all faces at the vertices
    /// of the part, and its vertices are numbered in an order that is the same in all parts.
    virtual void read(std::uint32_t part, const std::function<void(const Mesh&, const MeshPart*)>& visit) const = 0;
    /// What check() reports of the whole.
    virtual CheckReport measure(const CheckOptions& options) const = 0;
};

/// A mesh in memory, one part. Holds references. Throws Error(kInput) for a table that lacks a label of the mesh.
class ComparedMesh final : public ComparedModel {
public:
    ComparedMesh(const Mesh& mesh, const LabelTable& labels);
    const LabelTable& labels() const override { return labels_; }
    std::uint64_t face_count() const override { return mesh_.face_count(); }
    std::uint64_t vertex_count() const override { return mesh_.vertex_count(); }
    bool has_sides() const override;
    std::uint32_t part_count() const override { return 1; }
    void read(std::uint32_t, const std::function<void(const Mesh&, const MeshPart*)>& visit) const override {
        visit(mesh_, nullptr);
    }
    CheckReport measure(const CheckOptions& options) const override { return check(mesh_, options); }

private:
    const Mesh& mesh_;
    const LabelTable& labels_;
};

struct CompareOptions {
    std::uint64_t samples = 1'000'000;      // samples on the faces of each mesh; a tenth of this on its lines
    std::vector<InputLabel> background{0};  // no regions; their faces to the exterior are left out
    bool vertex_distances = false;          // fill CompareReport::vertex_distances; A has to be a ComparedMesh
    std::uint32_t threads = 0;              // 0: one per core; the result does not depend on it
};

/// Sampled distances, in the unit of the coordinates, weighted by the area or length that each sample stands for.
struct DistanceStatistics {
    std::uint64_t samples = 0;
    double rms = 0, mean = 0;
    double max = 0;          // largest at samples: the surface may be farther away between them
    double quantile_95 = 0;  // the smallest sampled distance not exceeded on 95 % of the area or length
};

/// Distances of samples on A to B, of samples on B to A, and of both together, each weighted by its area or length
/// (`max` is the larger of both). nullopt if A or B has no such part.
struct TwoSidedDistance {
    std::optional<DistanceStatistics> a_to_b, b_to_a, both;
};

/// The boundary of a region in A compared with that in B. nullopt where the region is missing.
struct RegionComparison {
    Label label = 0;
    std::array<std::optional<RegionReport>, 2> measures;  // values in A and B; `label`: CompareReport::labels
    TwoSidedDistance distance;
};

/// An interface (two labels) or a line (three or more) in A compared with the one with the same labels in B.
struct StratumComparison {
    std::vector<Label> labels;                      // ascending; the exterior last, in lines once per side
    std::array<std::optional<double>, 2> measures;  // area or length in A and B
    TwoSidedDistance distance;
};

struct CompareReport {
    LabelTable labels;  // labels of both meshes, ascending: labels below are its dense labels, or exterior(0)
    std::array<std::uint64_t, 2> faces{}, vertices{};
    TwoSidedDistance distance;  // distance of the whole surfaces, regardless of labels
    std::vector<RegionComparison> regions;
    std::vector<StratumComparison> interfaces, lines;
    std::array<QualityReport, 2> quality;
    std::vector<double> vertex_distances;  // per vertex id of A, to the surface of B; if asked for and B has faces
};

/// Compares by sampling (src/compare/sample.h); labels correspond if they are equal in the input. Deterministic for any
/// number of threads. Holds the samples and one part of each model. The nearest faces and lines are those of the whole
/// model, however it is divided; the samples of a model differ from those of the same model in other parts. Cost:
/// docs/how-to/compare.md. Throws what reading a part throws.
CompareReport compare(const ComparedModel& a, const ComparedModel& b, const CompareOptions& options = {});
CompareReport compare(const ComparedMesh& a, const ComparedMesh& b, const CompareOptions& options = {});

}  // namespace regionmesh
