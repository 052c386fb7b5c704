// Counts labels, faces and invariants of sections, without making a face.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regionmesh/label_oracle.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

struct Census {
    LabelTable labels;
    std::vector<std::uint64_t> samples;      // by dense label
    std::uint64_t face_count = 0;            // before simplification
    std::vector<std::uint64_t> strip_faces;  // the same, by strip
    LabelOracle oracle;
};

struct CensusOptions {
    bool cap = true;                        // as in ReconstructOptions
    std::vector<InputLabel> background{0};  // likewise
    std::optional<Sweep> sweep = {};        // of tetrahedra
};

/// Reads all sections and counts.
Census count_labels(SectionReader& reader, const CensusOptions& options = {});

/// An empty table for the labels of a volume.
LabelTable table_for(const VolumeInfo& volume);

/// Gives the background labels the first dense numbers, in their order, and returns these.
std::vector<Label> dense_background(const std::vector<InputLabel>& background, LabelTable& labels);

}  // namespace regionmesh
