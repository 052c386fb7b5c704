// Three passes: number the regions and count their samples; measure the interfaces of small ones; give out new labels.
#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "regionmesh/error.h"
#include "volume/chosen_sections.h"
#include "volume/region_numbers.h"
#include "volume/small_regions.h"

namespace regionmesh {
namespace {

/// Which parts join a neighbour: those of fewer than `min_samples` samples, or, with `specks`, those of which the label
/// has a part kLargerPart times as large.
struct SmallParts {
    std::uint64_t min_samples = 0;
    std::optional<SpeckSize> specks = {};
};

class MergedSections : public SpecklessSections {
public:
    MergedSections(ReaderPointer reader, const SmallParts& parts)
        : own_(std::move(reader)),
          reader_(own_.get()),
          parts_(parts),
          info_(reader_->info()),
          numbers_(1, 1),
          small_({}) {
        prepare();
    }
    MergedSections(SectionReader& reader, const SmallParts& parts)
        : reader_(&reader), parts_(parts), info_(reader.info()), numbers_(1, 1), small_({}) {
        prepare();
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        if (!reader_->next(section)) return false;
        changed_.clear();
        numbers_.next(section, [](std::uint32_t, std::uint32_t) {});
        std::uint32_t sample = 0;
        for (std::uint32_t v = 0; v < section_height(); ++v)
            for (std::uint32_t u = 0; u < section_width(); ++u, ++sample)
                if (const std::uint32_t small = small_of_[numbers_.number(u, v)]; small != RegionNumbers::kNone) {
                    section[sample] = labels_[small];
                    if (parts_.specks) changed_.push_back(sample);
                }
        return true;
    }

    void rewind() override { restart(); }

    const SpeckCounts& counts() const override { return counts_; }
    std::span<const std::uint32_t> changed() const override { return changed_; }

private:
    void prepare() {
        numbers_ = RegionNumbers(section_width(), section_height());
        section_.resize(std::size_t{section_width()} * section_height());
        small_ = SmallRegions({info_.type == SampleType::kU64});
        if (!info_.can_rewind)
            throw Error(ErrorCode::kInput, info_.source +
                                               ": small regions are found by reading the input several times, "
                                               "and it can be read once; leave out --min-region");
        restart();
        count_samples();
        measure_interfaces();
        labels_ = small_.resolve(parts_.specks ? counts_.largest + 1 : parts_.min_samples);
        small_ = SmallRegions({});
        restart();
        constexpr std::uint64_t kLayers = 2 * (sizeof(InputLabel) + sizeof(std::uint32_t));
        info_.held_bytes = (info_.held_bytes ? info_.held_bytes : section_.size() * sizeof(InputLabel)) +
                           section_.size() * kLayers + small_of_.size() * sizeof(std::uint32_t) +
                           labels_.size() * sizeof(InputLabel);
    }

    /// Samples of the largest part of each label.
    std::unordered_map<InputLabel, std::uint64_t> largest_parts(const std::vector<std::uint64_t>& samples,
                                                                const std::vector<InputLabel>& labels) {
        std::unordered_map<InputLabel, std::uint64_t> largest;
        for (std::uint32_t n = 0; n < parents_.size(); ++n)
            if (root(n) == n) {
                std::uint64_t& most = largest[labels[n]];
                most = std::max(most, samples[n]);
            }
        return largest;
    }

    /// Specks by size tell noise from small parts: noise has fewer of each size than of the size before, down to none.
    void find_specks(const std::vector<std::uint64_t>& samples, const std::vector<InputLabel>& labels) {
        const auto largest = largest_parts(samples, labels);
        const auto is_speck = [&](std::uint32_t n, std::uint64_t most) {
            return root(n) == n && samples[n] <= most && largest.at(labels[n]) >= kLargerPart * samples[n];
        };
        std::uint64_t most = parts_.specks->most;
        if (most == 0) {
            std::array<std::uint64_t, kMostFoundSpeck + 2> by_size{};
            for (std::uint32_t n = 0; n < parents_.size(); ++n)
                if (is_speck(n, kMostFoundSpeck)) ++by_size[samples[n]];
            while (most < kMostFoundSpeck && by_size[most + 1] > 0 &&
                   (most == 0 || by_size[most + 1] <= 2 * by_size[most] + 2))
                ++most;
        }
        is_small_.assign(parents_.size(), false);
        for (std::uint32_t n = 0; n < parents_.size(); ++n)
            if (is_speck(n, most)) {
                is_small_[n] = true;
                ++counts_.specks;
                counts_.samples += samples[n];
                counts_.largest = std::max(counts_.largest, samples[n]);
            }
    }

    void restart() {
        reader_->rewind();
        numbers_.restart();
    }

    std::uint32_t root(std::uint32_t number) {
        while (parents_[number] != number) number = parents_[number] = parents_[parents_[number]];
        return number;
    }

    /// Pass 1: small_of_ and the sizes in small_.
    void count_samples() {
        std::vector<std::uint64_t> samples;
        std::vector<InputLabel> labels;
        while (reader_->next(section_)) {
            const auto join = [&](std::uint32_t a, std::uint32_t b) {
                for (std::uint32_t n = static_cast<std::uint32_t>(parents_.size()); n <= std::max(a, b); ++n)
                    parents_.push_back(n);
                a = root(a), b = root(b);
                parents_[std::max(a, b)] = std::min(a, b);
            };
            if (!numbers_.next(section_, join))
                throw Error(ErrorCode::kInput, info_.source +
                                                   ": has more than 4294967294 parts of regions, too many for "
                                                   "--min-region; leave it out");
            for (auto n = static_cast<std::uint32_t>(parents_.size()); n < numbers_.count(); ++n) parents_.push_back(n);
            samples.resize(numbers_.count());
            labels.resize(numbers_.count());
            auto sample = section_.begin();
            for (std::uint32_t v = 0; v < section_height(); ++v)
                for (std::uint32_t u = 0; u < section_width(); ++u) {
                    const std::uint32_t number = numbers_.number(u, v);
                    ++samples[number];
                    labels[number] = *sample++;
                }
        }
        for (std::uint32_t n = 0; n < parents_.size(); ++n)
            if (const std::uint32_t top = root(n); top != n) samples[top] += samples[n];
        if (parts_.specks) find_specks(samples, labels);
        small_of_.assign(parents_.size(), RegionNumbers::kNone);
        for (std::uint32_t n = 0; n < parents_.size(); ++n) {  // a root is the smallest number of its region
            const std::uint32_t top = root(n);
            if (parts_.specks ? is_small_[top] : samples[top] < parts_.min_samples)
                small_of_[n] = top == n ? small_.add(labels[n], samples[n]) : small_of_[top];
        }
        parents_ = {};
        is_small_ = {};
    }

    /// Pass 2: the contacts in small_.
    void measure_interfaces() {
        const auto& axes = info_.sweep.axes;
        const Vec3& spacing = info_.lattice.spacing;
        std::array<double, 3> areas;
        for (int axis = 0; axis < 3; ++axis)
            areas[axis] = spacing[axes[(axis + 1) % 3]] * spacing[axes[(axis + 2) % 3]];
        restart();
        while (small_.size() > 0 && reader_->next(section_)) {
            numbers_.next(section_, [](std::uint32_t, std::uint32_t) {});
            numbers_.for_contacts(
                [&](std::uint32_t number, InputLabel label, std::uint32_t other, InputLabel other_label, int axis) {
                    const std::uint32_t a = small_of_[number], b = small_of_[other];
                    if (a != RegionNumbers::kNone && b != RegionNumbers::kNone)
                        small_.add_contact_of_small(a, b, areas[axis]);
                    else if (a != RegionNumbers::kNone)
                        small_.add_contact(a, other_label, areas[axis]);
                    else if (b != RegionNumbers::kNone)
                        small_.add_contact(b, label, areas[axis]);
                });
        }
    }

    ReaderPointer own_ = {};
    SectionReader* reader_;
    SmallParts parts_;
    SpeckCounts counts_ = {};
    VolumeInfo info_;
    RegionNumbers numbers_;
    std::vector<InputLabel> section_;
    std::vector<std::uint32_t> parents_;   // parents of the first pass: numbers of one region
    std::vector<std::uint32_t> small_of_;  // one per number: its small region, or kNone
    SmallRegions small_;
    std::vector<bool> is_small_;          // one per number, of the first pass with specks
    std::vector<InputLabel> labels_;      // labels of small regions
    std::vector<std::uint32_t> changed_;  // samples of the last section that were in specks
};

}  // namespace

ReaderPointer merge_small_regions(ReaderPointer reader, std::uint64_t min_samples) {
    return std::make_unique<MergedSections>(std::move(reader), SmallParts{.min_samples = min_samples});
}

std::unique_ptr<SpecklessSections> merge_specks(SectionReader& reader, const SpeckSize& size) {
    return std::make_unique<MergedSections>(reader, SmallParts{.specks = size});
}

}  // namespace regionmesh
