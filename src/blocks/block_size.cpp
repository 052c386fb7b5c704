#include "blocks/block_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "blocks/own_faces.h"
#include "cells/strip_mesher.h"
#include "regionmesh/error.h"
#include "stream/footprint.h"

namespace regionmesh {
namespace {

/// Blocks are not made smaller than this number of cells for memory: nearly all of their faces would be on the rim.
constexpr std::uint32_t kFewestCells = 64;
/// Bytes for each face of a block before simplification, and for each in the window of smoothing.
constexpr double kBlockBytesPerFace = kChunkBytesPerFace + kTilesBytesPerFace, kWindowBytes = 64;
/// A block may have more faces than the mean.
constexpr double kUneven = 2;
/// Sections that the window of smoothing holds, about.
constexpr double kWindowSections = 64;
/// Most blocks.
constexpr double kMostBlocks = 10e6;

}  // namespace

std::uint32_t default_block_cells(const SourceShape& shape, std::uint64_t faces, const ReconstructOptions& options) {
    const auto& size = shape.lattice.size;
    const double samples = static_cast<double>(size[0]) * size[1] * size[2];
    const double density = static_cast<double>(faces) / samples;
    const std::array<std::uint32_t, 3> halo = halo_of(shape, options);
    const auto bytes = [&](double cells) {
        double with_halo[3], section = 1, block = 1;
        for (int n = 0; n < 3; ++n) {
            const int axis = shape.sweep.axes[n];
            with_halo[n] = std::min(cells + 1 + 2.0 * halo[axis], static_cast<double>(size[axis]));
            block *= std::min(cells, static_cast<double>(size[axis]));
            if (n < 2) section *= with_halo[n];
        }
        const double per_sample = 2 * sizeof(Label) + static_cast<double>(StripMesher::kBytesPerSample);
        return static_cast<double>(kProcessBytes) + section * per_sample +
               kUneven * density *
                   (block * kBlockBytesPerFace + section * std::min(kWindowSections, with_halo[2]) * kWindowBytes);
    };
    const std::uint32_t longest = std::max({size[0], size[1], size[2]}) - 1;
    std::uint32_t cells = std::max(longest, kFewestCells);
    while (cells > kFewestCells && bytes(cells) > static_cast<double>(options.memory)) cells = cells * 15 / 16;
    cells = std::max(cells, kFewestCells);
    const std::uint32_t count = (longest + cells - 1) / cells;
    return std::max((longest + count - 1) / count, 2u);
}

void require_block_count(const VolumeInfo& volume, std::uint32_t cells) {
    double count = 1;
    for (const std::uint32_t size : volume.lattice.size) count *= std::ceil((size - 1.0) / cells) + 1;
    if (count > kMostBlocks)
        throw Error(ErrorCode::kInput, fmt::format("{}: blocks of {} cells are up to {:.0f}, more than {:.0f}; give a "
                                                   "larger --block-size",
                                                   volume.source, cells, count, kMostBlocks));
}

}  // namespace regionmesh
