// How many faces a run is to leave.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace regionmesh {

/// A tile keeps so many times the share of faces that the target leaves; of what costs nothing less, where the target
/// leaves more than the last share.
inline constexpr double kTileMargin = 1.25, kFreeMargin = 1.02, kFreeFrom = 0.45;

struct Target {
    std::optional<std::uint64_t> faces;  // at most so many
    std::optional<double> reduce;        // or this share less
    std::optional<std::uint64_t> total;  // faces of the unsimplified model, where a first pass counted them

    /// Share of the faces that is left; 1 while nobody knows the total, 0 where only the error bounds.
    double share() const {
        if (reduce) return 1 - *reduce;
        if (!faces) return 0;
        return total ? static_cast<double>(*faces) / static_cast<double>(std::max<std::uint64_t>(*total, 1)) : 1;
    }
    /// Faces left of so many.
    std::uint64_t of(std::uint64_t initial) const {
        if (faces) return *faces;
        return reduce ? static_cast<std::uint64_t>(std::llround(static_cast<double>(initial) * (1 - *reduce))) : 0;
    }
    /// The share of the target that belongs to the faces read so far: decimating the first sections further than the
    /// last ones would make the model uneven.
    std::uint64_t so_far(std::uint64_t read) const {
        return total ? of(*total) * read / std::max<std::uint64_t>(*total, 1) : of(read);
    }
};

}  // namespace regionmesh
