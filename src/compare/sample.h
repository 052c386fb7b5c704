// Sample points on the faces of a model, or on the edges of its lines: evenly spread and reproducible.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "compare/sorted_strata.h"

namespace regionmesh {

/// Samples of all strata, one stratum after another. Each stratum gets its share of the area or length, and at least a
/// hundred samples (fewer where that would add more than a tenth to the total). A stratum of area A with n samples is
/// divided into n runs of area A / n along the order of its simplices; each run has one point, placed by a hash of its
/// number. So distant samples are independent, and samples with neighbouring numbers are neighbours in space. Holds a
/// reference to its argument.
class Samples {
public:
    /// About `count` samples; none on a stratum without area.
    Samples(const SortedStrata& sorted, std::uint64_t count, std::uint32_t threads);

    std::uint64_t size() const { return starts_.back(); }
    /// The samples of a stratum are begin .. end - 1.
    std::uint64_t begin(std::uint32_t stratum) const { return starts_[stratum]; }
    std::uint64_t end(std::uint32_t stratum) const { return starts_[stratum + 1]; }
    /// Area or length of a stratum, and of the part that one of its samples represents.
    double measure(std::uint32_t stratum) const { return measures_[stratum]; }
    double weight(std::uint32_t stratum) const {
        return measures_[stratum] / static_cast<double>(end(stratum) - begin(stratum));
    }

    /// Calls visit(sample, stratum, point) for samples first .. last - 1 in order.
    template <class Visit>
    void for_range(std::uint64_t first, std::uint64_t last, Visit&& visit) const;

private:
    /// Area or length of its stratum before a sample.
    double along(std::uint64_t sample, std::uint32_t stratum) const;
    Vec3 point(std::uint64_t sample, const Simplex& s) const;
    std::uint32_t stratum_of(std::uint64_t sample) const;
    /// The simplex of the stratum in which `along` lies, `from` or a later one.
    std::uint32_t simplex_at(double along, std::uint32_t stratum, std::uint32_t from) const;

    const SortedStrata& sorted_;
    std::vector<double> ends_;  // by simplex: measure of its stratum up to and including it
    std::vector<double> measures_;
    std::vector<std::uint64_t> starts_;  // by stratum, and one more
};

template <class Visit>
void Samples::for_range(std::uint64_t first, std::uint64_t last, Visit&& visit) const {
    if (first >= last) return;
    std::uint32_t stratum = stratum_of(first);
    std::uint32_t simplex = sorted_.strata[stratum].begin;
    for (std::uint64_t sample = first; sample < last; ++sample) {
        if (sample >= end(stratum)) {
            stratum = stratum_of(sample);
            simplex = sorted_.strata[stratum].begin;
        }
        simplex = simplex_at(along(sample, stratum), stratum, simplex);
        visit(sample, stratum, point(sample, sorted_.simplices[simplex]));
    }
}

}  // namespace regionmesh
