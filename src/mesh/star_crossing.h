// Do faces round one vertex meet outside what they share?
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

/// A face seen from the vertex in its middle: a then b go round it.
struct StarPage {
    FaceId face;
    VertexId a, b;
    Vec3 at_a, at_b;
    std::array<Label, 2> labels;
};

/// Holds the scratch space of the test. Most stars are proved free of crossings as a whole: the faces of a label at a
/// vertex are a fan, and if they all look to one side of a direction and go round it once, seen along it they lie side
/// by side. Only pairs of faces that no such fan holds are looked at one by one, exactly.
class StarCrossing {
public:
    /// Adds each pair of faces of the star of v, or what is given of it, that meet outside what they share and share no
    /// vertex before v: over all vertices each pair is found once. Faces without area meet none.
    void find(VertexId v, Vec3 at, std::span<const StarPage> pages, std::vector<FacePair>& found);

private:
    /// The way from the vertex to a neighbour.
    struct Spoke {
        Vec3 to;
        double size;
    };
    /// The plane of a page, and the page in it.
    struct Plane {
        Vec3 normal;
        Spoke to_a, to_b;

        /// The side on which a spoke lies; 0 where rounding may tell.
        int side(const Spoke& spoke) const;
    };

    bool is_interface() const;
    void gather_labels();
    bool is_fan_simple(Label label);
    bool gather_spokes();
    bool goes_round_once();
    bool find_up(Vec3& up);
    bool all_look(Vec3 up) const;
    void test_pairs(VertexId v, std::vector<FacePair>& found);
    void gather_planes();
    bool are_apart(std::size_t i, std::size_t j) const;
    bool is_off(std::size_t i, std::size_t j) const;
    bool cross_exactly(VertexId v, const StarPage& f, const StarPage& g) const;

    Vec3 at_;
    std::span<const StarPage> pages_;
    LabelSet labels_;
    bool is_odd_ = false;                // a page has one label on both sides
    std::vector<std::uint32_t> proved_;  // by page; bit n: its fan of label n of labels_ is free of crossings
    std::vector<FanPage> fan_;
    std::vector<Spoke> spokes_;  // where each page of the fan begins, and where the last one ends
    std::vector<Vec3> normals_;
    std::vector<double> weights_;
    std::vector<Plane> planes_;
};

}  // namespace regionmesh
