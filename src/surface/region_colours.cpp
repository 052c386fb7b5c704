#include "surface/region_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

namespace regionmesh {
namespace {

/// Colours of Okabe and Ito (2008) and Tol (2021), with light and dark tones, without the greys.
constexpr std::array<std::uint32_t, 16> kPalette{0x56B4E9, 0xE69F00, 0x009E73, 0xCC6677, 0xF0E442, 0x4466BB,
                                                 0xCC79A7, 0x88CCEE, 0xDDAA66, 0x44AA99, 0xEE8866, 0xAA4499,
                                                 0xBBCC33, 0x8877CC, 0xD55E00, 0xFFAABB};

using Colour = std::array<double, 3>;

Colour linear_rgb(std::uint32_t colour) {
    Colour rgb;
    for (int n = 0; n < 3; ++n) {
        const double value = (colour >> (16 - 8 * n) & 0xFF) / 255.0;
        rgb[n] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    }
    return rgb;
}

using Matrix = std::array<Colour, 3>;

Colour product(const Matrix& matrix, const Colour& colour) {
    Colour made{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) made[row] += matrix[row][column] * colour[column];
    return made;
}

/// Linear RGB as it is seen: normal, and full protanopia and deuteranopia (Machado, Oliveira and Fernandes 2009).
constexpr std::array<Matrix, 3> kEyes{
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}}};

/// CIE L*a*b* under D65.
Colour lab(const Colour& rgb) {
    constexpr Matrix kXyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
    constexpr Colour kWhite{0.9505, 1, 1.089};
    Colour f = product(kXyz, rgb);
    for (int n = 0; n < 3; ++n) {
        const double t = std::max(f[n], 0.0) / kWhite[n];
        f[n] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

using Views = std::array<Colour, kEyes.size()>;  // one colour for all kinds of eyes, in L*a*b*

Views views_of(std::uint32_t colour) {
    Views views;
    for (std::size_t eye = 0; eye < kEyes.size(); ++eye) views[eye] = lab(product(kEyes[eye], linear_rgb(colour)));
    return views;
}

/// The smallest distance in L*a*b* over all kinds of eyes.
double difference(const Views& a, const Views& b) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t eye = 0; eye < kEyes.size(); ++eye)
        least = std::min(least, std::hypot(a[eye][0] - b[eye][0], a[eye][1] - b[eye][1], a[eye][2] - b[eye][2]));
    return least;
}

using Distances = std::array<std::array<double, kPalette.size()>, kPalette.size()>;

Distances palette_distances() {
    Distances distances;
    for (std::size_t a = 0; a < kPalette.size(); ++a)
        for (std::size_t b = 0; b < kPalette.size(); ++b)
            distances[a][b] = difference(views_of(kPalette[a]), views_of(kPalette[b]));
    return distances;
}

/// The place of the colour in the palette that looks most like this one.
std::size_t nearest_in_palette(std::uint32_t colour) {
    const Views views = views_of(colour);
    std::array<double, kPalette.size()> distances;
    for (std::size_t n = 0; n < kPalette.size(); ++n) distances[n] = difference(views, views_of(kPalette[n]));
    return static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
}

}  // namespace

void add_neighbours(const FileView& view, RegionNeighbours& neighbours) {
    neighbours.resize(view.labels().size());
    const auto is_region = [&](Label label) { return !is_exterior(label) && !view.is_background(label); };
    std::array<Label, 2> last{exterior(0), exterior(0)};  // most faces have the labels of the face before
    view.for_faces([&](FaceId f) {
        const auto [a, b] = view.mesh()[f].labels;
        if (last == view.mesh()[f].labels || !is_region(a) || !is_region(b)) return;
        last = {a, b};
        neighbours[view.rank(a)].insert(view.rank(b));
        neighbours[view.rank(b)].insert(view.rank(a));
    });
}

namespace {

constexpr std::size_t kNoColour = kPalette.size();

/// A colour far from those of the neighbours and little used.
std::size_t best_colour(const std::vector<std::size_t>& taken, const std::array<std::size_t, kPalette.size()>& uses,
                        const Distances& distances) {
    constexpr double kEnough = 30;  // differences above it are plain to see
    constexpr double kPerUse = 5;   // difference for each use more than that of the least used colour
    const std::size_t least = *std::ranges::min_element(uses);
    std::size_t best = 0;
    double best_score = -std::numeric_limits<double>::infinity();
    for (std::size_t colour = 0; colour < kPalette.size(); ++colour) {
        double distance = kEnough;
        for (const std::size_t other : taken) distance = std::min(distance, distances[colour][other]);
        const double score = distance - kPerUse * static_cast<double>(std::min<std::size_t>(uses[colour] - least, 2));
        if (score > best_score) best = colour, best_score = score;
    }
    return best;
}

}  // namespace

std::vector<std::uint32_t> region_colours(const FileView& view) {
    if (!view.colours_of_whole().empty()) return view.colours_of_whole();
    RegionNeighbours neighbours;
    add_neighbours(view, neighbours);
    return region_colours(view, neighbours);
}

std::vector<std::uint32_t> region_colours(const FileView& view, const RegionNeighbours& neighbours) {
    static const Distances kDistances = palette_distances();
    std::vector<std::size_t> chosen(neighbours.size(), kNoColour);
    std::array<std::size_t, kPalette.size()> uses{};
    std::vector<std::optional<std::uint32_t>> given;
    for (const Label label : view.ordered_labels()) {
        const auto found = view.given_colours().find(view.labels().input(label));
        given.push_back(found == view.given_colours().end() ? std::nullopt : std::optional(found->second));
        // Neighbours keep away from the colour of the palette that looks like the given one.
        if (given.back()) ++uses[chosen[given.size() - 1] = nearest_in_palette(*given.back())];
    }
    std::vector<std::uint32_t> order(neighbours.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t place) { return neighbours[place].size(); });
    for (const std::uint32_t place : order) {
        if (given[place]) continue;
        std::vector<std::size_t> taken;
        for (const std::uint32_t other : neighbours[place])
            if (chosen[other] != kNoColour) taken.push_back(chosen[other]);
        ++uses[chosen[place] = best_colour(taken, uses, kDistances)];
    }
    std::vector<std::uint32_t> colours;
    for (std::size_t place = 0; place < chosen.size(); ++place)
        colours.push_back(given[place].value_or(kPalette[chosen[place]]));
    return colours;
}

std::array<std::uint8_t, 3> rgb_of(std::uint32_t colour) {
    return {static_cast<std::uint8_t>(colour >> 16), static_cast<std::uint8_t>(colour >> 8),
            static_cast<std::uint8_t>(colour)};
}

std::string hex_of(std::uint32_t colour) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "#";
    for (int shift = 20; shift >= 0; shift -= 4) text += kDigits[colour >> shift & 0xF];
    return text;
}

std::array<std::uint8_t, 3> FaceColours::operator()(FaceId f) const {
    const std::uint32_t rank = std::min(view_.rank(view_.mesh()[f].labels[0]), view_.rank(view_.mesh()[f].labels[1]));
    constexpr std::uint32_t kGrey = 0x808080;  // colour between two sides of the box
    return rgb_of(rank < colours_.size() ? colours_[rank] : kGrey);
}

}  // namespace regionmesh
