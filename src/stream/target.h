// How many faces a run leaves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace regionmesh {

struct Target {
    std::optional<std::uint64_t> faces;  // this number at most
    std::optional<double> reduce;        // or all but this share
    std::optional<std::uint64_t> total;  // faces before simplification, where a first pass counted them

    /// Share of the faces that is left; 1 where the total is not known, 0 where only the error is bounded.
    double share() const {
        if (reduce) return 1 - *reduce;
        if (!faces) return 0;
        return total ? static_cast<double>(*faces) / static_cast<double>(std::max<std::uint64_t>(*total, 1)) : 1;
    }
    /// Faces left of `initial`.
    std::uint64_t of(std::uint64_t initial) const {
        if (faces) return *faces;
        return reduce ? static_cast<std::uint64_t>(std::llround(static_cast<double>(initial) * (1 - *reduce))) : 0;
    }
    /// The part of the target that belongs to the faces read so far. Decimating the first sections further than the
    /// last ones would make the mesh uneven.
    std::uint64_t so_far(std::uint64_t read) const {
        if (!total) return of(read);
        const std::uint64_t all = std::max<std::uint64_t>(*total, 1), target = of(*total);
        if (read == 0 || target <= ~std::uint64_t{0} / read) return target * read / all;
        return static_cast<std::uint64_t>(static_cast<double>(target) *
                                          (static_cast<double>(read) / static_cast<double>(all)));
    }
};

}  // namespace regionmesh
