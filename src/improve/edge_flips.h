// Flips of edges inside an interface.
#pragma once

#include <optional>

#include "regionmesh/improve.h"
#include "judge/judge.h"
#include "improve/surface_drift.h"

namespace regionmesh {

/// Tries flips one by one. Holds the scratch space of their tests.
class EdgeFlips {
public:
    EdgeFlips(Mesh& mesh, FaceTree& tree, SurfaceDrift& drift, const ImproveOptions& options);

    /// Flips the edge of face f that is opposite to its corner at `place`, where that makes both faces better and no
    /// test refuses it. Returns the flip made: f and g are the new faces.
    std::optional<Flip> try_flip(FaceId f, int place);

private:
    bool is_flippable(const Flip& flip) const;
    bool is_refused(const Flip& flip);
    bool carries_samples(const Flip& flip) const;

    Mesh& mesh_;
    FaceTree& tree_;
    SurfaceDrift& drift_;
    const ImproveOptions& options_;
    double bound3_;  // on quality, to the third power
    Collapse collapse_;
};

}  // namespace regionmesh
