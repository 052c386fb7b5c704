// Points on the faces of a model, or on the edges of its lines: spread evenly, the same in every run.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "compare/sorted_strata.h"

namespace regionmesh {

/// Samples of each stratum, one stratum after another: as many as its share of the area, or length, and at least a
/// hundred (fewer where that would add more than a tenth to all). A stratum of area A with n samples is cut into n
/// runs of area A / n along the order of its simplices, and each run holds one point, placed by a hash of its number:
/// no two samples far apart depend on each other, and neighbours in number are neighbours in space. Refers to its
/// argument.
class Samples {
public:
    /// About `count` samples. Nothing is sampled on a stratum without area.
    Samples(const SortedStrata& sorted, std::uint64_t count, std::uint32_t threads);

    std::uint64_t size() const { return starts_.back(); }
    /// The samples of a stratum are begin .. end - 1.
    std::uint64_t begin(std::uint32_t stratum) const { return starts_[stratum]; }
    std::uint64_t end(std::uint32_t stratum) const { return starts_[stratum + 1]; }
    /// Area or length of a stratum, and of what one of its samples stands for.
    double measure(std::uint32_t stratum) const { return measures_[stratum]; }
    double weight(std::uint32_t stratum) const {
        return measures_[stratum] / static_cast<double>(end(stratum) - begin(stratum));
    }

    /// Calls visit(sample, stratum, point) for samples first .. last - 1 in order.
    template <class Visit>
    void for_range(std::uint64_t first, std::uint64_t last, Visit&& visit) const;

private:
    /// How far along the measure of its stratum a sample lies.
    double along(std::uint64_t sample, std::uint32_t stratum) const;
    Vec3 point(std::uint64_t sample, const Simplex& s) const;
    std::uint32_t stratum_of(std::uint64_t sample) const;
    /// The simplex of the stratum in which `along` lies, `from` or a later one.
    std::uint32_t simplex_at(double along, std::uint32_t stratum, std::uint32_t from) const;

    const SortedStrata& sorted_;
    std::vector<double> ends_;  // by simplex: measure of its stratum up to and with it
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
