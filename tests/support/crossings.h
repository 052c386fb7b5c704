// Crossing faces as everybody understands them: all pairs, one by one.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "base/exact_predicates.h"
#include "check/crossing_faces.h"
#include "regionmesh/check.h"

namespace regionmesh::test {

inline std::ostream& operator<<(std::ostream& out, const FacePair& pair) {
    return out << index(pair.f) << "-" << index(pair.g);
}

inline std::vector<FacePair> crossings_by_brute_force(const Mesh& mesh) {
    std::vector<FacePair> found;
    const auto has_area = [&](FaceId f) {
        if (!mesh.is_alive(f)) return false;
        const auto p = mesh.corners(f);
        return !is_degenerate({p[0], p[1], p[2]});
    };
    for (FaceId f{0}; index(f) < mesh.face_end(); f = FaceId{index(f) + 1})
        for (FaceId g{index(f) + 1}; index(g) < mesh.face_end(); g = FaceId{index(g) + 1})
            if (has_area(f) && has_area(g) &&
                meet_outside_shared({mesh[f].vertices, mesh.corners(f)}, {mesh[g].vertices, mesh.corners(g)}))
                found.push_back({f, g});
    return found;
}

inline std::vector<FacePair> crossings_in(const Mesh& mesh, std::uint32_t threads = 1) {
    return find_crossings(mesh, SortedFaceTree(mesh, threads), threads);
}

/// Requires a model without free places.
inline std::vector<LabelledFace> listed_faces(const Mesh& mesh) {
    std::vector<LabelledFace> faces;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        faces.push_back({{mesh[FaceId{f}].vertices, mesh.corners(FaceId{f})}, mesh[FaceId{f}].labels});
    return faces;
}

/// Both searches and the check must say what brute force says; returns how many pairs cross.
inline std::size_t expect_all_crossings_found(const Mesh& mesh) {
    const std::vector<FacePair> expected = crossings_by_brute_force(mesh);
    EXPECT_EQ(crossings_in(mesh), expected);
    EXPECT_EQ(find_crossings(listed_faces(mesh), 1), expected);
    EXPECT_EQ(check(mesh, {}).counts[static_cast<int>(ViolationKind::kCrossingFaces)], expected.size());
    return expected.size();
}

}  // namespace regionmesh::test
