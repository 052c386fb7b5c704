// Finds out whether labels were copied from a coarser lattice to a finer one, along one axis.
#pragma once

#include <cstdint>
#include <span>

namespace regionmesh {

/// Labels copied by nearest neighbour change only where one coarse sample ends and the next begins: at the samples that
/// follow first_edge + n * factor.
struct Enlargement {
    double factor = 1;      // fine samples to a coarse one; 1: not enlarged
    double first_edge = 0;  // in samples, at most 0, greater than -factor
};

/// `steps[i]` is the number of label changes between samples i - 1 and i. The largest factor that puts nearly all
/// changes on edges, if enough different positions have some.
Enlargement find_enlargement(std::span<const std::uint64_t> steps);

/// Whether a factor that holds along another axis puts nearly all changes on edges: fewer positions are enough.
Enlargement find_same_enlargement(std::span<const std::uint64_t> steps, double factor);

}  // namespace regionmesh
