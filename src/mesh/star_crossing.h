// Do faces around one vertex meet outside shared vertices and edges?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_meeting.h"
#include "mesh/fan.h"
#include "mesh/label_set.h"
#include "regionmesh/ids.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Two faces, f < g.
struct FacePair {
    FaceId f, g;
    friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// A face seen from the central vertex: its other corners a, b in order around the vertex.
struct StarPage {
    FaceId face;
    VertexId a, b;
    Vec3 at_a, at_b;
    std::array<Label, 2> labels;
};

/// Holds the scratch space of the test. Most stars are proved free of crossings as a whole: the faces of a label at a
/// vertex form a fan; if all normals have a positive component along some direction and the fan turns once around it,
/// the projections along it do not overlap. Only pairs outside such fans are tested one by one, exactly.
class StarCrossing {
public:
    /// Adds each pair of faces of the (given part of the) star of v that meet outside shared vertices and edges and
    /// share no vertex before v, so that over all vertices each pair is found once. Leaves out faces without area.
    void find(VertexId v, Vec3 at, std::span<const StarPage> pages, std::vector<FacePair>& found);

    /// Is it proved that no two faces of a fan round a vertex meet outside shared vertices and edges? rim(n) is where
    /// the n-th neighbour is, in order, up to n = faces; that of a closed fan ends where it begins.
    template <class Rim>
    bool is_simple(Vec3 at, std::size_t faces, bool is_closed, Rim&& rim);

private:
    /// The vector from the vertex to a neighbour.
    struct Spoke {
        Vec3 to;
        double size;
    };
    /// A page and its plane.
    struct Plane {
        Vec3 normal;
        Spoke to_a, to_b;

        /// The side on which a spoke lies; 0 within the rounding error.
        int side(const Spoke& spoke) const;
    };

    bool is_interface() const;
    void gather_labels();
    bool is_fan_simple(Label label);
    bool goes_round_once(bool is_closed);
    bool find_up();
    bool all_face_up() const;
    void test_pairs(VertexId v, std::vector<FacePair>& found);
    void gather_planes();
    bool are_apart(std::size_t i, std::size_t j) const;
    bool is_off(std::size_t i, std::size_t j) const;
    bool cross_exactly(VertexId v, const StarPage& f, const StarPage& g) const;

    Vec3 at_;
    std::span<const StarPage> pages_;
    LabelSet labels_;
    bool is_odd_ = false;                // some page has one label on both sides
    std::vector<std::uint32_t> proved_;  // one per page; bit n: its fan of label n of labels_ is free of crossings
    std::vector<FanPage> fan_;
    std::size_t count_ = 0;      // number of pages of the fan whose spokes and normals are held
    std::vector<Spoke> spokes_;  // spokes to the link: one more than pages
    std::vector<Vec3> normals_;
    Vec3 up_;
    std::vector<double> weights_;
    std::vector<Plane> planes_;
};

/// Sizes for which no product of four overflows, or loses much more than the rounding error by underflow.
inline bool is_usual(double size) { return (size > 1e-60) & (size < 1e60); }

/// Gathers spokes, normals and their sum in one pass. The arrays keep the size of the largest fan.
template <class Rim>
bool StarCrossing::is_simple(Vec3 at, std::size_t faces, bool is_closed, Rim&& rim) {
    count_ = faces;
    if (normals_.size() < faces) normals_.resize(faces), spokes_.resize(faces + 1);
    Vec3 before = rim(0) - at;
    spokes_[0] = {before, size_of(before)};
    bool usual = is_usual(spokes_[0].size);
    up_ = Vec3{};
    for (std::size_t n = 0; n < faces; ++n) {
        const Vec3 to = rim(n + 1) - at;
        spokes_[n + 1] = {to, size_of(to)};
        usual &= is_usual(spokes_[n + 1].size);
        normals_[n] = cross(before, to);
        up_ += normals_[n];
        before = to;
    }
    return usual && goes_round_once(is_closed);
}

}  // namespace regionmesh
