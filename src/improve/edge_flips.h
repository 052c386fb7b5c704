// Flips of edges inside an interface.
#pragma once

#include <optional>

#include "improve/surface_drift.h"
#include "judge/judge.h"

namespace regionmesh {

/// The flip of the edge of f opposite to `place`, where it has two faces, of one interface and of the same direction.
std::optional<Flip> find_flip(const Mesh& mesh, FaceId f, int place);

/// Tries flips one by one. Holds the scratch space of their tests.
class EdgeFlips {
public:
    /// `poor` is the bound on quality below which faces count as poor (SurfaceDrift).
    EdgeFlips(Judge& judge, SurfaceDrift& drift, double poor);

    /// Flips the edge of face f that is opposite to its corner at `place`, where that makes both faces better and no
    /// test refuses it. Returns the flip made: f and g are the new faces.
    std::optional<Flip> try_flip(FaceId f, int place);

private:
    bool is_flippable(const Flip& flip) const;

    Judge& judge_;
    const Mesh& mesh_;
    SurfaceDrift& drift_;
    double poor3_;  // to the third power
    Change change_;
};

}  // namespace regionmesh
