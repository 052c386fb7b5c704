#include "volume/chosen_sections.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

namespace regionmesh {
namespace {

std::uint64_t held_by(const SectionReader& reader) {
    const std::uint64_t section = std::uint64_t{reader.section_width()} * reader.section_height() * sizeof(InputLabel);
    return reader.info().held_bytes ? reader.info().held_bytes : section;
}

class CroppedSections : public SectionReader {
public:
    CroppedSections(ReaderPointer reader, const IndexBox& box)
        : reader_(std::move(reader)), box_(box), info_(reader_->info()) {
        info_.lattice = cropped(info_.lattice, box);
        info_.can_sweep = {};
        info_.can_sweep[info_.sweep.axes[2]] = true;
        whole_.resize(std::size_t{reader_->section_width()} * reader_->section_height());
        info_.held_bytes = held_by(*reader_) + whole_.size() * sizeof(InputLabel);
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        const auto& [u, v, w] = info_.sweep.axes;
        for (; skipped_ < box_.low[w]; ++skipped_)
            if (!reader_->next(whole_)) return false;
        if (section_ == section_count() || !reader_->next(whole_)) return false;
        ++section_;
        auto to = section.begin();
        for (std::uint32_t row = box_.low[v]; row < box_.high[v]; ++row) {
            const auto from = whole_.begin() + std::ptrdiff_t{row} * reader_->section_width();
            to = std::copy(from + box_.low[u], from + box_.high[u], to);
        }
        return true;
    }

    void rewind() override {
        reader_->rewind();
        section_ = skipped_ = 0;
    }

private:
    ReaderPointer reader_;
    IndexBox box_;
    VolumeInfo info_;
    std::vector<InputLabel> whole_;  // one section of the reader
    std::uint32_t skipped_ = 0, section_ = 0;
};

class RelabelledSections : public SectionReader {
public:
    RelabelledSections(ReaderPointer reader, std::function<InputLabel(InputLabel)> new_label)
        : reader_(std::move(reader)), new_label_(std::move(new_label)) {}

    const VolumeInfo& info() const override { return reader_->info(); }

    bool next(std::span<InputLabel> section) override {
        if (!reader_->next(section)) return false;
        for (InputLabel& label : section) label = relabelled(label);
        return true;
    }

    void rewind() override { reader_->rewind(); }
    bool crop(const IndexBox& box) override { return reader_->crop(box); }

private:
    InputLabel relabelled(InputLabel label) {
        if (is_first_ || label != last_) {
            const auto [place, is_new] = known_.try_emplace(label);
            if (is_new) place->second = new_label_(label);
            last_ = label;
            last_new_ = place->second;
            is_first_ = false;
        }
        return last_new_;
    }

    ReaderPointer reader_;
    std::function<InputLabel(InputLabel)> new_label_;
    std::unordered_map<InputLabel, InputLabel> known_;
    InputLabel last_ = 0, last_new_ = 0;
    bool is_first_ = true;
};

/// The label of the most samples; of several one other than `rest`, then the smallest. Sorts `block`.
InputLabel majority(std::vector<InputLabel>& block, InputLabel rest, InputLabelOrder order) {
    std::sort(block.begin(), block.end(), order);
    InputLabel best = block.front();
    std::ptrdiff_t most = 0;
    for (auto from = block.begin(); from != block.end();) {
        const auto to = std::upper_bound(from, block.end(), *from, order);
        if (to - from > most || (to - from == most && best == rest)) {
            most = to - from;
            best = *from;
        }
        from = to;
    }
    return best;
}

class DownsampledSections : public SectionReader {
public:
    DownsampledSections(ReaderPointer reader, const std::array<std::uint32_t, 3>& factors, InputLabel rest)
        : reader_(std::move(reader)), factors_(factors), rest_(rest), info_(reader_->info()) {
        Lattice& lattice = info_.lattice;
        lattice.origin = lattice.place_of({0.5 * (factors[0] - 1), 0.5 * (factors[1] - 1), 0.5 * (factors[2] - 1)});
        for (int axis = 0; axis < 3; ++axis) {
            lattice.size[axis] = (lattice.size[axis] - 1) / factors[axis] + 1;
            lattice.spacing[axis] *= factors[axis];
        }
        info_.can_sweep = {};
        info_.can_sweep[info_.sweep.axes[2]] = true;
        slab_.resize(std::min(factors_[info_.sweep.axes[2]], reader_->section_count()));
        for (auto& section : slab_) section.resize(std::size_t{reader_->section_width()} * reader_->section_height());
        info_.held_bytes = held_by(*reader_) + slab_.size() * slab_[0].size() * sizeof(InputLabel);
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        const std::size_t count = std::min<std::size_t>(slab_.size(), reader_->section_count() - read_);
        if (count == 0) return false;
        for (std::size_t s = 0; s < count; ++s) require_section(reader_->next(slab_[s]), reader_->info(), read_++);
        auto to = section.begin();
        for (std::uint32_t v = 0; v < section_height(); ++v)
            for (std::uint32_t u = 0; u < section_width(); ++u) *to++ = label_of_block(u, v, count);
        return true;
    }

    void rewind() override {
        reader_->rewind();
        read_ = 0;
    }

private:
    InputLabel label_of_block(std::uint32_t u, std::uint32_t v, std::size_t sections) {
        const std::uint32_t along_u = factors_[info_.sweep.axes[0]], along_v = factors_[info_.sweep.axes[1]];
        const std::uint32_t width = reader_->section_width();
        const std::uint32_t u_end = std::min(width - u * along_u, along_u) + u * along_u;
        const std::uint32_t v_end = std::min(reader_->section_height() - v * along_v, along_v) + v * along_v;
        block_.clear();
        for (std::size_t s = 0; s < sections; ++s)
            for (std::uint32_t row = v * along_v; row < v_end; ++row) {
                const auto from = slab_[s].begin() + std::ptrdiff_t{row} * width;
                block_.insert(block_.end(), from + u * along_u, from + u_end);
            }
        return majority(block_, rest_, {info_.type == SampleType::kU64});
    }

    ReaderPointer reader_;
    std::array<std::uint32_t, 3> factors_;
    InputLabel rest_;
    VolumeInfo info_;
    std::uint32_t read_ = 0;                     // sections since the beginning
    std::vector<std::vector<InputLabel>> slab_;  // the sections of one block
    std::vector<InputLabel> block_;
};

}  // namespace

ReaderPointer crop_sections(ReaderPointer reader, const IndexBox& box) {
    if (reader->crop(box)) return reader;
    return std::make_unique<CroppedSections>(std::move(reader), box);
}

ReaderPointer relabel_sections(ReaderPointer reader, std::function<InputLabel(InputLabel)> new_label) {
    return std::make_unique<RelabelledSections>(std::move(reader), std::move(new_label));
}

ReaderPointer downsample_sections(ReaderPointer reader, const std::array<std::uint32_t, 3>& factors, InputLabel rest) {
    return std::make_unique<DownsampledSections>(std::move(reader), factors, rest);
}

}  // namespace regionmesh
