#include "formats/array/nrrd_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

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

void take_segments(const HeaderFields& values, std::uint32_t in_layer, ArrayFile& array) {
    constexpr std::string_view kFirst = "Segment", kLast = "_Name";
    const auto number_of = [&](const std::string& key) { return parse_integer(values.text({key})); };
    for (const auto& [key, value] : values.all()) {
        if (!key.starts_with(kFirst) || !key.ends_with(kLast)) continue;
        const std::string segment = key.substr(0, key.size() - kLast.size());
        const auto number = parse_size(std::string_view(segment).substr(kFirst.size()));
        const std::string name = one_line(value);
        if (!number || *number >= std::uint64_t{kMostLayers} * kMostLayers || name.empty()) continue;
        const auto label = number_of(segment + "_LabelValue"), layer = number_of(segment + "_Layer");
        if (static_cast<std::uint32_t>(layer ? *layer : label ? 0 : *number) != in_layer) continue;
        array.names.emplace(label.value_or(1), name);
        if (const auto colour = colour_of(values.text({segment + "_Color"})))
            array.colours.emplace(label.value_or(1), *colour);
    }
}

}  // namespace regionmesh::formats
