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

    /// Notes a chunk that was added to the window: kinds of vertices, interfaces of faces.
    void add_chunk(std::uint32_t chunk);
    /// Makes the sites of the vertices of a chunk, with normals of their own faces. Requires that the chunk that
    /// follows is in the window, if there is one.
    void make(std::uint32_t chunk);
    /// Averages each normal of a chunk with those at the other corners of its faces. Pass 0 follows make() and pass 1
    /// follows pass 0 with one chunk in between.
    void average_normals(int pass, std::uint32_t chunk, std::uint32_t threads);
    static constexpr int kNormalPasses = 2;

    /// Of this vertex and the later ones.
    std::uint32_t first_of(std::uint32_t v) const { return first_site_[v]; }
    NumberRange of_vertex(std::uint32_t v) const { return {first_site_[v], first_site_[v + 1]}; }
    /// Requires that sites of this chunk are made.
    NumberRange of_chunk(std::uint32_t chunk) const {
        const NumberRange vertices = window_.vertices_of(chunk);
        return {first_site_[vertices.first], first_site_[vertices.end]};
    }
    const LatticeSite& operator[](std::uint32_t s) const { return sites_[s]; }
    int kind(std::uint32_t v) const { return kinds_[v]; }
    const LatticeFrame& frame() const { return frame_; }

    /// Releases vertices before `v`.
    void drop_before(std::uint32_t v);
    std::size_t bytes() const {
        return sites_.bytes() + first_site_.bytes() + kinds_.bytes() + interfaces_.bytes() + averaged_.bytes();
    }

private:
    static constexpr std::uint32_t kNoInterface = (1u << 27) - 1;

    std::uint32_t interface_of(std::array<Label, 2> labels);
    std::uint32_t site_of(std::uint32_t vertex, std::uint32_t interface) const;

    const SurfaceWindow& window_;
    LatticeFrame frame_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of interfaces, in order of first use
    std::uint64_t last_pair_ = 0;
    std::uint32_t last_number_ = kNoInterface;
    SlidingArray<std::uint8_t> kinds_;        // by vertex
    SlidingArray<std::uint32_t> interfaces_;  // by face
    SlidingArray<std::uint32_t> first_site_;  // by vertex, and one more
    SlidingArray<LatticeSite> sites_;
    SlidingArray<Float3> averaged_;  // by site: normals after pass 0
};

}  // namespace regionmesh
