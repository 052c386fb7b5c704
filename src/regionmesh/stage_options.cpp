#include "regionmesh/stage_options.h"

#include <cmath>

namespace regionmesh {
namespace {

/// Faces are decimated to so much more than the least quality where their vertices are to move once more.
constexpr double kRoomForVolume = 1.1;

double scale_of(const Lattice& lattice) { return std::cbrt(lattice.spacing.x * lattice.spacing.y * lattice.spacing.z); }

}  // namespace

SmoothOptions smooth_options(const ReconstructOptions& options, const Lattice& lattice) {
    SmoothOptions own = options.smooth;
    own.scale = scale_of(lattice);
    own.min_quality = options.min_quality;
    own.intersect_check = options.intersect_check;
    own.threads = options.threads;
    return own;
}

DecimateOptions decimate_options(const ReconstructOptions& options, const Lattice& lattice) {
    DecimateOptions own;
    if (options.max_error) own.max_error = *options.max_error;
    own.min_quality = options.min_quality * (options.preserve_volume ? kRoomForVolume : 1);
    own.perturbation = options.perturbation;
    own.scale = scale_of(lattice);
    own.intersect_check = options.intersect_check;
    return own;
}

}  // namespace regionmesh
