#include "regionmesh/limits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& text) {
    throw Error(ErrorCode::kInput, what + ": " + text);
}

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

/// Also false for NaN.
bool is_length(double length, double most) { return length >= kLeastLength && length <= most; }

std::string allowed(double most) {
    return "; lengths from " + text_of(kLeastLength) + " to " + text_of(most) + " can be computed with: ";
}

}  // namespace

void require_lattice(const std::string& what, const Lattice& lattice) {
    for (int axis = 0; axis < 3; ++axis)
        if (!is_length(lattice.spacing[axis], kMostLength))
            refuse(what, std::string("the spacing along ") + "xyz"[axis] + " is " + text_of(lattice.spacing[axis]) +
                             allowed(kMostLength) + "give the right one with --spacing X,Y,Z");
    constexpr double kNearUnit = 1e-3;  // directions in files are rounded, to six digits and more
    for (const Vec3 axis : lattice.axes())
        if (!(std::abs(length(axis) - 1) <= kNearUnit))
            refuse(what, "the columns of direction are not of length 1; give lengths as spacing");
    constexpr double kLeastVolume = 1e-6;
    if (!(std::abs(lattice.axes_volume()) >= kLeastVolume))
        refuse(what, "the directions of the axes lie in one plane; give those of x, y, z as unit columns");
    const auto& [x, y, z] = lattice.size;
    if (x == 0 || y == 0 || z == 0)
        refuse(what, "has " + std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(z) +
                         " samples; give at least one along each axis");
    const Vec3 spacing = lattice.spacing;
    const double least = std::min({spacing.x, spacing.y, spacing.z});
    for (int row = 0; row < 3; ++row) {
        double most = std::abs(lattice.origin[row]);
        for (int axis = 0; axis < 3; ++axis)
            most += std::abs(lattice.direction[3 * row + axis]) * lattice.size[axis] * spacing[axis];
        if (!(most <= kMostSpacings * least))
            refuse(what, std::string("the coordinates along ") + "xyz"[row] + " reach " + text_of(most) +
                             ", more than 2^40 times the smallest spacing " + text_of(least) +
                             ", which double precision does not resolve; move the origin or mend the spacing");
    }
}

void require_sweep(const std::string& what, const Sweep& sweep) {
    for (const Sweep& known : {kSweepX, kSweepY, kSweepZ})
        if (sweep == known) return;
    refuse(what, "its sweep is none of kSweepX, kSweepY, kSweepZ; give one of them");
}

void require_extent(const std::string& what, const Box& box) {
    const Vec3 size = box.high - box.low;
    const double most = std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        const double farthest = std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
        if (!(farthest <= kMostExtent))
            refuse(what, std::string("the coordinates along ") + "xyz"[axis] + " reach " + text_of(farthest) +
                             allowed(kMostExtent) + "scale the coordinates");
    }
    if (!is_length(most, kMostExtent))
        refuse(what, "its size is " + text_of(most) + allowed(kMostExtent) + "scale the coordinates");
}

void require_mesh_size(const char* what, std::uint64_t vertices, std::uint64_t faces) {
    const auto require = [&](std::uint64_t count, std::uint64_t most, const char* things) {
        if (count > most)
            throw Error(ErrorCode::kInput, std::string(what) + ": " + std::to_string(count) + " " + things +
                                               ", more than " + std::to_string(most) + "; use a part of it");
    };
    require(vertices, kMostVertices, "vertices");
    require(faces, kMostFaces, "faces");
}

}  // namespace regionmesh
