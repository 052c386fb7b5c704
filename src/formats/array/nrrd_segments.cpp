#include "formats/array/nrrd_segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "formats/array/layered_sections.h"
#include "formats/array/volume_size.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

/// "0.5 0.25 1": shares of red, green and blue.
std::optional<std::uint32_t> colour_of(std::string_view text) {
    const auto words = split_words(text);
    if (words.size() != 3) return {};
    std::uint32_t colour = 0;
    for (const auto& word : words) {
        const auto share = parse_real(word);
        if (!share || !(*share >= 0 && *share <= 1)) return {};
        colour = colour << 8 | static_cast<std::uint32_t>(std::lround(255 * *share));
    }
    return colour;
}

}  // namespace

std::vector<NrrdSegment> segments_of(const HeaderFields& values) {
    constexpr std::string_view kFirst = "Segment", kLast = "_Name";
    const auto number_of = [&](const std::string& key) { return parse_integer(values.text({key})); };
    std::vector<NrrdSegment> segments;
    for (const auto& [key, value] : values.all()) {
        if (!key.starts_with(kFirst) || !key.ends_with(kLast)) continue;
        const std::string segment = key.substr(0, key.size() - kLast.size());
        const auto number = parse_size(std::string_view(segment).substr(kFirst.size()));
        const std::string name = one_line(value);
        if (!number || *number >= std::uint64_t{kMostLayers} * kMostLayers || name.empty()) continue;
        const auto label = number_of(segment + "_LabelValue"), layer = number_of(segment + "_Layer");
        segments.push_back({.number = *number,
                            .name = name,
                            .label = label.value_or(1),
                            .layer = static_cast<std::uint32_t>(layer   ? *layer
                                                                : label ? 0
                                                                        : *number),
                            .colour = colour_of(values.text({segment + "_Color"}))});
    }
    std::ranges::sort(segments, {}, &NrrdSegment::number);
    return segments;
}

void take_segments(const std::vector<NrrdSegment>& segments, std::uint32_t in_layer, ArrayFile& array) {
    for (const NrrdSegment& segment : segments) {
        if (segment.layer != in_layer) continue;
        array.names.emplace(segment.label, segment.name);
        if (segment.colour) array.colours.emplace(segment.label, *segment.colour);
    }
}

std::unique_ptr<SectionReader> join_segments(
    const std::vector<NrrdSegment>& segments, std::uint64_t layers, const ArrayFile& array,
    const std::function<std::unique_ptr<SectionReader>(std::uint32_t layer)>& open_layer,
    const std::vector<std::string>& priority) {
    std::set<InputLabel> distinct;
    for (const NrrdSegment& segment : segments) distinct.insert(segment.label);
    const bool are_distinct = distinct.size() == segments.size() && !distinct.contains(0);
    VolumeInfo info = volume_info(array.source, array.format, SampleType::kI64, array.lattice.size);
    std::vector<InputLabel> labels;
    std::map<std::uint32_t, std::map<InputLabel, std::uint32_t>> by_layer;
    for (std::uint32_t n = 0; n < segments.size(); ++n) {
        const NrrdSegment& segment = segments[n];
        if (segment.layer >= layers)
            fail(array.source, fmt::format("segment {} is in layer {}, and there are {}; save it again", segment.name,
                                           segment.layer, layers));
        labels.push_back(are_distinct ? segment.label : InputLabel{n} + 1);
        by_layer[segment.layer].emplace(segment.label, n);
        info.names.emplace(labels.back(), segment.name);
        if (segment.colour) info.colours.emplace(labels.back(), *segment.colour);
    }
    info.files = array.files;
    info.warning = array.warning;
    std::vector<Layer> all;
    for (auto& [layer, regions] : by_layer) all.push_back({open_layer(layer), std::move(regions), {}});
    return join_layers(std::move(all), std::move(info), std::move(labels), priority);
}

}  // namespace regionmesh::formats
