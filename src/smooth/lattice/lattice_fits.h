// Quadrics fitted to the sheets of interfaces in blocks, and the estimates that they give sites.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice/lattice_row.h"
#include "smooth/lattice/lattice_sheet.h"

namespace regionmesh {

/// The interface near a site, linear: height over the surface at the centroid in finest spacings, and the height's
/// gradient.
struct SiteEstimate {
    float height = 0;
    Float3 slope;
    float rest = 1;  // share that no scale has decided yet; height and slope are sums with weights 1 - rest
};

/// A fit of a run.
struct FitPlace {
    LatticeRow* row;
    std::uint32_t run, fit;  // indices of run and fit in the row
};

/// A quadric is fitted to the samples within kReach blocks. It is accepted if it passes through (nearly) every simplex
/// within kBlend blocks, but for those of stray labels, and, between sections far apart, not on one side of the middles
/// of its edges: then it is a surface that explains the labels there.
class LatticeFits {
public:
    static constexpr float kReach = 2.2f, kBlend = 1.3f;  // radii in blocks

    struct Options {
        double size;             // size of blocks in finest spacings
        bool takes_all = false;  // accept every quadric
        CellKind cells = CellKind::kTetrahedra;
    };

    LatticeFits(const LatticeSites& sites, const LatticeBlocks& blocks, const Options& options);

    /// Appends the fits that sites of the run get shares of. Fits need not be made yet.
    void find_near(const LatticeRow& row, std::uint32_t run, std::span<const NearRun> near,
                   std::vector<FitPlace>& found) const;
    /// Makes the fits of a run.
    void make(LatticeRow& row, std::uint32_t run, std::span<const NearRun> near) const;
    /// Gives the accepted among these fits the rest of the estimates of each site of the run, blended.
    void blend(const LatticeRow& row, std::uint32_t run, std::span<const FitPlace> fits,
               SlidingPages<SiteEstimate>& estimates) const;

private:
    struct Sites4;
    struct Blend4;
    struct Passage4;
    class Gaps;
    class Corners;

    Sites4 gather(const std::uint32_t* numbers, std::uint32_t count) const;
    const HeightSamples& choose(const HeightQuadric& quadric, bool is_fitted, const TangentFrame& frame,
                                const Gaps& gaps, const Corners& corners, std::span<const NearRun> near,
                                std::uint32_t stride) const;
    float acceptance(const HeightQuadric& quadric, const Gaps& gaps, std::span<const NearRun> near,
                     bool is_trial) const;
    Mask4 belong(const LatticeSheet& sheet, const HeightQuadric::At& at, const Lanes3<Float4>& normal,
                 const Kinds4& kind) const;
    Passage4 passage(const HeightQuadric::At& at, const Kinds4& kind) const;
    Blend4 blended(const Sites4& sites, const LatticeRow& row, std::uint32_t run, std::span<const FitPlace> fits) const;
    void make_linear(Blend4& sums, const Kinds4& kind) const;

    const LatticeSites& sites_;
    LatticeBlocks blocks_;
    Options options_;
    StepVectors steps_;
    bool is_anisotropic_;
    LatticeSheet::Agreement agreement_;
};

}  // namespace regionmesh
