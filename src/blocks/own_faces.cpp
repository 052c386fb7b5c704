#include "blocks/own_faces.h"

#include "blocks/gather.h"
#include "regionmesh/error.h"
#include "smooth/lattice_smoother.h"
#include "stream/run_log.h"
#include "stream/stage_options.h"
#include "stream/strips.h"

namespace regionmesh {
namespace {

/// Takes the faces of the block out of strips that come one after the other.
class Taker {
public:
    Taker(const BlockGrid& grid, std::uint32_t block) : grid_(grid), block_(block) {}

    void add(const Chunk& strip) {
        states_.resize(strip.carried);
        states_.resize(strip.carried + strip.vertices.size());
        for (const ChunkFace& face : strip.faces) add(strip, face);
        std::vector<State> next;
        next.reserve(strip.active.size());
        for (std::uint32_t local : strip.active) {
            State state = states_[local];
            if (local >= strip.carried) state.vertex = strip.vertices[local - strip.carried];
            next.push_back(state);
        }
        states_ = std::move(next);
    }

    Chunk take() {
        for (std::uint32_t v = 0; v < is_shared_.size(); ++v)
            if (is_shared_[v]) own_.active.push_back(v);
        return std::move(own_);
    }

private:
    static constexpr std::uint32_t kNone = ~0u;

    struct State {
        ChunkVertex vertex;            // of carried ones
        std::uint32_t number = kNone;  // in the block, if it has a face there
        bool is_foreign = false;       // has a face of another block
    };

    const ChunkVertex& vertex(const Chunk& strip, std::uint32_t local) const {
        return local < strip.carried ? states_[local].vertex : strip.vertices[local - strip.carried];
    }

    void add(const Chunk& strip, const ChunkFace& face) {
        const auto& v = face.vertices;
        const bool is_own = block_of(grid_, {vertex(strip, v[0]).position, vertex(strip, v[1]).position,
                                             vertex(strip, v[2]).position}) == block_;
        for (std::uint32_t local : v) note(strip, local, is_own);
        if (is_own)
            own_.faces.push_back({{states_[v[0]].number, states_[v[1]].number, states_[v[2]].number}, face.labels});
    }

    void note(const Chunk& strip, std::uint32_t local, bool is_own) {
        State& state = states_[local];
        if (is_own && state.number == kNone) {
            state.number = static_cast<std::uint32_t>(own_.vertices.size());
            own_.vertices.push_back(vertex(strip, local));
            is_shared_.push_back(false);
        }
        state.is_foreign = state.is_foreign || !is_own;
        if (state.is_foreign && state.number != kNone) is_shared_[state.number] = true;
    }

    const BlockGrid& grid_;
    std::uint32_t block_;
    Chunk own_;
    std::vector<bool> is_shared_;
    std::vector<State> states_;  // by number in the strip
};

}  // namespace

std::array<std::uint32_t, 3> halo_of(const SourceShape& shape, const ReconstructOptions& options) {
    if (options.smooth.passes == 0) return {1, 1, 1};
    if (options.smooth.filter != SmoothFilter::kLattice)
        throw Error(ErrorCode::kInput, shape.name +
                                           ": blocks are smoothed inside the lattice or not at all; leave out "
                                           "--smooth-filter, or give none");
    return lattice_reach(smooth_options(options, shape.scale), {shape.lattice.origin, shape.lattice.spacing});
}

Chunk own_faces(const BlockVolume& volume, const BlockGrid& grid, std::uint32_t block,
                const ReconstructOptions& options) {
    const SourceShape& shape = volume.shape;
    const IndexBox samples = samples_with_halo(grid.cells(block), halo_of(shape, options), shape.lattice.size);
    BlockFaces source(volume, samples);
    Reconstruction unused;
    const OnProgress silent;
    RunLog log(unused, silent);
    ChunkOrder order = strip_order(source.shape(), 0);
    order.wanted = grid.limits(block);
    Strips strips(source, smooth_options(options, shape.scale), order, log);
    Taker taker(grid, block);
    for (Chunk strip; strips.next(strip);) taker.add(strip);
    return taker.take();
}

}  // namespace regionmesh
