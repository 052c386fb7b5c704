// What the sections hold, counted without making a face.
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
    std::uint64_t face_count = 0;            // of the unsimplified model
    std::vector<std::uint64_t> strip_faces;  // the same, strip by strip
    LabelOracle oracle;
};

struct CensusOptions {
    bool cap = true;                        // as ReconstructOptions has it
    std::vector<InputLabel> background{0};  // the same
    std::optional<Sweep> sweep = {};        // of tetrahedra
};

/// Reads all sections and counts.
Census count_labels(SectionReader& reader, const CensusOptions& options = {});

/// An empty table for the labels of a volume.
LabelTable table_for(const VolumeInfo& volume);

/// Background labels known before reading get the first dense numbers.
std::vector<Label> dense_background(const std::vector<InputLabel>& background, LabelTable& labels);

}  // namespace regionmesh
