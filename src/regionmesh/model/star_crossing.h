// Do faces round one vertex meet outside what they share?
#pragma once

#include <span>
#include <vector>

#include "regionmesh/base/ids.h"
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
        Vec3 to_a, to_b;
        std::array<Label, 2> labels;
        std::uint32_t proved;  // bit n: the fan of its label labels_[n] is free of crossings
    };
    /// A page as a label sees it: from `first` to `second`.
    struct FanPage {
        VertexId first, second;
        Vec3 to_first, to_second;
    };

    bool gather(const Model& model, VertexId v, std::span<const Corner> corners);
    void gather_fan(Label label);
    bool is_fan_simple();
    bool order_fan();
    bool goes_round_once() const;
    void test_pairs(const Model& model, VertexId v, std::vector<FacePair>& found) const;

    std::vector<Page> pages_;
    std::vector<FanPage> fan_;
    LabelSet labels_;
};

}  // namespace regionmesh
