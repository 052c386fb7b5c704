// Smoothing of a mesh in memory, and restoring the volumes of its regions afterwards.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

enum class SmoothFilter {
    kAuto,       // kLattice for sections, kTaubin for all else
    kLattice,    // of sections: inside the simplices of the lattice, keeps every sample
                 // (docs/explanation/smoothing.md)
    kTaubin,     // passes with lambda and mu in turn (Taubin 1995; P 2.3): roughly preserves volumes
    kLaplacian,  // passes with lambda (P eq. 2): shrinks
    kNifpms,     // one pass onto the tangent planes nearby (Jones, Durand, Desbrun 2003): keeps features
};

inline constexpr std::uint32_t kMostSmoothPasses = 100'000;

/// The words are those of the command line.
struct SmoothOptions {
    SmoothFilter filter = SmoothFilter::kAuto;
    std::uint32_t passes = 20;    // sweeps over all vertices, at most kMostSmoothPasses; Taubin: every second one uses
                                  // mu; NIFPMS: one is enough; kLattice: any number but 0 is the same; 0: none
    double reach = 0;             // kLattice: largest blocks, in finest spacings: 2, 4, 8, 16; 0: from the spacing
    double lambda = 0.6;          // share of the way to the mean of the neighbours
    double mu_per_lambda = 1.02;  // mu = - mu_per_lambda * lambda (Bade et al. 2006)
    double scale = 1;             // a typical length, the sample spacing: unit of the next two
    double nifpms_reach = 2;      // sigma of the weight by distance, in units of scale
    double nifpms_bound = 0.5;    // sigma of the weight by height over a tangent plane, in units of scale
    bool move_points = false;     // --smooth-points: quadruple points follow their lines
    double min_quality = 0.1;     // no face falls below this quality; faces already below it may stay below
    bool intersect_check = true;
    std::optional<Box> box = {};  // preserve_volumes() moves no vertex out of it
    std::uint32_t threads = 0;    // 0: one per core; the result does not depend on it
};

/// What smoothing did.
struct SmoothReport {
    std::uint64_t vertices = 0;
    std::uint64_t vertex_passes = 0;
    std::uint64_t turned_faces = 0;       // turned over by the filter, before vertices backtracked
    std::uint64_t low_quality_faces = 0;  // below the quality bound after the filter, before vertices backtracked
    std::uint64_t crossing_pairs = 0;     // pairs of faces found crossing on the way
    std::uint64_t islands = 0;            // separate parts found to change sides of another part on the way
    std::uint64_t held_vertices = 0;      // stopped because they would have gone too far along the sweep
    std::uint64_t backtracked = 0;        // vertices, in the end
    double largest_displacement = 0;      // length
    double rms_displacement = 0;
    std::uint32_t window_chunks = 0;  // most strips held at once
    std::uint64_t window_bytes = 0;   // most bytes of the window
    double filter_seconds = 0, guard_seconds = 0;
    std::vector<double> volume_before, volume_after;  // one per dense label, length^3
    std::optional<Vec3> apex;                         // apex of the cones whose sums the volumes are

    /// For a mesh that is moved to its place in space: its volumes are then `factor` times as large.
    void scale_volumes(double factor);
};

/// With kTaubin, kLaplacian or kNifpms. Moves the vertices in place, except fixed ones; ids stay the same. Runs the
/// same passes and the same guard as the stream. Adds no violation; violations that came in may stay. Throws
/// Error(kUsage) for kLattice, since a mesh has no lattice, for numbers out of range, and for a mesh in an oblique box
/// (box_axes.h). Deterministic.
SmoothReport smooth(Mesh& mesh, const SmoothOptions& options);

/// Fixes all vertices on the sides of the box, or on another hull. For meshes that have no faces there: a filter could
/// move the end of a surface out of the box.
void fix_rims(Mesh& mesh);

/// What preserve_volumes() did.
struct PreserveReport {
    std::uint32_t rounds = 0;
    double drift_before = 0;          // largest |volume / wanted - 1| of a region before the first round
    double drift = 0;                 // the same after the last round
    std::uint64_t regions_off = 0;    // regions whose drift stays above kVolumeTolerance
    std::uint64_t held_vertices = 0;  // stopped by the guard
    double largest_displacement = 0;  // largest displacement of one round, length
};
inline constexpr double kVolumeTolerance = 1e-6;

/// Volumes by dense label; nullopt for regions whose volume is free: background, and regions without a closed
/// boundary.
using WantedVolumes = std::vector<std::optional<double>>;

/// Moves vertices along the interface normals until every region has the wanted volume, as nearly as the guard allows.
/// Each round solves for one multiplier per region: vertex v moves by the sum over its regions of multiplier times
/// gradient of the volume, divided by the area around v. This is the smallest motion, in the mean square over the
/// surface, that corrects all volumes to first order. The matrix couples regions that share an interface. Quadruple
/// points move, too: on a coarse mesh a small region may have no other vertices. Vertices on the box stay on its
/// sides, and no other moves beyond them, nor out of the box of the options. No region ends farther from its wanted
/// volume than it began, beyond kVolumeTolerance. Uses min_quality, intersect_check, box and threads of the options.
/// Throws Error(kUsage) for numbers out of range. Deterministic.
PreserveReport preserve_volumes(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options);

}  // namespace regionmesh
