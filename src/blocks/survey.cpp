#include "blocks/survey.h"

#include <algorithm>
#include <cmath>

#include "cells/label_census.h"
#include "regionmesh/census.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

using OnSection = std::function<void(std::span<const Label>)>;

/// Faces of the strips of a reader, the whole volume or a part of it.
std::uint64_t count_faces(SectionReader& reader, LabelTable& labels, const StripOptions& strips,
                          const OnSection& on_section) {
    const VolumeInfo& info = reader.info();
    SectionWindow window(reader, labels);
    LabelCensus census(info.lattice, info.sweep, strips);
    while (window.advance()) {
        if (window.sections_read() == 2) on_section(window.low());
        on_section(window.high());
        census.add(window.low(), window.high(), window.is_last());
    }
    return census.face_count();
}

/// Where each label of a box comes first in the order of the sweep.
class FirstPlaces {
public:
    FirstPlaces(const VolumeInfo& volume, const IndexBox& box) {
        const auto [u, v, w] = volume.sweep.axes;
        width_ = volume.lattice.size[u];
        height_ = volume.lattice.size[v];
        box_width_ = box.size()[u];
        place_ = (box.low[w] * height_ + box.low[v]) * width_ + box.low[u];
    }

    void add(std::span<const Label> section) {
        for (std::size_t n = 0; n < section.size(); ++n)
            if (n == 0 || section[n] != section[n - 1])
                note(section[n], place_ + n / box_width_ * width_ + n % box_width_);
        place_ += width_ * height_;
    }

    std::vector<PartSurvey::First> list(const LabelTable& labels) const {
        std::vector<PartSurvey::First> listed;
        for (Label label = 0; label < first_.size(); ++label)
            if (first_[label] != kNowhere) listed.push_back({labels.input(label), first_[label]});
        return listed;
    }

private:
    static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

    void note(Label label, std::uint64_t place) {
        if (label >= first_.size()) first_.resize(label + 1, kNowhere);
        first_[label] = std::min(first_[label], place);
    }

    std::uint64_t width_, height_, place_;
    std::size_t box_width_;
    std::vector<std::uint64_t> first_;  // by label
};

}  // namespace

Survey survey_sections(SectionReader& reader, const SurveyOptions& options, StagingFile* copy) {
    const VolumeInfo& info = reader.info();
    Survey survey{.labels = table_for(info), .hashes = hashes_of_part(info, {{}, info.lattice.size})};
    StripOptions strips = options.strips;
    strips.background = dense_background(options.background, survey.labels);
    std::uint32_t sections = 0;
    survey.faces = count_faces(reader, survey.labels, strips, [&](std::span<const Label> section) {
        if (copy) copy->write(section);
        survey.hashes.add(sections, section, survey.labels);
        if (options.on_strip && sections > 0) options.on_strip(sections, reader.section_count() - 1);
        ++sections;
    });
    return survey;
}

std::vector<IndexBox> survey_boxes(const VolumeInfo& volume, std::uint64_t most_samples, std::uint32_t parts) {
    const auto& size = volume.lattice.size;
    const auto [u, v, w] = volume.sweep.axes;
    std::array<std::uint32_t, 3> step{size[0] - 1, size[1] - 1, size[2] - 1};  // cells
    if (std::uint64_t{size[u]} * size[v] > most_samples) {
        const auto side = std::max<std::uint32_t>(static_cast<std::uint32_t>(std::sqrt(double(most_samples))), 3) - 1;
        step[u] = std::min(step[u], side);
        step[v] = std::min(step[v], side);
    }
    const auto count = [&](int axis) { return (size[axis] - 2) / step[axis] + 1; };
    const std::uint32_t slabs = (parts - 1) / (count(u) * count(v)) + 1;
    step[w] = std::max((size[w] - 2) / slabs + 1, 1u);
    std::vector<IndexBox> boxes;
    for (std::uint32_t z = 0; z + 1 < size[2]; z += step[2])
        for (std::uint32_t y = 0; y + 1 < size[1]; y += step[1])
            for (std::uint32_t x = 0; x + 1 < size[0]; x += step[0])
                boxes.push_back({{x, y, z},
                                 {std::min(x + step[0] + 1, size[0]), std::min(y + step[1] + 1, size[1]),
                                  std::min(z + step[2] + 1, size[2])}});
    return boxes;
}

SampleHashes hashes_of_part(const VolumeInfo& volume, const IndexBox& box) {
    return {volume.lattice.size, volume.sweep, box};
}

PartSurvey survey_part(const OpenSections& open, const IndexBox& box, const SurveyOptions& options) {
    const std::unique_ptr<SectionReader> reader = open();
    const VolumeInfo volume = reader->info();
    reader->crop(box);
    LabelTable labels = table_for(volume);
    StripOptions strips = options.strips;
    strips.background = dense_background(options.background, labels);
    strips.first = box.low;
    strips.whole = volume.lattice.size;
    FirstPlaces places(volume, box);
    PartSurvey part{.labels = {}, .hashes = hashes_of_part(volume, box)};
    std::array<std::uint32_t, 3> end = box.high;  // the next box has the last samples, too
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (end[axis] < volume.lattice.size[axis]) --end[axis];
    std::uint32_t number = box.low[volume.sweep.axes[2]];
    part.faces = count_faces(*reader, labels, strips, [&](std::span<const Label> section) {
        places.add(section);
        part.hashes.add(number++, section, labels, end);
    });
    part.labels = places.list(labels);
    return part;
}

Survey join_surveys(const VolumeInfo& volume, const std::vector<InputLabel>& background,
                    std::span<const PartSurvey> parts) {
    Survey survey{.labels = table_for(volume), .hashes = hashes_of_part(volume, {{}, volume.lattice.size})};
    dense_background(background, survey.labels);
    std::vector<PartSurvey::First> all;
    for (const PartSurvey& part : parts) {
        survey.faces += part.faces;
        survey.hashes.add(part.hashes);
        all.insert(all.end(), part.labels.begin(), part.labels.end());
    }
    std::ranges::sort(all, {}, &PartSurvey::First::place);
    for (const auto& [label, place] : all) survey.labels.dense(label);
    return survey;
}

}  // namespace regionmesh
