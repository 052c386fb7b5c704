// Counts labels, faces and invariants of tetrahedra, by making their faces.
#pragma once

#include "regionmesh/census.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

struct TetrahedronCensus {
    LabelTable labels;
    std::uint64_t point_count = 0, tetrahedron_count = 0;
    std::vector<std::uint64_t> samples;  // by dense label: of points, or of tetrahedra where these have the labels
    double spacing = 0;                  // edge length of a cube that six average tetrahedra fill, z scaled
    Sweep sweep;
    std::uint64_t face_count = 0;  // before simplification
    LabelOracle oracle;
};

/// Reads all tetrahedra and counts. Throws the same errors as reconstruct().
TetrahedronCensus count_labels(TetrahedronReader& reader, const CensusOptions& options = {});

}  // namespace regionmesh
