// Vertices as each interface sees them: what the fits of the lattice filter are made from.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/sliding_array.h"
#include "smooth/lattice_point.h"
#include "smooth/lattice_simplex.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// A vertex in one interface between two regions. A vertex of an interface has one, of a triple line three, of a
/// quadruple point six.
struct LatticeSite {
    LatticePoint centroid;  // of its simplex, in finest spacings from the origin of the lattice
    Float3 normal;          // of the unsmoothed interface near by, unit length; from the first label to the second
    std::uint32_t interface : 27;  // number of its pair of labels
    std::uint32_t kind : 5;        // of its simplex
};

/// The sites of the vertices in a window. Sites of a vertex, and of a chunk, have consecutive numbers. Faces with the
/// exterior have no sites: the box is plane.
class LatticeSites {
public:
    LatticeSites(const SurfaceWindow& window, const LatticeFrame& frame) : window_(window), frame_(frame) {
        first_site_.push_back(0);
    }

    /// Makes the sites of a chunk that was added to the window, and adds its faces to the normals of their vertices.
    void add_chunk(std::uint32_t chunk);
    /// Ends the sums of normals of a chunk. Requires that the chunk that follows was added, if there is one.
    void end_normals(std::uint32_t chunk);
    /// Averages each normal of a chunk with those at the other corners of its faces. Pass 0 follows end_normals() and
    /// pass 1 follows pass 0 with one chunk in between.
    void average_normals(int pass, std::uint32_t chunk);
    static constexpr int kNormalPasses = 2;

    /// Of this vertex and the later ones.
    std::uint32_t first_of(std::uint32_t v) const { return first_site_[v]; }
    NumberRange of_vertex(std::uint32_t v) const { return {first_site_[v], first_site_[v + 1]}; }
    NumberRange of_chunk(std::uint32_t chunk) const {
        const NumberRange vertices = window_.vertices_of(chunk);
        return {first_site_[vertices.first], first_site_[vertices.end]};
    }
    /// A vertex of k labels has as many sites as there are pairs of them; where a model leaves out regions, fewer are
    /// used.
    bool is_used(std::uint32_t s) const { return sites_[s].interface != kNoInterface; }
    const LatticeSite& operator[](std::uint32_t s) const { return sites_[s]; }
    int kind(std::uint32_t v) const { return kinds_[v]; }
    const LatticeFrame& frame() const { return frame_; }

    /// Releases vertices before `v`.
    void drop_before(std::uint32_t v);
    std::size_t bytes() const {
        return sites_.bytes() + first_site_.bytes() + kinds_.bytes() + corners_.bytes() + sums_[0].bytes() +
               sums_[1].bytes();
    }

private:
    static constexpr std::uint32_t kNoInterface = (1u << 27) - 1;
    /// The sites of the corners of a face; the first is kNoSite for a face with the exterior.
    using CornerSites = std::array<std::uint32_t, 3>;
    static constexpr std::uint32_t kNoSite = ~0u;

    void add_vertex(std::uint32_t v);
    CornerSites add_face(const ChunkFace& face);
    std::uint32_t interface_of(std::array<Label, 2> labels);
    std::uint32_t site_of(std::uint32_t vertex, std::uint32_t interface);
    void add_up(int pass, std::uint32_t chunk);

    const SurfaceWindow& window_;
    LatticeFrame frame_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of interfaces, in order of first use
    std::uint64_t last_pair_ = 0;
    std::uint32_t last_number_ = kNoInterface;
    SlidingArray<std::uint8_t> kinds_;        // by vertex
    SlidingArray<CornerSites> corners_;       // by face
    SlidingArray<std::uint32_t> first_site_;  // by vertex, and one more
    SlidingArray<LatticeSite> sites_;
    SlidingArray<Float3> sums_[kNormalPasses];  // by site; after a pass unit normals
};

}  // namespace regionmesh
