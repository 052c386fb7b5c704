// Do faces round one vertex meet outside what they share?
#pragma once

#include <array>
#include <span>
#include <vector>

#include "regionmesh/base/ids.h"
#include "regionmesh/model/fan.h"
#include "regionmesh/model/label_set.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// Two faces, f < g.
struct FacePair {
    FaceId f, g;
    friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// Holds the scratch space of the test. Most stars are proved free of crossings as a whole: the faces of a label at a
/// vertex are a fan, and if they all look to one side of a direction and go round it once, seen along it they lie side
/// by side. Only pairs of faces that no such fan holds are looked at one by one, exactly.
class StarCrossing {
public:
    /// Adds each pair of faces at `v` that meet outside what they share and share no vertex before v: over all vertices
    /// each pair is found once. `corners` are the faces' corners at v.
    void find(const Model& model, VertexId v, std::span<const Corner> corners, std::vector<FacePair>& found);

private:
    /// A face seen from the vertex in its middle: a then b go round it.
    struct Page {
        FaceId face;
        VertexId a, b;
        std::array<Label, 2> labels;
        std::uint32_t proved;  // bit n: it lies in the fan of label n of labels_, which is free of crossings
    };
    /// The way from the vertex to a neighbour.
    struct Spoke {
        Vec3 to;
        double size;
    };
    /// The plane of a page, and the page in it.
    struct Plane {
        Vec3 normal;
        Spoke to_a, to_b;
        double doubt;

        /// The side on which a spoke lies; 0 where rounding may tell.
        int side(const Spoke& spoke) const;
    };

    void gather(const Model& model, std::span<const Corner> corners);
    bool is_interface() const;
    bool is_fan_simple(const Model& model, VertexId v, Label label);
    bool gather_spokes(const Model& model, VertexId v);
    bool goes_round_once();
    bool find_up(Vec3& up);
    bool all_look(Vec3 up) const;
    void test_pairs(const Model& model, VertexId v, std::vector<FacePair>& found);
    void gather_planes(const Model& model, VertexId v);
    bool are_pages_apart(std::size_t i, std::size_t j) const;

    std::vector<Page> pages_;
    LabelSet labels_;
    bool is_odd_ = false;  // a page has one label on both sides
    std::vector<FanPage> fan_;
    std::vector<Spoke> spokes_;  // where each page of the fan begins, and where the last one ends
    std::vector<Vec3> normals_;
    std::vector<double> weights_;
    std::vector<Plane> planes_;
};

}  // namespace regionmesh
