// Counts labels, samples, faces and topological invariants of a volume or of tetrahedra without building the mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "regionmesh/label_oracle.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

struct Census {
    LabelTable labels;
    std::vector<std::uint64_t> samples;      // one per dense label
    std::uint64_t face_count = 0;            // face count of the unsimplified mesh
    std::vector<std::uint64_t> strip_faces;  // the same by strip
    LabelOracle oracle;
};

struct TetrahedronCensus {
    LabelTable labels;
    std::uint64_t point_count = 0, tetrahedron_count = 0;
    std::vector<std::uint64_t> samples;  // one per dense label: points, or tetrahedra if these have the labels
    double spacing = 0;                  // edge of a cube with the volume of six mean tetrahedra, z scaled
    Sweep sweep;
    std::uint64_t face_count = 0;  // face count of the unsimplified mesh
    LabelOracle oracle;
};

struct CensusOptions {
    bool cap = true;                        // cap as in ReconstructOptions
    std::vector<InputLabel> background{0};  // background as in ReconstructOptions
    std::optional<Sweep> sweep = {};        // sweep of tetrahedra
    CellKind cells = CellKind::kCompact;    // cells of sections; kAuto counts as kCompact
    std::uint32_t threads = 1;              // 0: one per core. On two a section is read while the one before is counted
    std::function<void(std::uint32_t strips)> on_strip = {};  // called after each pair of sections that was counted
};

/// Reads all sections. Throws Error(kInput) for a volume with fewer than two samples along an axis, and what the reader
/// throws.
Census count_labels(SectionReader& reader, const CensusOptions& options = {});

/// Reads all tetrahedra. Throws the same errors as reconstruct().
TetrahedronCensus count_labels(TetrahedronReader& reader, const CensusOptions& options = {});

/// An empty table for the labels of a volume.
LabelTable table_for(const VolumeInfo& volume);

/// Gives background labels the first dense numbers, before the volume is read.
std::vector<Label> dense_background(const std::vector<InputLabel>& background, LabelTable& labels);

}  // namespace regionmesh
