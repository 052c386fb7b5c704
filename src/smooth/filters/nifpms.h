// Non-iterative, feature-preserving smoothing (Jones, Durand, Desbrun 2003), interface by interface (P 2.3, 4.2).
#pragma once

#include <array>

#include "smooth/filters/filter.h"

namespace regionmesh {

/// A vertex inside an interface goes to the mean of its projections onto the tangent planes of the faces near by that
/// belong to the same interface and are connected with it. The weights are the area of the face, a Gaussian of the
/// distance to the face, and a Gaussian of the height over the plane: planes beyond an edge predict a far position, and
/// hardly count. Normals come from positions that pass 0 averages, with half the reach and without the second weight.
/// On a line, edges of the line take the part of faces. Quadruple points stay.
class Nifpms final : public Filter {
public:
    struct FaceMeasure {
        Vec3 middle;
        double area;
    };
    /// Measure and normal of a face, and half a vertex's star: six corners and where the list begins.
    static constexpr std::uint64_t kBytesPerFace = sizeof(FaceMeasure) + sizeof(Vec3) + 7 * sizeof(std::uint32_t) / 2;
    static_assert(kBytesPerFace == 70);

    explicit Nifpms(const FilterInput& input) : input_(input) {}

    double farthest() const override { return input_.options.nifpms_reach; }
    std::uint32_t pass_count() const override { return 2; }
    std::uint32_t chunks_ahead(std::uint32_t pass) const override {
        return input_.order.chunks_within(pass == 0 ? mollifying_reach() : predicting_reach()) + 1 +
               input_.order.overlap;
    }
    void run(std::uint32_t pass, std::uint32_t chunk, const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to) override;

    void note_chunk(std::uint32_t chunk) override;
    void note_stars(const ChunkStars& stars) override;
    bool reads_earlier_neighbours() const override { return true; }
    void drop_before(std::uint32_t v, std::uint32_t f) override;
    std::size_t bytes() const override { return stars_.bytes() + measures_.bytes() + normals_.bytes(); }

private:
    /// Distances within which faces count.
    double mollifying_reach() const { return input_.options.nifpms_reach * input_.options.scale; }
    double predicting_reach() const { return 2 * input_.options.nifpms_reach * input_.options.scale; }

    /// Averaged positions, from which the normals are taken. Requires stars of all vertices within reach.
    void mollify(NumberRange vertices, SlidingArray<Vec3>& mollified) const;
    /// Smoothed positions. Requires normals of all faces within reach.
    void predict(NumberRange vertices, const SlidingArray<Vec3>& mollified, SlidingArray<Vec3>& to) const;
    void note_normals(std::uint32_t face_end, const SlidingArray<Vec3>& mollified);

    FilterInput input_;
    SlidingLists stars_;  // corners, as ChunkStars has them
    SlidingArray<FaceMeasure> measures_;
    SlidingArray<Vec3> normals_;  // normals of the faces between mollified positions
};

}  // namespace regionmesh
