// Reconstructs blocks: the faces of their own cells, smoothed as in the whole volume.
#pragma once

#include <deque>

#include "blocks/block_faces.h"
#include "blocks/block_grid.h"
#include "regionmesh/reconstruct.h"
#include "stream/run_log.h"
#include "stream/strips.h"

namespace regionmesh {

/// Samples that are read round a block, so that its own faces are those of the whole volume, bit for bit. Throws
/// Error(kInput) for a filter that looks farther than a bounded number of samples.
std::array<std::uint32_t, 3> halo_of(const SourceShape& shape, const ReconstructOptions& options);

/// Gives the faces of consecutive strips to the blocks of a box, one layer of blocks along the sweep after the other.
class FacesByBlock {
public:
    /// `blocks` is in blocks of the grid.
    FacesByBlock(const BlockGrid& grid, const IndexBox& blocks, int axis);

    void add(const Chunk& strip);
    /// The faces of a block of the first layer; layers end in their order.
    Chunk take(std::uint32_t block);
    void end_layer();

private:
    static constexpr std::uint32_t kNone = ~0u;

    /// One block's number of a vertex, or (kNone) that a face outside of the open layers uses it.
    struct Use {
        std::uint32_t block, number, next;
    };
    struct State {
        ChunkVertex vertex;          // of carried ones
        std::uint32_t uses = kNone;  // the first of its list
    };
    struct Own {
        Chunk faces;
        std::vector<bool> is_shared;
    };

    Own* find(std::uint32_t block);
    const ChunkVertex& vertex(const Chunk& strip, std::uint32_t local) const;
    std::uint32_t number(const Chunk& strip, std::uint32_t local, std::uint32_t block, Own* own);
    void carry(const Chunk& strip);

    const BlockGrid& grid_;
    IndexBox blocks_;
    int axis_;
    std::uint32_t layer_size_;
    std::deque<Own> open_;       // layer by layer, from blocks_.low[axis_]
    std::vector<State> states_;  // by number in the strip
    std::vector<Use> uses_;
};

/// The blocks of a box, which are swept together: those beside each other share what their halos have in common. Holds
/// one layer of blocks, and the window of smoothing.
class OwnFaces {
public:
    /// `blocks` is in blocks of the grid. All arguments must outlive it.
    OwnFaces(const BlockVolume& volume, const BlockGrid& grid, const IndexBox& blocks,
             const ReconstructOptions& options);

    /// The next block, layer by layer along the sweep, and the faces whose centroids lie in it, as a chunk that carries
    /// nothing. Its active vertices are those that faces of other blocks share, in increasing order. Positions and
    /// order are those of the whole, bit for bit: the box does not matter. Nothing after the last block.
    std::optional<std::uint32_t> next(Chunk& faces);

private:
    void read_layer();

    const BlockGrid& grid_;
    IndexBox blocks_, samples_;
    int axis_;
    Reconstruction unused_;
    OnProgress silent_;
    RunLog log_{unused_, silent_};
    BlockFaces source_;
    Strips strips_;
    FacesByBlock faces_;
    std::vector<std::uint32_t> ready_;  // blocks of the layer, the next one last
};

}  // namespace regionmesh
