// Sample points on the faces of a model, or on the edges of its lines: evenly spread and reproducible.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compare/sorted_strata.h"

namespace regionmesh {

/// Samples of all strata of a model, one stratum after another. Each stratum gets its share of the area or length, and
/// at least a hundred samples (fewer where that would add more than a tenth to the total). A stratum of area A with n
/// samples is divided into n runs of area A / n along the order of its simplices; each run has one point, placed by a
/// hash of its number. So distant samples are independent, and samples with neighbouring numbers are neighbours in
/// space.
class Samples {
public:
    /// About `count` samples on strata with these areas or lengths; none on a stratum without area.
    Samples(std::vector<double> measures, std::uint64_t count);

    std::uint64_t size() const { return starts_.back(); }
    std::uint32_t stratum_count() const { return static_cast<std::uint32_t>(measures_.size()); }
    /// The samples of a stratum are begin .. end - 1.
    std::uint64_t begin(std::uint32_t stratum) const { return starts_[stratum]; }
    std::uint64_t end(std::uint32_t stratum) const { return starts_[stratum + 1]; }
    std::uint32_t stratum_of(std::uint64_t sample) const;
    /// Area or length of a stratum, and of the part that one of its samples represents.
    double measure(std::uint32_t stratum) const { return measures_[stratum]; }
    double weight(std::uint32_t stratum) const {
        return measures_[stratum] / static_cast<double>(end(stratum) - begin(stratum));
    }
    /// Area or length of its stratum before a sample. Does not decrease with the number of the sample.
    double along(std::uint64_t sample, std::uint32_t stratum) const;

private:
    std::vector<double> measures_;
    std::vector<std::uint64_t> starts_;  // first sample of each stratum, and one more
};

/// The points of samples, taken from the parts of the model one after another: the strata of the model are those of the
/// parts end to end. Holds a reference to its argument.
class SamplePoints {
public:
    explicit SamplePoints(const Samples& samples);

    /// Takes the points that lie in the next part. `numbers`, by stratum of the part, are those of the model.
    void add(const SortedStrata& part, std::span<const std::uint32_t> numbers, std::uint32_t threads);
    /// One per sample; valid after all parts.
    std::vector<Vec3> take() { return std::move(points_); }

private:
    /// Some samples of a stratum.
    struct Range {
        std::uint32_t number, stratum;  // number of the stratum in the model, and in the part
        std::uint64_t first, end;
        double before;  // measure of the stratum in the parts before
    };
    void place(const SortedStrata& part, const Range& range);

    const Samples& samples_;
    std::vector<Vec3> points_;
    std::vector<double> before_;       // measure of each stratum in the parts so far
    std::vector<std::uint64_t> next_;  // first sample of each stratum that lies in none of these parts
};

}  // namespace regionmesh
