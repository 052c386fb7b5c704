// Non-iterative, feature-preserving smoothing (Jones, Durand, Desbrun 2003), interface by interface (P 2.3, 4.2).
#pragma once

#include "regionmesh/smooth/neighbours.h"
#include "regionmesh/smooth/smooth_options.h"

namespace regionmesh {

/// A vertex inside an interface goes to the mean of its projections onto the tangent planes of the faces near by that
/// belong to the same interface and hang together with it, weighted by area, by a Gaussian of the distance to the face
/// and by one of the height over the plane: planes beyond an edge predict a place far off, and hardly count. Normals
/// come from places that were averaged before, with half the reach and without the second weight. On a line, edges of
/// the line take the part of faces. Points stay.
class Nifpms {
public:
    Nifpms(const SurfaceWindow& window, const Neighbours& neighbours, const SmoothOptions& options)
        : window_(window), neighbours_(neighbours), options_(options) {}

    /// Notes the stars of a layer, in order of layers.
    void add_layer(const LayerStars& stars);

    /// Distance within which faces count.
    double mollifying_reach() const { return options_.nifpms_reach * options_.scale; }
    double predicting_reach() const { return 2 * options_.nifpms_reach * options_.scale; }

    /// Averaged places, from which the normals are taken. Requires stars of all vertices within reach.
    void mollify(NumberRange vertices, SlidingArray<Vec3>& mollified) const;
    /// Smoothed places. Requires mollified places of all vertices within reach.
    void predict(NumberRange vertices, const SlidingArray<Vec3>& mollified, SlidingArray<Vec3>& to) const;

    void drop_before(std::uint32_t v) {
        if (stars_.end() > 0) stars_.drop_before(v);
    }
    std::size_t bytes() const { return stars_.bytes(); }

private:
    const SurfaceWindow& window_;
    const Neighbours& neighbours_;
    const SmoothOptions& options_;
    SlidingLists stars_;  // corners, as LayerStars has them
};

}  // namespace regionmesh
