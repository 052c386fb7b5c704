// Writes a Voronoi foam as .npy, section by section: one seed in each cell of a grid, drawn at random; a sample has the
// label of the nearest seed in the 27 cells round it.
//
//   g++ -O3 -march=native -o foam bench/scale/foam.cpp
//   ./foam foam.npy 1024 1024 1024 32          samples along x, y, z, and along a cell: labels of 64 bits
//   ./foam wide.npy 16384 16384 8 256 uint8    labels 1 to 251, again and again
//
// The same arguments give the same bytes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr float kJitter = 0.9f;  // of a cell
constexpr std::uint64_t kSmallLabels = 251;

/// 64 bits that look random (splitmix64).
std::uint64_t mix(std::uint64_t n) {
    n += 0x9E3779B97F4A7C15;
    n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9;
    n = (n ^ (n >> 27)) * 0x94D049BB133111EB;
    return n ^ (n >> 31);
}

struct Foam {
    std::int64_t size[3], side;

    std::int64_t cells(int axis) const { return (size[axis] + side - 1) / side + 2; }  // one more on each side
    std::uint64_t label(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return static_cast<std::uint64_t>((k * cells(1) + j) * cells(0) + i) + 1;
    }
    /// Where the seed of a label lies along an axis, in its `cell`.
    float seed(std::uint64_t label, std::int64_t cell, int axis) const {
        const auto draw = static_cast<float>(static_cast<double>(mix(label * 3 + axis)) / 18446744073709551616.0);
        return (static_cast<float>(cell) - 0.5f + kJitter * (draw - 0.5f)) * static_cast<float>(side);
    }
};

/// The labels of one section.
void fill(const Foam& foam, std::int64_t z, std::vector<std::uint64_t>& section) {
    const auto width = static_cast<std::size_t>(foam.size[0]);
    std::vector<float> nearest(width);
    std::vector<std::uint64_t> labels(width);
    for (std::int64_t y = 0; y < foam.size[1]; ++y) {
        std::uint64_t* row = &section[static_cast<std::size_t>(y) * width];
        std::fill(nearest.begin(), nearest.end(), HUGE_VALF);
        const std::int64_t j0 = y / foam.side + 1, k0 = z / foam.side + 1;
        for (std::int64_t k = k0 - 1; k <= k0 + 1; ++k)
            for (std::int64_t j = j0 - 1; j <= j0 + 1; ++j)
                for (std::int64_t i = 0; i < foam.cells(0); ++i) {
                    const std::uint64_t label = foam.label(i, j, k);
                    const float sx = foam.seed(label, i, 0);
                    const float dy = static_cast<float>(y) - foam.seed(label, j, 1);
                    const float dz = static_cast<float>(z) - foam.seed(label, k, 2);
                    const float across = dy * dy + dz * dz;
                    const std::int64_t from = std::max<std::int64_t>((i - 2) * foam.side, 0);
                    const std::int64_t to = std::min((i + 1) * foam.side, foam.size[0]);
                    for (std::int64_t x = from; x < to; ++x) {
                        const float dx = static_cast<float>(x) - sx, distance = across + dx * dx;
                        if (distance < nearest[x]) nearest[x] = distance, row[x] = label;
                    }
                }
    }
}

bool write(std::FILE* file, const void* bytes, std::size_t count) {
    return std::fwrite(bytes, 1, count, file) == count;
}

std::string header(const Foam& foam, const char* type) {
    std::string text = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (" +
                       std::to_string(foam.size[2]) + ", " + std::to_string(foam.size[1]) + ", " +
                       std::to_string(foam.size[0]) + "), }";
    while ((10 + text.size() + 1) % 64) text += ' ';
    text += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(text.size() & 255);
    bytes += static_cast<char>(text.size() >> 8);
    return bytes + text;
}

}  // namespace

int main(int argc, char** argv) {
    const bool is_small = argc == 7 && std::string(argv[6]) == "uint8";
    if (argc != 6 && !is_small) return std::fprintf(stderr, "usage: foam FILE.npy X Y Z CELL [uint8]\n"), 2;
    Foam foam{};
    for (int axis = 0; axis < 3; ++axis) foam.size[axis] = std::atoll(argv[2 + axis]);
    foam.side = std::atoll(argv[5]);
    if (std::min({foam.size[0], foam.size[1], foam.size[2], foam.side}) < 1) return std::fprintf(stderr, "sizes\n"), 2;
    std::FILE* file = std::fopen(argv[1], "wb");
    const std::string head = header(foam, is_small ? "|u1" : "<u8");
    bool is_good = file && write(file, head.data(), head.size());
    std::vector<std::uint64_t> section(static_cast<std::size_t>(foam.size[0] * foam.size[1]));
    std::vector<std::uint8_t> bytes(is_small ? section.size() : 0);
    for (std::int64_t z = 0; is_good && z < foam.size[2]; ++z) {
        fill(foam, z, section);
        for (std::size_t n = 0; n < bytes.size(); ++n)
            bytes[n] = static_cast<std::uint8_t>(section[n] % kSmallLabels + 1);
        is_good = is_small ? write(file, bytes.data(), bytes.size()) : write(file, section.data(), section.size() * 8);
    }
    is_good = file && std::fclose(file) == 0 && is_good;
    return is_good ? 0 : (std::fprintf(stderr, "%s: cannot be written\n", argv[1]), 1);
}
