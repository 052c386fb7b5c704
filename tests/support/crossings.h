// Crossing faces as everybody understands them: all pairs, one by one.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "regionmesh/model/crossing.h"
#include "regionmesh/base/exact_predicates.h"

namespace regionmesh::test {

inline std::ostream& operator<<(std::ostream& out, const FacePair& pair) { return out << index(pair.f) << "-" << index(pair.g); }

inline std::vector<FacePair> crossings_by_brute_force(const Model& model) {
    std::vector<FacePair> found;
    const auto has_area = [&](FaceId f) {
        if (!model.is_alive(f)) return false;
        const auto p = model.corners(f);
        return !is_degenerate({p[0], p[1], p[2]});
    };
    for (FaceId f{0}; index(f) < model.face_end(); f = FaceId{index(f) + 1})
        for (FaceId g{index(f) + 1}; index(g) < model.face_end(); g = FaceId{index(g) + 1})
            if (has_area(f) && has_area(g) && meet_outside_shared({model[f].vertices, model.corners(f)}, {model[g].vertices, model.corners(g)}))
                found.push_back({f, g});
    return found;
}

inline std::vector<FacePair> crossings_in(const Model& model, std::uint32_t threads = 1) {
    return find_crossings(model, SortedFaceTree(model, threads), threads);
}

/// Requires a model without free places.
inline std::vector<LabelledFace> listed_faces(const Model& model) {
    std::vector<LabelledFace> faces;
    for (std::uint32_t f = 0; f < model.face_end(); ++f)
        faces.push_back({{model[FaceId{f}].vertices, model.corners(FaceId{f})}, model[FaceId{f}].labels});
    return faces;
}

/// Both searches must say what brute force says; returns how many pairs cross.
inline std::size_t expect_all_crossings_found(const Model& model) {
    const std::vector<FacePair> expected = crossings_by_brute_force(model);
    EXPECT_EQ(crossings_in(model), expected);
    EXPECT_EQ(find_crossings(listed_faces(model), 1), expected);
    return expected.size();
}

}  // namespace regionmesh::test
