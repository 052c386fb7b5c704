// Vertices as each interface sees them: what the fits of the lattice filter are made from.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/sliding_array.h"
#include "base/sliding_pages.h"
#include "smooth/lattice/lattice_point.h"
#include "smooth/packed_chunks.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// A vertex in one interface between two regions. A vertex of an interface has one, of a triple line three, of a
/// quadruple point six.
struct LatticeSite {
    LatticePoint centroid;  // centroid of its simplex
    std::uint32_t code;     // interface() and kind(), which are loaded four at a time with what is beside them
    Float3 normal;  // normal of the unsmoothed interface near by, unit length; from the first label to the second

    static constexpr int kKindBit = 27;
    static constexpr std::uint32_t kInterfaceMask = (1u << kKindBit) - 1;
    /// The number of its pair of labels.
    std::uint32_t interface() const { return code & kInterfaceMask; }
    /// Of its simplex.
    std::uint8_t kind() const { return static_cast<std::uint8_t>(code >> kKindBit); }
};
static_assert(sizeof(LatticeSite) == 28);

/// The sites of the vertices of chunks, which are numbered from 0 in the order in which they are added. Sites of a
/// vertex, and of a chunk, have consecutive numbers. Faces with the exterior have no sites: the box is plane.
class LatticeSites {
public:
    explicit LatticeSites(const LatticeFrame& frame) : frame_(frame), steps_(frame.spacing / frame.finest()) {
        starts_.push_back({0, 0});
    }

    /// A vertex of k labels has as many sites as there are pairs of them; where a model leaves out regions, fewer are
    /// used.
    static std::uint32_t count_of(const LatticeSimplex& simplex) {
        constexpr std::uint32_t kPairs[] = {0, 0, 1, 3, 6};  // by labels
        return kPairs[simplex.node_count()];
    }

    /// Makes the sites of the chunk that follows, and adds its faces to the normals of their vertices. Throws
    /// Error(kInput) where positions do not fit a LatticePoint.
    void add(const Chunk& chunk, std::span<const LatticeVertex> vertices);
    /// Ends the sums of normals of a chunk. Requires that the chunk that follows was added, if there is one.
    void end_normals(std::uint32_t chunk);
    /// Averages each normal of a chunk with those at the other corners of its faces. Pass 0 follows end_normals() and
    /// pass 1 follows pass 0 with one chunk in between.
    void average_normals(int pass, std::uint32_t chunk);
    static constexpr int kNormalPasses = 2;

    NumberRange of_chunk(std::uint32_t chunk) const { return {starts_[chunk].site, starts_[chunk + 1].site}; }
    bool is_used(std::uint32_t s) const { return sites_[s].interface() != kNoInterface; }
    const LatticeSite& operator[](std::uint32_t s) const { return sites_[s]; }
    const LatticeFrame& frame() const { return frame_; }

    /// Releases sites before this one, whose normals are averaged.
    void drop_before(std::uint32_t site) { sites_.drop_before(site); }
    /// of_chunk() is not asked for chunks before this one any more.
    void drop_chunks_before(std::uint32_t chunk) { starts_.drop_before(chunk); }
    std::size_t bytes() const { return sites_.bytes() + corners_.bytes() + sums_[0].bytes() + sums_[1].bytes(); }

private:
    static constexpr std::uint32_t kNoInterface = LatticeSite::kInterfaceMask;
    using CornerSites = std::array<std::uint32_t, 3>;
    struct Start {
        std::uint32_t site, face;
    };
    /// A vertex of the chunk that is added, or carried to it.
    struct Local {
        Vec3 position;
        NumberRange sites;
    };

    void add_vertex(const ChunkVertex& vertex, const LatticeSimplex& simplex);
    void add_face(const ChunkFace& face);
    std::uint32_t interface_of(std::array<Label, 2> labels);
    std::uint32_t site_of(const Local& vertex, std::uint32_t interface);
    void add_up(int pass, std::uint32_t chunk);
    std::uint32_t chunk_end() const { return starts_.end() - 1; }

    LatticeFrame frame_;
    LatticeSteps steps_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // numbers of interfaces, in order of first use
    std::uint64_t last_pair_ = 0;
    std::uint32_t last_number_ = kNoInterface;
    std::vector<Local> locals_;          // locals of the last chunk that was added
    SlidingArray<Start> starts_;         // starts of chunks, and of the next one
    SlidingPages<CornerSites> corners_;  // one per face with sites
    SlidingPages<LatticeSite> sites_;
    SlidingPages<Float3> sums_[kNormalPasses];  // by site; after a pass unit normals
};

}  // namespace regionmesh
