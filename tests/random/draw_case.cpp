#include "random/draw_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>

namespace regionmesh::random {
namespace {

using Size = std::array<std::uint32_t, 3>;  // samples along x, y and z

/// Draws that are the same on every system.
class Draw {
public:
    explicit Draw(std::mt19937_64& random) : random_(random) {}
    std::uint64_t bits() { return random_(); }
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }
    bool one_in(std::uint32_t count) { return below(count) == 0; }
    double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * share(); }
    template <typename T, std::size_t N>
    const T& of(const T (&rows)[N]) {
        return rows[below(N)];
    }

private:
    std::mt19937_64& random_;
};

std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

// Labels.

struct Type {
    const char* name;  // of .npy
    int bytes;
    bool is_signed;
};
constexpr Type kTypes[] = {{"|u1", 1, false}, {"|i1", 1, true},  {"<u2", 2, false}, {"<i2", 2, true},
                           {"<u4", 4, false}, {"<i4", 4, true},  {"<u8", 8, false}, {"<i8", 8, true},
                           {">i2", 2, true},  {">u4", 4, false}, {">i8", 8, true}};

/// Values of one type: 0 more often than others, else small, large or negative.
std::uint64_t draw_value(const Type& type, Draw& draw) {
    if (draw.one_in(5)) return 0;
    if (draw.one_in(2)) return 1 + draw.below(20);
    if (draw.one_in(6)) return type.is_signed ? std::uint64_t{1} << (8 * type.bytes - 1) : ~std::uint64_t{0};
    return draw.bits();
}

std::string npy_of(const std::vector<std::uint32_t>& samples, const Size& size, Draw& draw, std::string& text) {
    const Type& type = draw.of(kTypes);
    std::vector<std::uint64_t> values(1 + *std::max_element(samples.begin(), samples.end()));
    for (std::uint64_t& value : values) value = draw_value(type, draw);
    std::string header = std::string("{'descr': '") + type.name + "', 'fortran_order': False, 'shape': (" +
                         std::to_string(size[2]) + ", " + std::to_string(size[1]) + ", " + std::to_string(size[0]) +
                         "), }";
    header.resize(117, ' ');
    header += '\n';
    std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
    for (const std::uint32_t sample : samples)
        for (int b = 0; b < type.bytes; ++b)
            bytes += static_cast<char>(values[sample] >> 8 * (type.name[0] == '>' ? type.bytes - 1 - b : b));
    text += std::string(" ") + type.name;
    return bytes;
}

// Patterns: a small number for each sample.

enum class Pattern { kNoise, kBlocks, kFoam, kLayers, kDust, kBoard, kBalls };
constexpr const char* kPatterns[] = {"noise", "blocks", "foam", "layers", "dust", "board", "balls"};

std::vector<std::uint32_t> draw_samples(Pattern pattern, const Size& size, Draw& draw) {
    const std::uint32_t labels = 2 + draw.below(6), block = 1 + draw.below(4);
    const std::uint64_t salt = draw.bits();
    std::vector<std::array<double, 4>> sites(3 + draw.below(20));
    for (auto& site : sites) {
        for (int a = 0; a < 3; ++a) site[a] = draw.between(0, size[a]);
        site[3] = draw.between(1, 5);
    }
    const auto hash = [&](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
        std::uint64_t h = salt ^ (x * 0x9e3779b97f4a7c15 + y * 0xc2b2ae3d27d4eb4f + z * 0x165667b19e3779f9);
        h = (h ^ h >> 31) * 0xbf58476d1ce4e5b9;
        return static_cast<std::uint32_t>((h ^ h >> 29) >> 33) % labels;
    };
    std::vector<std::uint32_t> samples;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x) {
                std::uint32_t nearest = 0, inside = 0;
                double least = HUGE_VAL;
                for (std::uint32_t s = 0; s < sites.size(); ++s) {
                    const double square =
                        std::pow(x - sites[s][0], 2) + std::pow(y - sites[s][1], 2) + std::pow(z - sites[s][2], 2);
                    if (square < least) least = square, nearest = s;
                    if (square < sites[s][3] * sites[s][3]) inside = 1 + s;
                }
                switch (pattern) {
                    case Pattern::kNoise:
                        samples.push_back(draw.below(labels));
                        break;
                    case Pattern::kBlocks:
                        samples.push_back(hash(x / block, y / block, z / block));
                        break;
                    case Pattern::kFoam:
                        samples.push_back(nearest);
                        break;
                    case Pattern::kLayers:
                        samples.push_back((z + x * y / 16) / block % labels);
                        break;
                    case Pattern::kDust:
                        samples.push_back(draw.one_in(12) ? 1 + draw.below(labels) : 0);
                        break;
                    case Pattern::kBoard:
                        samples.push_back((x / block + y / block + z / block) % labels);
                        break;
                    case Pattern::kBalls:
                        samples.push_back(inside);
                        break;
                }
            }
    return samples;
}

// Options.

constexpr double kSpacings[] = {1, 0.5, 2.5, 0.1, 1.0 / 3, 7, 12.5, 1e-3};

Words draw_input(const Size& size, Draw& draw, double& finest) {
    Words words;
    finest = 1;
    double scale = 1, spacing[3] = {1, 1, 1};
    if (draw.one_in(2)) {
        if (draw.one_in(8)) scale = draw.one_in(2) ? 1e-9 : 1e5;
        for (double& value : spacing) value = draw.of(kSpacings) * scale;
        words.insert(words.end(),
                     {"--spacing", text_of(spacing[0]) + "," + text_of(spacing[1]) + "," + text_of(spacing[2])});
        finest = *std::min_element(spacing, spacing + 3);
    }
    constexpr const char* kSweeps[] = {"x", "y", "z"};
    if (draw.one_in(3)) words.insert(words.end(), {"--sweep", draw.of(kSweeps)});
    if (draw.one_in(12)) words.insert(words.end(), {"--downsample", draw.one_in(2) ? "2" : "1,2,1"});
    if (draw.one_in(12)) words.insert(words.end(), {"--min-region", std::to_string(1 + draw.below(12))});
    if (draw.one_in(12) && size[0] > 2)
        words.insert(words.end(), {"--roi", "1:" + std::to_string(2 + draw.below(size[0] - 2)) + ",:,:"});
    return words;
}

/// Decimation. True if the result may depend on --memory.
bool draw_decimation(Words& words, double finest, Draw& draw) {
    bool is_decimated = true;
    switch (draw.below(6)) {
        case 0:
            words.push_back("--no-decimate");
            is_decimated = false;
            break;
        case 1:
            words.insert(words.end(), {"--target-faces", std::to_string(draw.below(3000))});
            break;
        case 2:
            words.insert(words.end(), {"--max-error", text_of(finest * draw.between(0, 3))});
            break;
        case 3:
            words.insert(words.end(), {"--max-error", text_of(finest * draw.between(0, 3)), "--reduce", "80%"});
            break;
        default:
            words.insert(words.end(), {"--reduce", std::to_string(1 + draw.below(99)) + "%"});
            break;
    }
    if (!is_decimated) return false;
    if (draw.one_in(4)) words.insert(words.end(), {"--placement", "lindstrom-turk"});
    if (draw.one_in(6)) words.insert(words.end(), {"--perturbation", draw.one_in(2) ? "0" : "0.01"});
    if (draw.one_in(4)) words.insert(words.end(), {"--min-quality", text_of(draw.between(0, 0.26))});
    if (draw.one_in(4)) words.push_back("--improve");
    if (draw.one_in(4)) words.push_back("--smooth-lines");
    if (draw.one_in(6)) words.insert(words.end(), {"--edge-length", text_of(finest * draw.between(0.5, 6))});
    return true;
}

/// Smoothing. True if it keeps samples. Few of the options contradict each other, since such runs end at once.
bool draw_smoothing(Words& words, bool is_open, Draw& draw) {
    constexpr const char* kPresets[] = {"light", "normal", "strong", "1", "7", "30"};
    constexpr const char* kFilters[] = {"taubin", "laplacian", "nifpms"};
    const bool is_off = draw.one_in(6), may_contradict = draw.one_in(40);
    bool keeps_samples = true;
    if (is_off) {
        words.insert(words.end(), {"--smooth", draw.one_in(2) ? "off" : "0"});
    } else if (draw.one_in(2)) {
        words.insert(words.end(), {"--smooth", draw.of(kPresets)});
    }
    if (draw.one_in(5)) words.insert(words.end(), {"--room", text_of(draw.between(0, 3))});
    if (draw.one_in(6) && (!is_open || may_contradict)) words.push_back("--preserve-volume"), keeps_samples = false;
    if (is_off && !may_contradict) return keeps_samples;
    if (draw.one_in(3)) {
        words.insert(words.end(), {"--smooth-filter", draw.of(kFilters)});
        if (draw.one_in(3)) words.insert(words.end(), {"--smooth-lambda", text_of(draw.share())});
        keeps_samples = false;
    }
    if (draw.one_in(6)) words.push_back("--smooth-points"), keeps_samples = false;
    return keeps_samples;
}

/// Few samples, so that thousands of runs take minutes; sometimes a plane or a line of them.
Size draw_size(Draw& draw) {
    Size size{};
    const std::uint32_t most = draw.one_in(16) ? 6000 : 700;
    do {
        for (std::uint32_t& count : size) count = draw.one_in(6) ? 2 : 2 + draw.below(22);
    } while (size[0] * size[1] * size[2] > most);
    if (draw.one_in(60)) size[draw.below(3)] = 1;  // too few: refused
    return size;
}

}  // namespace

Case draw_case(std::mt19937_64& random) {
    Draw draw(random);
    Case made{};
    const Size size = draw_size(draw);
    const auto pattern = static_cast<Pattern>(draw.below(std::size(kPatterns)));
    made.text = std::string(kPatterns[static_cast<int>(pattern)]) + " " + std::to_string(size[0]) + " x " +
                std::to_string(size[1]) + " x " + std::to_string(size[2]);
    made.npy = npy_of(draw_samples(pattern, size, draw), size, draw, made.text);
    const auto has = [](const Words& words, const char* word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    made.is_open = draw.one_in(4);
    if (made.is_open) made.both = {"--boundary", "open"};
    if (draw.one_in(2)) made.both.push_back("--no-background");
    double finest = 1;
    made.input = draw_input(size, draw, finest);
    made.is_decimated = draw_decimation(made.options, finest, draw);
    made.keeps_samples = draw_smoothing(made.options, made.is_open, draw);
    made.has_room = has(made.options, "--room");
    if (made.is_decimated && draw.one_in(6)) made.options.push_back("--no-keep-samples"), made.keeps_samples = false;
    if (draw.one_in(20))
        made.options.insert(made.options.end(), {"--face-budget", std::to_string(1000 + draw.below(5000))});
    constexpr const char* kModels[] = {"m.vtp", "m.vtp", "m.vtu", "m.ply"};
    made.model = draw.of(kModels);
    made.threads = 2 + draw.below(2);
    constexpr double kMemories[] = {0, 0, 1, 1.2};
    made.memory = draw.of(kMemories);
    return made;
}

}  // namespace regionmesh::random
