// Options of smoothing. The words are those of the command line.
#pragma once

#include <cstdint>

namespace regionmesh {

enum class SmoothFilter {
    kTaubin,     // passes with lambda and mu in turn (Taubin 1995; P 2.3): keeps the volume roughly
    kLaplacian,  // passes with lambda (P eq. 2): shrinks
    kNifpms,     // one pass onto the tangent planes of near faces (Jones, Durand, Desbrun 2003): keeps features
};

struct SmoothOptions {
    SmoothFilter filter = SmoothFilter::kTaubin;
    std::uint32_t passes = 20;    // over all vertices; every other one of taubin has mu; nifpms has one,
                                  // whatever the number; 0: no smoothing
    double lambda = 0.6;          // share of the way to the mean of the neighbours
    double mu_per_lambda = 1.02;  // mu = - mu_per_lambda * lambda (Bade et al. 2006)
    double scale = 1;             // typical length, the sample spacing: unit of the next two
    double nifpms_reach = 2;      // sigma of the weight by distance, times scale
    double nifpms_bound = 0.5;    // sigma of the weight by height over a tangent plane, times scale
    bool move_points = false;     // --smooth-points: quadruple points follow their lines
    double min_quality = 0.1;     // faces already below this quality may stay below
    bool intersect_check = true;
    std::uint32_t threads = 0;  // 0: one per core. The result does not depend on it
};

}  // namespace regionmesh
