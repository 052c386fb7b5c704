#include "formats/array/layered_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "volume/choose_sweep.h"
#include "volume/chosen_sections.h"

namespace regionmesh::formats {
namespace {

class LayeredSections final : public NumberedSections {
public:
    /// `ranks` are those of the regions, from 1; `labels` are by rank.
    LayeredSections(std::vector<Layer> layers, VolumeInfo info, std::vector<std::uint32_t> ranks,
                    std::vector<InputLabel> labels, std::shared_ptr<Overlaps> overlaps)
        : NumberedSections(std::move(info)),
          layers_(std::move(layers)),
          ranks_(std::move(ranks)),
          labels_(std::move(labels)),
          overlaps_(std::move(overlaps)),
          masks_(layers_.size()) {}

    void rewind() override {
        NumberedSections::rewind();
        for (Layer& layer : layers_) layer.reader->rewind();
    }

    bool crop(const IndexBox& box) override {
        if (!layers_.front().reader->crop(box)) return false;
        for (std::size_t n = 1; n < layers_.size(); ++n)
            layers_[n].reader = crop_sections(std::move(layers_[n].reader), box);
        info_.lattice = cropped(info_.lattice, box);
        NumberedSections::rewind();
        return true;
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number == 0) counted_.samples.clear();
        held_.resize(section.size());
        owners_.assign(section.size(), 0);
        for (std::size_t n = 0; n < layers_.size(); ++n) {
            require_section(layers_[n].reader->next(held_), layers_[n].reader->info(), number);
            add(n, number);
        }
        for (std::size_t i = 0; i < section.size(); ++i) section[i] = owners_[i] == 0 ? 0 : labels_[owners_[i] - 1];
        if (counted_.total() > overlaps_->total()) *overlaps_ = counted_;
    }

    void add(std::size_t n, std::uint32_t number) {
        const Layer& layer = layers_[n];
        InputLabel last = 0;
        std::uint32_t rank = 0;  // of the region of `last`
        for (std::size_t i = 0; i < held_.size(); ++i) {
            if (held_[i] == 0) continue;
            if (held_[i] != last) {
                last = held_[i];
                rank = ranks_[region_of(layer, n, last, number)];
            }
            std::uint32_t& own = owners_[i];
            if (own != 0 && own != rank) ++counted_.samples[std::minmax(labels_[own - 1], labels_[rank - 1])];
            own = std::max(own, rank);
        }
    }

    std::uint32_t region_of(const Layer& layer, std::size_t n, InputLabel stored, std::uint32_t number) {
        const std::string& source = layer.reader->info().source;
        if (layer.only) {
            if (masks_[n] == 0) masks_[n] = stored;
            if (masks_[n] != stored)
                fail_section(source, number,
                             fmt::format("has the labels {} and {}, where a mask of one region has one; give a file "
                                         "with several labels alone",
                                         masks_[n], stored));
            return *layer.only;
        }
        const auto found = layer.regions.find(stored);
        if (found == layer.regions.end())
            fail_section(
                source, number,
                fmt::format(
                    "has the label {}, of which the file names no segment; for one layer alone, give --layer 0 to "
                    "--layer {}",
                    stored, layers_.size() - 1));
        return found->second;
    }

    std::vector<Layer> layers_;
    std::vector<std::uint32_t> ranks_;
    std::vector<InputLabel> labels_;
    std::shared_ptr<Overlaps> overlaps_;  // of the pass that found most
    Overlaps counted_;                    // in this pass
    std::vector<InputLabel> masks_;       // the label other than 0, by layer; 0: not yet met
    std::vector<InputLabel> held_;        // a section of one layer
    std::vector<std::uint32_t> owners_;   // ranks of the regions of samples of a section; 0: none
};

void require_one_lattice(const VolumeInfo& first, const VolumeInfo& other) {
    const Lattice &a = first.lattice, &b = other.lattice;
    if (a.size != b.size)
        fail(other.source, fmt::format("has {} samples, and {} has {}; masks of one model have one lattice",
                                       size_text({b.size[0], b.size[1], b.size[2]}), first.source,
                                       size_text({a.size[0], a.size[1], a.size[2]})));
    constexpr double kRounding = 1e-3;  // of a spacing
    const double bound = kRounding * std::min({a.spacing.x, a.spacing.y, a.spacing.z});
    for (int corner = 0; corner < 8; ++corner) {
        const std::array<double, 3> index{corner & 1 ? a.size[0] : 0.0, corner & 2 ? a.size[1] : 0.0,
                                          corner & 4 ? a.size[2] : 0.0};
        if (!(length(a.place_of(index) - b.place_of(index)) <= bound))
            fail(other.source, fmt::format("lies elsewhere in space than {}; resample one of them", first.source));
    }
}

}  // namespace

std::vector<std::uint32_t> ranks_of(const VolumeInfo& info, const std::vector<InputLabel>& labels,
                                    const std::vector<std::string>& priority) {
    const auto place_in_priority = [&](InputLabel label) {
        const auto name = info.names.find(label);
        const auto is_meant = [&](const std::string& word) {
            return word == std::to_string(label) || (name != info.names.end() && lower(word) == lower(name->second));
        };
        return std::ranges::find_if(priority, is_meant) - priority.begin();
    };
    std::vector<std::pair<std::ptrdiff_t, std::uint32_t>> order;
    std::vector<bool> is_used(priority.size());
    for (std::uint32_t n = 0; n < labels.size(); ++n) {
        order.emplace_back(-place_in_priority(labels[n]), n);
        if (order.back().first > -std::ssize(priority)) is_used[static_cast<std::size_t>(-order.back().first)] = true;
    }
    for (std::size_t n = 0; n < priority.size(); ++n)
        if (!is_used[n])
            fail(info.source,
                 fmt::format("--priority {}: no region is called so; regionmesh info lists them", priority[n]));
    std::ranges::sort(order);
    std::vector<std::uint32_t> ranks(labels.size());
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank].second] = rank + 1;
    return ranks;
}

SampleType label_type_of(const std::vector<InputLabel>& labels) {
    const auto [least, most] = std::ranges::minmax(labels);
    for (const SampleType type : {SampleType::kU8, SampleType::kU16, SampleType::kU32})
        if (range_of(type).holds(most, false) && least >= 0) return type;
    return SampleType::kI64;
}

void take_lattice(const std::vector<const VolumeInfo*>& parts, VolumeInfo& info) {
    const VolumeInfo& first = *parts.front();
    info.lattice = first.lattice;
    info.sweep = first.sweep;
    info.space = first.space;
    info.metres = first.metres;
    info.held_bytes = 0;
    info.can_sweep = {true, true, true};
    for (const VolumeInfo* part : parts) {
        require_one_lattice(first, *part);
        for (std::size_t axis = 0; axis < 3; ++axis)
            info.can_sweep[axis] = info.can_sweep[axis] && part->can_sweep[axis];
        info.held_bytes +=
            part->held_bytes == 0 ? section_samples(*part, part->sweep) * sizeof(InputLabel) : part->held_bytes;
    }
}

std::unique_ptr<SectionReader> join_layers(std::vector<Layer> layers, VolumeInfo info, std::vector<InputLabel> labels,
                                           const std::vector<std::string>& priority) {
    std::vector<const VolumeInfo*> parts;
    for (const Layer& layer : layers) parts.push_back(&layer.reader->info());
    take_lattice(parts, info);
    info.held_bytes += section_samples(info, info.sweep) * (sizeof(InputLabel) + sizeof(std::uint32_t));
    const auto overlaps = std::make_shared<Overlaps>();
    info.overlaps = overlaps;
    info.type = label_type_of(labels);
    std::vector<std::uint32_t> ranks = ranks_of(info, labels, priority);
    std::vector<InputLabel> by_rank(labels.size());
    for (std::size_t n = 0; n < labels.size(); ++n) by_rank[ranks[n] - 1] = labels[n];
    return std::make_unique<LayeredSections>(std::move(layers), std::move(info), std::move(ranks), std::move(by_rank),
                                             overlaps);
}

}  // namespace regionmesh::formats
