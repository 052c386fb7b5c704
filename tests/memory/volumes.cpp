#include "memory/volumes.h"

#include <cmath>
#include <fstream>
#include <random>
#include <vector>

namespace regionmesh::memory {
namespace {

using Random = std::mt19937_64;

/// A number from 0 to before `end`, the same on every system.
std::uint32_t draw(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); }

struct Site {
    double at[3];
    std::uint8_t label;
};

std::vector<Site> draw_sites(const Volume& volume, Random& random) {
    std::vector<Site> sites(60);
    for (Site& site : sites) {
        for (int a = 0; a < 3; ++a) site.at[a] = draw(random, volume.size[a]);
        site.label = static_cast<std::uint8_t>(1 + draw(random, 40));
    }
    return sites;
}

std::uint8_t nearest(const std::vector<Site>& sites, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    double least = HUGE_VAL;
    std::uint8_t label = 0;
    for (const Site& site : sites) {
        const double d[3] = {x - site.at[0], y - site.at[1], z - site.at[2]};
        const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (square < least) least = square, label = site.label;
    }
    return label;
}

}  // namespace

std::string Volume::text() const {
    constexpr const char* kNames[] = {"noise", "blocks", "cells", "layers", "band"};
    return std::string(kNames[static_cast<int>(pattern)]) + " " + std::to_string(size[0]) + " x " +
           std::to_string(size[1]) + " x " + std::to_string(size[2]);
}

void write_npy(const Volume& volume, const std::filesystem::path& path) {
    Random random(volume.seed);
    const std::vector<Site> sites = draw_sites(volume, random);
    std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(volume.size[2]) + ", " +
                         std::to_string(volume.size[1]) + ", " + std::to_string(volume.size[0]) + "), }";
    header.resize(117, ' ');
    header += '\n';
    std::ofstream file(path, std::ios::binary);
    file << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size()) << '\0' << header;
    for (std::uint32_t z = 0; z < volume.size[2]; ++z)
        for (std::uint32_t y = 0; y < volume.size[1]; ++y)
            for (std::uint32_t x = 0; x < volume.size[0]; ++x) {
                std::uint32_t label = 0;
                switch (volume.pattern) {
                    case Pattern::kNoise:
                        label = draw(random, 4);
                        break;
                    case Pattern::kBlocks:
                        label = (x / 5 * 7 + y / 4 * 3 + z / 6 * 11) % 23;
                        break;
                    case Pattern::kCells:
                        label = nearest(sites, x, y, z);
                        break;
                    case Pattern::kLayers:
                        label = 1 + (z + (x * y) / 64) / 5 % 9;
                        break;
                    case Pattern::kBand:
                        label = y * 4 < volume.size[1] ? draw(random, 4) : 4;
                        break;
                }
                file.put(static_cast<char>(label));
            }
}

}  // namespace regionmesh::memory
