// What tetrahedra hold, counted by making their faces.
#pragma once

#include "regionmesh/census.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

struct TetrahedronCensus {
    LabelTable labels;
    std::uint64_t point_count = 0, tetrahedron_count = 0;
    std::vector<std::uint64_t> samples;  // by dense label: points, or tetrahedra where they have the labels
    double spacing = 0;                  // edge of a cube that six of them fill on average, z scaled
    Sweep sweep;
    std::uint64_t face_count = 0;  // of the unsimplified model
    LabelOracle oracle;
};

/// Reads all tetrahedra and counts. Throws what reconstruct() does.
TetrahedronCensus count_labels(TetrahedronReader& reader, const CensusOptions& options = {});

}  // namespace regionmesh
