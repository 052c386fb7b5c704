// The last stages, on the finished mesh: smooth lines, improve faces, preserve volumes, check.
#pragma once

#include <optional>

#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"
#include "stream/run_log.h"

namespace regionmesh {

/// Makes lines smoother, where the options ask for it.
void smooth_lines(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log);

/// Makes faces better, where the options ask for it.
void remesh_faces(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log);
void improve_faces(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log);

/// Gives the regions the volumes that they had before smoothing and decimation, where the options ask for it.
void restore_volumes(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log);

/// Checks the mesh as it will be written, and compares it with the samples of the source.
void check_result(Reconstruction& result, FaceSource& source, std::optional<LabelOracle> oracle,
                  const ReconstructOptions& options, RunLog& log);

}  // namespace regionmesh
