#include "stream/stage_options.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "stream/tuning.h"
#include "volume/exact_grid.h"
#include "volume/room_reader.h"

namespace regionmesh {
namespace {

constexpr double kBestQuality = 0.26;  // of an equilateral face, rounded down

}  // namespace

void require_in_range(const ReconstructOptions& options) {
    const auto require = [](const char* name, double number, double most, const char* range) {
        if (number >= 0 && number <= most) return;
        throw Error(ErrorCode::kUsage,
                    std::string(name) + ": " + std::to_string(number) + " is not a number of " + range + "; give one");
    };
    constexpr double kMost = std::numeric_limits<double>::max();
    if (options.reduce) require("reduce", *options.reduce, 1, "0 to 1");
    if (options.max_error) require("max_error", *options.max_error, HUGE_VAL, "0 or more");
    require_room(options.room);
    if (options.strips_per_chunk == 0) throw Error(ErrorCode::kUsage, "strips_per_chunk: 0; give at least 1");
    require("min_quality", options.min_quality, kBestQuality, "0 to 0.26");
    require("perturbation", options.perturbation, kMost, "0 or more");
    require("smooth.lambda", options.smooth.lambda, 1, "0 to 1");
    require("smooth.mu_per_lambda", options.smooth.mu_per_lambda, kMost, "0 or more");
    constexpr double kReaches[] = {0, 2, 4, 8, 16};
    if (std::ranges::find(kReaches, options.smooth.reach) == std::end(kReaches))
        throw Error(ErrorCode::kUsage, "smooth.reach: " + std::to_string(options.smooth.reach) +
                                           " is none of 0, 2, 4, 8 and 16; give one of them");
}

ReconstructOptions with_filter(const ReconstructOptions& options, SmoothFilter automatic) {
    ReconstructOptions own = options;
    if (own.smooth.filter == SmoothFilter::kAuto) own.smooth.filter = automatic;
    return own;
}

CellKind cell_kind(const ReconstructOptions& options) {
    if (options.cells != CellKind::kAuto) return options.cells;
    const SmoothFilter filter = options.smooth.filter;
    const bool keeps_samples =
        options.smooth.passes == 0 || filter == SmoothFilter::kAuto || filter == SmoothFilter::kLattice;
    return keeps_samples && !options.preserve_volume ? CellKind::kCompact : CellKind::kTetrahedra;
}

SmoothOptions smooth_options(const ReconstructOptions& options, double scale) {
    SmoothOptions own = options.smooth;
    own.scale = scale;
    own.min_quality = options.min_quality;
    own.intersect_check = options.intersect_check;
    own.threads = options.threads;
    return own;
}

double section_scale(const VolumeInfo& volume, const ReconstructOptions& options) {
    if (options.scale_z == kAutoScale) {
        const Vec3& spacing = volume.lattice.spacing;
        return nearest_power_of_two(std::sqrt(spacing.x * spacing.y) / spacing.z);
    }
    if (options.scale_z >= kLeastLength && options.scale_z <= 1 / kLeastLength)
        return nearest_power_of_two(options.scale_z);
    throw Error(ErrorCode::kUsage,
                volume.source + ": --scale-z must be a number above 0, and within bounds; take one such as 100");
}

SimplifyOptions simplify_options(const ReconstructOptions& options, const SourceShape& shape) {
    SimplifyOptions own;
    if (options.max_error) own.max_error = *options.max_error;
    own.min_quality = options.min_quality * (options.preserve_volume ? stream::kQualityMargin : 1);
    own.perturbation = options.perturbation;
    own.scale = shape.scale;
    own.intersect_check = options.intersect_check;
    // If the hull is open, a line may leave a domain that is not convex and come back in another region.
    own.bounds_regions = options.cap || shape.has_samples;
    if (options.keep_samples && shape.has_samples) own.samples = shape.lattice;
    own.placement = options.placement;
    if (!options.cap && shape.has_samples) {
        Lattice along_axes = shape.lattice;
        along_axes.direction = Lattice().direction;  // meshes are turned at the end
        own.box = along_axes.extent();
    }
    return own;
}

}  // namespace regionmesh
