// The pipeline behind reconstruct(), for any source of faces.
#pragma once

#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"
#include "stream/run_log.h"

namespace regionmesh {

/// Meshes, smooths, simplifies and checks the surface of a source. Throws Error(kInput) where --memory cannot be kept,
/// and where smoothing has to begin again but the source cannot; and what `on_model` throws.
Reconstruction reconstruct(FaceSource& source, const ReconstructOptions& options, const OnProgress& on_progress = {},
                           const OnModel& on_model = {});

}  // namespace regionmesh
