#include "formats/array/soft_labels.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "formats/array/layered_sections.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"
#include "formats/codec/sample_format.h"
#include "volume/choose_sweep.h"
#include "volume/chosen_sections.h"

namespace regionmesh::formats {
namespace {

/// Fills `values` with ordered_label() of the samples of the next section.
void read_reals(SectionReader& reader, std::uint32_t number, std::span<InputLabel> values) {
    require_section(reader.next(values), reader.info(), number);
    if (reader.info().has_ordered_reals) return;
    const bool is_unsigned = reader.info().type == SampleType::kU64;
    for (InputLabel& value : values)
        value = ordered_label(is_unsigned ? static_cast<double>(static_cast<std::uint64_t>(value))
                                          : static_cast<double>(value));
}

SampleType type_of_ranks(std::size_t count) { return count < 256 ? SampleType::kU8 : SampleType::kU16; }

class ThresholdSections final : public NumberedSections {
public:
    ThresholdSections(std::unique_ptr<SectionReader> reader, VolumeInfo info, const std::vector<double>& thresholds)
        : NumberedSections(std::move(info)), reader_(std::move(reader)) {
        for (const double threshold : thresholds) thresholds_.push_back(ordered_label(threshold));
    }

    void rewind() override {
        NumberedSections::rewind();
        reader_->rewind();
    }

    bool crop(const IndexBox& box) override {
        if (!reader_->crop(box)) return false;
        info_.lattice = reader_->info().lattice;
        NumberedSections::rewind();
        return true;
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        read_reals(*reader_, number, section);
        for (InputLabel& label : section)
            label = std::upper_bound(thresholds_.begin(), thresholds_.end(), label) - thresholds_.begin();
    }

    std::unique_ptr<SectionReader> reader_;
    std::vector<InputLabel> thresholds_;
};

class ArgmaxSections final : public NumberedSections {
public:
    ArgmaxSections(std::vector<std::unique_ptr<SectionReader>> readers, VolumeInfo info, double least, InputLabel first)
        : NumberedSections(std::move(info)),
          readers_(std::move(readers)),
          least_(ordered_label(least)),
          first_(first) {}

    void rewind() override {
        NumberedSections::rewind();
        for (const auto& reader : readers_) reader->rewind();
    }

    bool crop(const IndexBox& box) override {
        for (auto& reader : readers_) reader = crop_sections(std::move(reader), box);
        info_.lattice = cropped(info_.lattice, box);
        NumberedSections::rewind();
        return true;
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        values_.resize(section.size());
        largest_.assign(section.size(), std::numeric_limits<InputLabel>::min());
        std::ranges::fill(section, 0);
        for (std::size_t n = 0; n < readers_.size(); ++n) {
            read_reals(*readers_[n], number, values_);
            for (std::size_t i = 0; i < section.size(); ++i)
                if (values_[i] >= least_ && values_[i] > largest_[i]) {
                    largest_[i] = values_[i];
                    section[i] = first_ + static_cast<InputLabel>(n);
                }
        }
    }

    std::vector<std::unique_ptr<SectionReader>> readers_;
    InputLabel least_, first_;
    std::vector<InputLabel> values_, largest_;
};

}  // namespace

std::unique_ptr<SectionReader> threshold_sections(std::unique_ptr<SectionReader> reader,
                                                  std::vector<double> thresholds) {
    VolumeInfo info = reader->info();
    info.type = type_of_ranks(thresholds.size());
    info.has_ordered_reals = false;
    info.names.clear();
    info.colours.clear();
    return std::make_unique<ThresholdSections>(std::move(reader), std::move(info), thresholds);
}

std::unique_ptr<SectionReader> argmax_sections(std::vector<std::unique_ptr<SectionReader>> readers, VolumeInfo info,
                                               double least, bool has_background) {
    info.type = type_of_ranks(readers.size() + (has_background ? 1 : 0));
    info.has_ordered_reals = false;
    std::vector<const VolumeInfo*> parts;
    for (const auto& reader : readers) parts.push_back(&reader->info());
    take_lattice(parts, info);
    info.held_bytes += 2 * section_samples(info, info.sweep) * sizeof(InputLabel);
    return std::make_unique<ArgmaxSections>(std::move(readers), std::move(info), least, has_background ? 1 : 0);
}

}  // namespace regionmesh::formats
