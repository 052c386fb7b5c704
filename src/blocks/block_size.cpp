#include "blocks/block_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/megabytes.h"
#include "blocks/own_faces.h"
#include "cells/strip_mesher.h"
#include "regionmesh/error.h"
#include "smooth/filters/filter.h"
#include "stream/footprint.h"

namespace regionmesh {
namespace {

/// Blocks are not made smaller than this number of cells for memory: nearly all of their faces would be on the rim.
constexpr std::uint32_t kFewestCells = 64;
/// A block may have more faces than the mean.
constexpr double kUneven = 2;
/// Sections that the window of smoothing holds, about.
constexpr double kWindowSections = 64;
/// Sweeps for each process, at least, so that all end at about the same time.
constexpr std::uint32_t kSweepsPerProcess = 3;

/// Bytes that a process takes which sweeps over blocks of `uneven` times as many faces as the mean.
class SweepBytes {
public:
    SweepBytes(const SourceShape& shape, std::uint64_t faces, const ReconstructOptions& options,
               double uneven = kUneven)
        : shape_(shape), halo_(halo_of(shape, options)) {
        const auto& size = shape.lattice.size;
        faces_per_cell_ = uneven * static_cast<double>(faces) / (static_cast<double>(size[0]) * size[1] * size[2]);
        window_bytes_ =
            static_cast<double>(window_bytes_per_face(options.smooth.filter, faces_per_cell_, kWindowBytesPerFace));
    }

    /// Of a box of `cells` cells, in blocks of `block`: it holds the window of smoothing, one layer of blocks along the
    /// sweep, and one block that is simplified.
    double of(const std::array<double, 3>& cells, double block) const {
        double section = 1, sections = 0, layer = 1, one = 1;
        for (int n = 0; n < 3; ++n) {
            const int axis = shape_.sweep.axes[n];
            const double size = shape_.lattice.size[axis];
            const double with_halo = std::min(cells[axis] + 1 + 2.0 * halo_[axis], size);
            one *= std::min(block, size);
            layer *= std::min(n < 2 ? cells[axis] : block, size);
            if (n < 2)
                section *= with_halo;
            else
                sections = std::min(with_halo, kWindowSections);
        }
        constexpr double kPerSample = 2 * sizeof(Label) + static_cast<double>(StripMesher::kBytesPerSample);
        return static_cast<double>(kProcessBytes) + section * kPerSample +
               faces_per_cell_ *
                   (section * sections * window_bytes_ + layer * kChunkBytesPerFace + one * kTilesBytesPerFace);
    }

private:
    const SourceShape& shape_;
    std::array<std::uint32_t, 3> halo_;
    double faces_per_cell_, window_bytes_;
};

/// Boxes of `side` blocks, the last along each axis cut by the volume.
std::vector<IndexBox> boxes_of(const std::array<std::uint32_t, 3>& side, const std::array<std::uint32_t, 3>& counts) {
    std::vector<IndexBox> boxes;
    for (std::uint32_t z = 0; z < counts[2]; z += side[2])
        for (std::uint32_t y = 0; y < counts[1]; y += side[1])
            for (std::uint32_t x = 0; x < counts[0]; x += side[0])
                boxes.push_back({{x, y, z},
                                 {std::min(x + side[0], counts[0]), std::min(y + side[1], counts[1]),
                                  std::min(z + side[2], counts[2])}});
    return boxes;
}

}  // namespace

std::uint32_t default_block_cells(const SourceShape& shape, std::uint64_t faces, const ReconstructOptions& options) {
    const SweepBytes bytes(shape, faces, options);
    const auto& size = shape.lattice.size;
    const std::uint32_t longest = std::max({size[0], size[1], size[2]}) - 1;
    std::uint32_t cells = std::max(longest, kFewestCells);
    const auto fits = [&](double side) {
        return bytes.of({side, side, side}, side) <= static_cast<double>(options.memory);
    };
    while (cells > kFewestCells && !fits(cells)) cells = cells * 15 / 16;
    cells = std::max(cells, kFewestCells);
    const std::uint32_t count = (longest + cells - 1) / cells;
    return std::max((longest + count - 1) / count, 2u);
}

void require_block_memory(const std::string& source, const SourceShape& shape, std::uint64_t faces, std::uint32_t cells,
                          const ReconstructOptions& options) {
    const double side = cells, needed = SweepBytes(shape, faces, options, 1).of({side, side, side}, side);
    if (needed <= static_cast<double>(options.memory)) return;
    throw Error(
        ErrorCode::kInput,
        fmt::format("{}: {} needs at least {} in blocks of {} cells; raise --memory to that, or try another "
                    "--block-size in a new folder",
                    memory_limit_text(options.memory), source, megabytes(static_cast<std::uint64_t>(needed)), cells));
}

std::vector<IndexBox> plan_sweeps(const BlockGrid& grid, const SourceShape& shape, std::uint64_t faces,
                                  const ReconstructOptions& options, std::uint32_t processes) {
    const SweepBytes bytes(shape, faces, options);
    const double block = std::ranges::max(grid.cells({{0, 0, 0}, {1, 1, 1}}).size());
    const auto [u, v, w] = shape.sweep.axes;
    const std::array<std::uint32_t, 3> counts = grid.counts();
    std::array<std::uint32_t, 3> side = counts;
    std::vector<IndexBox> sweeps = boxes_of(side, counts);
    for (;;) {
        const auto cells = grid.cells(sweeps.front()).size();
        const bool is_fit =
            (side[u] == 1 && side[v] == 1) || bytes.of({double(cells[0]), double(cells[1]), double(cells[2])}, block) <=
                                                  static_cast<double>(options.memory);
        if (is_fit && (processes == 1 || sweeps.size() >= std::size_t{processes} * kSweepsPerProcess)) return sweeps;
        // Memory is needed across the sweep alone.
        int longest = side[v] > side[u] ? v : u;
        if (is_fit && side[w] > side[longest]) longest = w;
        if (side[longest] == 1) return sweeps;
        side[longest] = (side[longest] + 1) / 2;
        sweeps = boxes_of(side, counts);
    }
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
