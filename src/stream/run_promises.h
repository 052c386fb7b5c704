// What a run promises: the one place that completes the promises asked for with what is known of the surface.
#pragma once

#include "regionmesh/reconstruct.h"
#include "regionmesh/simplify.h"
#include "stream/face_source.h"

namespace regionmesh {

/// What is known of a surface that is decimated.
struct Ground {
    double scale = 1, scale_z = 1;        // as Promises has them
    std::optional<Lattice> samples = {};  // kept where the options say so
    std::optional<Box> box = {};          // round all merged vertices
    std::optional<Vec3> spacing = {};     // of the samples that the surface was made of
};

/// That of a run, before its model is placed in space.
Ground ground_of(const SourceShape& shape);

/// The lowest quality of the faces that decimation changes (docs/explanation/decimate.md, "Sections far apart").
double quality_bound(const ReconstructOptions& options, const Ground& ground);

Promises promises_of(const ReconstructOptions& options, const Ground& ground);

/// How these are kept: without a target.
SimplifyOptions simplify_options(const ReconstructOptions& options, const Promises& promises);

/// How a surface of this scale is smoothed.
SmoothOptions smooth_options(const ReconstructOptions& options, double scale);

}  // namespace regionmesh
