// The filters that move a vertex toward the mean of its neighbours: laplacian and taubin (P 2.3, eq. 2).
#pragma once

#include "smooth/filters/filter.h"

namespace regionmesh {

/// Share of the way that pass `pass` (from 0) goes: lambda, and in every other pass of Taubin's filter mu.
double relax_factor(const SmoothOptions& options, std::uint32_t pass);

/// v' = v + factor * (mean of the neighbours - v) for the vertices of a range, from one array of positions to another.
/// On a side of the box the coordinate stays, to the last bit.
void relax(const SurfaceWindow& window, const Neighbours& neighbours, NumberRange vertices, double factor,
           const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to, std::uint32_t threads);

/// Passes of relax() with the factors of the options.
class Relaxation final : public Filter {
public:
    explicit Relaxation(const FilterInput& input) : input_(input) {}

    double farthest() const override;
    std::uint32_t pass_count() const override { return input_.options.passes; }
    std::uint32_t chunks_ahead(std::uint32_t) const override { return 1; }
    void run(std::uint32_t pass, std::uint32_t chunk, const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to) override {
        relax(input_.window, input_.neighbours, input_.window.vertices_of(chunk), relax_factor(input_.options, pass),
              from, to, input_.options.threads);
    }

private:
    FilterInput input_;
};

/// Restores the coordinates that a vertex on sides of the box keeps: all three on a hull that is not a box.
inline void keep_on_sides(SideSet sides, Vec3 before, Vec3& p) {
    if (sides & (kOnHull | kPinned)) p = before;
    for (int axis = 0; axis < 3; ++axis)
        if (sides >> (2 * axis) & 3) p[axis] = before[axis];
}

}  // namespace regionmesh
