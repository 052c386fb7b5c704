#include "blocks/survey.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Where each label comes first in the order of the sweep, while columns are read.
class FirstPlaces {
public:
    explicit FirstPlaces(const VolumeInfo& volume)
        : width_(volume.lattice.size[volume.sweep.axes[0]]), height_(volume.lattice.size[volume.sweep.axes[1]]) {}

    void begin_column(std::uint32_t u, std::uint32_t v, std::uint32_t width) {
        ++column_;
        place_ = std::uint64_t{v} * width_ + u;
        column_width_ = width;
    }
    void add(std::span<const Label> section) {
        for (std::size_t n = 0; n < section.size(); ++n)
            if (n == 0 || section[n] != section[n - 1])
                note(section[n], place_ + n / column_width_ * width_ + n % column_width_);
        place_ += width_ * height_;
    }

    /// The labels in the order of their places, those of the background first.
    LabelTable sorted(const LabelTable& labels, LabelTable made) const {
        std::vector<Label> order(first_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::sort(order, {}, [&](Label label) { return first_[label]; });
        for (const Label label : order)
            if (first_[label] != kNowhere) made.dense(labels.input(label));
        return made;
    }

private:
    static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

    void note(Label label, std::uint64_t place) {
        if (label >= first_.size()) {
            first_.resize(label + 1, kNowhere);
            seen_.resize(label + 1, 0);
        }
        if (seen_[label] == column_) return;
        seen_[label] = column_;
        first_[label] = std::min(first_[label], place);
    }

    std::uint64_t width_, height_, place_ = 0;
    std::size_t column_width_ = 0;
    std::uint32_t column_ = 0;
    std::vector<std::uint64_t> first_;  // by label
    std::vector<std::uint32_t> seen_;   // in which column last, by label
};

}  // namespace

Survey survey_sections(SectionReader& reader, const SurveyOptions& options, StagingFile* copy) {
    Survey survey{.labels = table_for(reader.info())};
    StripOptions strips = options.strips;
    strips.background = dense_background(options.background, survey.labels);
    std::uint32_t sections = 0;
    survey.faces = count_faces(reader, survey.labels, strips, [&](std::span<const Label> section) {
        if (copy) copy->write(section);
        if (options.on_strip && sections > 0) options.on_strip(sections, reader.section_count() - 1);
        ++sections;
    });
    return survey;
}

Survey survey_columns(const OpenSections& open, std::uint64_t most_samples, const SurveyOptions& options) {
    const VolumeInfo volume = open()->info();
    const auto& size = volume.lattice.size;
    const auto [u, v, w] = volume.sweep.axes;
    const auto side = std::max<std::uint32_t>(static_cast<std::uint32_t>(std::sqrt(double(most_samples))), 3) - 1;
    const std::uint32_t across = (size[u] - 2) / side + 1, count = ((size[v] - 2) / side + 1) * across;
    LabelTable labels = table_for(volume);
    StripOptions strips = options.strips;
    strips.background = dense_background(options.background, labels);
    strips.whole = size;
    FirstPlaces places(volume);
    Survey survey;
    for (std::uint32_t column = 0; column < count; ++column) {
        IndexBox box{{0, 0, 0}, size};
        for (const auto& [axis, place] : {std::pair{u, column % across}, std::pair{v, column / across}}) {
            box.low[axis] = place * side;
            box.high[axis] = std::min(box.low[axis] + side + 1, size[axis]);
        }
        const std::unique_ptr<SectionReader> reader = open();
        reader->crop(box);
        strips.first = box.low;
        places.begin_column(box.low[u], box.low[v], box.size()[u]);
        survey.faces += count_faces(*reader, labels, strips, [&](std::span<const Label> s) { places.add(s); });
        if (options.on_strip) options.on_strip(column + 1, count);
    }
    LabelTable made = table_for(volume);
    dense_background(options.background, made);
    survey.labels = places.sorted(labels, std::move(made));
    return survey;
}

}  // namespace regionmesh
