// The sides of the planes of a new star that a point lies on.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/edge_star.h"

namespace regionmesh {

/// The planes of up to 32 new faces beyond which something lies for certain: one bit a face.
struct Sides {
    std::uint32_t link = 0;   // beyond the plane through the link edge, square to the face
    std::uint32_t a = 0;      // beyond the one through the edge from the merged vertex to a
    std::uint32_t b = 0;      // and to b
    std::uint32_t above = 0;  // the face's own plane, where its normal points
    std::uint32_t below = 0;

    friend Sides operator&(const Sides& s, const Sides& t) {
        return {s.link & t.link, s.a & t.a, s.b & t.b, s.above & t.above, s.below & t.below};
    }
    friend Sides operator|(const Sides& s, const Sides& t) {
        return {s.link | t.link, s.a | t.a, s.b | t.b, s.above | t.above, s.below | t.below};
    }
    /// For these faces only.
    Sides of(std::uint32_t faces) const { return *this & Sides{faces, faces, faces, faces, faces}; }
    std::uint32_t any() const { return link | a | b | above | below; }
};

/// The planes of the new faces, as floats relative to the merged vertex. Conservative: reports a side only outside the
/// rounding error. A face whose three corners lie beyond one plane of a new face does not meet it. A corner that the
/// plane passes through, since both faces have it, may be counted as beyond: then they meet in such corners only.
class StarPlanes {
public:
    static constexpr int kMost = 32;

    /// For new faces first .. first + count - 1, count <= kMost, with the normals of set_normals.
    void prepare(const EdgeStar& star, Vec3 position, int first, int count);
    Sides sides_of(Vec3 p) const { return find_sides<false>(p); }
    /// The opposite sides: before the planes through edges, and the other side of the face's own.
    Sides far_sides_of(Vec3 p) const { return find_sides<true>(p); }
    /// A bit for each face.
    std::uint32_t all() const { return all_; }

private:
    /// Planes of four faces. Each `out` is of size 1, so that one doubt serves for all.
    struct Planes {
        Lanes3<Float4> link, a, b, own;
        Float4 link_offset, link_doubt;
    };

    template <bool kIsFar>
    Sides find_sides(Vec3 p) const;

    Vec3 position_;
    double scale_ = 1;  // of the star's size: its inverse
    std::vector<Planes> planes_;
    std::uint32_t all_ = 0;
};

}  // namespace regionmesh
