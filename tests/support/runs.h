// Runs of the whole pipeline, as short as a test wants them.
#pragma once

#include <gtest/gtest.h>

#include "mesh/alive.h"
#include "regionmesh/reconstruct.h"
#include "support/meshes.h"
#include "support/volumes.h"

namespace regionmesh::test {

/// Fails and says what was found, unless there are no violations.
inline void expect_sound(const CheckReport& report) {
    EXPECT_EQ(report.violation_count(), 0u);
    for (std::size_t n = 0; n < std::min<std::size_t>(report.violations.size(), 5); ++n)
        ADD_FAILURE() << to_string(report.violations[n].kind) << ": " << report.violations[n].text;
}

/// The paper's tetrahedra; all labels are regions, nothing is smoothed or decimated.
inline ReconstructOptions plain() {
    return {.cells = CellKind::kTetrahedra, .smooth = {.passes = 0}, .decimate = false, .background = {}};
}

/// The same, and this share of the faces goes.
inline ReconstructOptions reduced(double share) {
    return {.reduce = share, .cells = CellKind::kTetrahedra, .smooth = {.passes = 0}, .background = {}};
}

/// From the first section, whatever was read before.
inline Reconstruction run(ArrayVolume& volume, const ReconstructOptions& options = plain()) {
    volume.rewind();
    return reconstruct(volume, options);
}
inline Reconstruction run(ArrayVolume&& volume, const ReconstructOptions& options = plain()) {
    return run(volume, options);
}

/// Along z unless the options say another sweep.
inline Reconstruction run(ArrayMesh mesh, ReconstructOptions options = plain()) {
    if (!options.sweep) options.sweep = kSweepZ;
    return reconstruct(mesh, options);
}

/// The filters that move vertices by their neighbours; the lattice filter moves them within their cells.
inline constexpr SmoothFilter kVertexFilters[] = {SmoothFilter::kTaubin, SmoothFilter::kLaplacian,
                                                  SmoothFilter::kNifpms};

using regionmesh::for_faces;
using regionmesh::for_vertices;

}  // namespace regionmesh::test
