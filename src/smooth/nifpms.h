// Non-iterative, feature-preserving smoothing (Jones, Durand, Desbrun 2003), interface by interface (P 2.3, 4.2).
#pragma once

#include "regionmesh/smooth_options.h"
#include "smooth/neighbours.h"

namespace regionmesh {

/// A vertex inside an interface goes to the mean of its projections onto the tangent planes of the faces near by that
/// belong to the same interface and hang together with it, weighted by area, by a Gaussian of the distance to the face
/// and by one of the height over the plane: planes beyond an edge predict a place far off, and hardly count. Normals
/// come from places that were averaged before, with half the reach and without the second weight. On a line, edges of
/// the line take the part of faces. Points stay.
class Nifpms {
public:
    struct FaceMeasure {
        Vec3 middle;
        double area;
    };

    Nifpms(const SurfaceWindow& window, const Neighbours& neighbours, const SmoothOptions& options)
        : window_(window), neighbours_(neighbours), options_(options) {}

    /// Notes the stars of a layer, in order of layers.
    void add_layer(const LayerStars& stars);
    /// Notes the faces of a layer that has just come in.
    void note_layer(std::uint32_t layer);

    /// Distance within which faces count.
    double mollifying_reach() const { return options_.nifpms_reach * options_.scale; }
    double predicting_reach() const { return 2 * options_.nifpms_reach * options_.scale; }

    /// Averaged places, from which the normals are taken. Requires stars of all vertices within reach.
    void mollify(NumberRange vertices, SlidingArray<Vec3>& mollified) const;
    /// Smoothed places. Requires mollified places of all vertices within reach, which are those of faces before
    /// `face_end`.
    void predict(NumberRange vertices, std::uint32_t face_end, const SlidingArray<Vec3>& mollified,
                 SlidingArray<Vec3>& to);

    void drop_before(std::uint32_t v, std::uint32_t f) {
        if (stars_.end() == 0) return;
        stars_.drop_before(v);
        measures_.drop_before(f);
        normals_.drop_before(f);
    }
    std::size_t bytes() const { return stars_.bytes() + measures_.bytes() + normals_.bytes(); }

private:
    void note_normals(std::uint32_t face_end, const SlidingArray<Vec3>& mollified);

    const SurfaceWindow& window_;
    const Neighbours& neighbours_;
    const SmoothOptions& options_;
    SlidingLists stars_;  // corners, as LayerStars has them
    SlidingArray<FaceMeasure> measures_;
    SlidingArray<Vec3> normals_;  // of the faces between mollified places
};

}  // namespace regionmesh
