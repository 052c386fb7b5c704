#include "cells/marching_tetrahedra.h"

#include <algorithm>

#include "base/triangle.h"

namespace regionmesh {
namespace {

Vec3 place_of(Step step) { return {double(step & 1), double(step >> 1 & 1), double(step >> 2 & 1)}; }

/// Centroid of the corners in `set`.
template <std::size_t N>
Vec3 centroid_of(CornerSet set, const std::array<Vec3, N>& corners) {
    Vec3 sum;
    int count = 0;
    for (std::size_t c = 0; c < N; ++c)
        if (set >> c & 1) {
            sum += corners[c];
            ++count;
        }
    return sum / count;
}

constexpr CornerSet bits(int a) { return CornerSet(1 << a); }
constexpr CornerSet bits(int a, int b) { return CornerSet(1 << a | 1 << b); }
constexpr CornerSet bits(int a, int b, int c) { return CornerSet(1 << a | 1 << b | 1 << c); }
constexpr CornerSet kWhole = 0b1111;

CasePatch patch(std::initializer_list<CornerSet> vertices, int first, int second) {
    CasePatch made{.vertices = {},
                   .vertex_count = std::uint8_t(vertices.size()),
                   .first = std::uint8_t(first),
                   .second = std::uint8_t(second),
                   .turns = false};
    std::copy(vertices.begin(), vertices.end(), made.vertices.begin());
    return made;
}

/// Patches of three and four labels list their vertices so that diagonals from the first of each end at one vertex: for
/// three labels in a tetrahedron the centroid of one triangle, else the centroid of the whole.
bool has_shared_diagonals(const std::vector<CasePatch>& patches) { return patches.size() > 2; }

/// Cuts the patches along the better diagonals for these corners, or into cones.
template <std::size_t N>
void cut(const std::vector<CasePatch>& patches, const std::array<Vec3, N>& corners, bool mirrors, QuadCuts cuts,
         std::vector<CaseFace>& faces) {
    const bool is_cone = cuts == QuadCuts::kCones && has_shared_diagonals(patches);
    for (const CasePatch& patch : patches) {
        std::array<Vec3, 4> at;
        for (int n = 0; n < patch.vertex_count; ++n) at[n] = centroid_of(patch.vertices[n], corners);
        std::array<CaseFace, 2> made;
        const int start = patch.vertex_count == 4 && !is_cone ? better_cut(at) : 0;
        const int count = patch.cut(start, patch.turns != mirrors, made);
        faces.insert(faces.end(), made.begin(), made.begin() + count);
    }
}

/// The patches for labels given as small numbers; docs/explanation/reconstruct.md has the rule in words.
std::vector<CasePatch> patches_of(const std::array<int, 4>& label) {
    std::vector<CasePatch> patches;
    std::array<std::vector<int>, 4> groups;  // corners by label
    for (int c = 0; c < 4; ++c) groups[label[c]].push_back(c);
    const auto count = std::count_if(groups.begin(), groups.end(), [](const auto& g) { return !g.empty(); });
    std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    if (count == 2 && groups[0].size() == 3) {
        const auto& g = groups[0];
        const int tip = groups[1][0];
        patches.push_back(patch({bits(g[0], tip), bits(g[1], tip), bits(g[2], tip)}, g[0], tip));
    } else if (count == 2) {
        const int a = groups[0][0], b = groups[0][1], c = groups[1][0], d = groups[1][1];
        patches.push_back(patch({bits(a, c), bits(b, c), bits(b, d), bits(a, d)}, a, c));
    } else if (count == 3) {
        const int a = groups[0][0], b = groups[0][1], c = groups[1][0], d = groups[2][0];
        const CornerSet acd = bits(a, c, d), bcd = bits(b, c, d);
        patches.push_back(patch({bits(a, c), bits(b, c), bcd, acd}, a, c));
        patches.push_back(patch({bits(a, d), bits(b, d), bcd, acd}, a, d));
        patches.push_back(patch({bits(c, d), acd, bcd}, c, d));
    } else if (count == 4) {
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) {
                const CornerSet rest = kWhole & ~bits(a, b);
                const CornerSet c = rest & -rest, d = rest & (rest - 1);
                patches.push_back(
                    patch({bits(a, b), CornerSet(bits(a, b) | c), kWhole, CornerSet(bits(a, b) | d)}, a, b));
            }
    }
    return patches;
}

/// The corners of a regular tetrahedron. The orientation of a face is invariant under affine maps of positive
/// determinant, and here every patch is perpendicular to the line between the corners that it separates.
constexpr std::array<Vec3, 4> kRegular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

double volume(const std::array<Vec3, 4>& p) { return dot(area_vector(p[0], p[1], p[2]), p[3] - p[0]); }

bool looks_back(const CasePatch& patch) {
    const auto at = [&](int i) { return centroid_of(patch.vertices[i], kRegular); };
    return dot(area_vector(at(0), at(1), at(2)), kRegular[patch.second] - kRegular[patch.first]) <= 0;
}

}  // namespace

int CasePatch::cut(int start, bool turn, std::array<CaseFace, 2>& faces) const {
    const auto at = [&](int i) { return vertices[(start + i) % vertex_count]; };
    const int count = vertex_count - 2;
    for (int n = 0; n < count; ++n) {
        faces[n] = {{at(0), at(n + 1), at(n + 2)}, first, second};
        if (turn) std::swap(faces[n].vertices[1], faces[n].vertices[2]);
    }
    return count;
}

int better_cut(const std::array<Vec3, 4>& quad) {
    const auto worst = [&](int start) {
        const auto at = [&](int i) { return quad[(start + i) % 4]; };
        return std::min(face_quality(at(0), at(1), at(2)), face_quality(at(0), at(2), at(3)));
    };
    return worst(1) > worst(0) + 1e-12 ? 1 : 0;
}

TetrahedronPatches make_tetrahedron_patches() {
    TetrahedronPatches cases;
    std::array<int, 4> label{};
    for (label[1] = 0; label[1] < 2; ++label[1])
        for (label[2] = 0; label[2] < 3; ++label[2])
            for (label[3] = 0; label[3] < 4; ++label[3]) {
                auto& patches = cases[tetrahedron_pattern(label[0], label[1], label[2], label[3])];
                if (!patches.empty()) continue;
                patches = patches_of(label);
                for (CasePatch& made : patches) made.turns = looks_back(made) != (volume(kRegular) < 0);
            }
    return cases;
}

TrianglePatches make_triangle_patches() {
    TrianglePatches cases;
    for (int l1 = 0; l1 < 2; ++l1)
        for (int l2 = 0; l2 < 3; ++l2) {
            auto& patches = cases[triangle_pattern(0, l1, l2)];
            if (!patches.empty()) continue;
            if (l1 == 0 && l2 == 0) {
                patches.push_back(patch({bits(0), bits(1), bits(2)}, 0, 0));
            } else if (l1 != 0 && l2 != 0 && l1 != l2) {
                for (int a = 0; a < 3; ++a)
                    patches.push_back(
                        patch({bits(a), bits(a, (a + 1) % 3), bits(0, 1, 2), bits(a, (a + 2) % 3)}, a, 0));
            } else {
                const int tip = l1 == 0 ? 2 : l2 == 0 ? 1 : 0;
                const int a = (tip + 1) % 3, b = (tip + 2) % 3;
                patches.push_back(patch({bits(tip), bits(tip, a), bits(b, tip)}, tip, 0));
                patches.push_back(patch({bits(a), bits(b), bits(b, tip), bits(tip, a)}, a, 0));
            }
        }
    return cases;
}

TetrahedronCases make_tetrahedron_cases(const std::array<Step, 4>& steps, QuadCuts cuts) {
    std::array<Vec3, 4> corners;
    std::transform(steps.begin(), steps.end(), corners.begin(), place_of);
    const TetrahedronPatches patches = make_tetrahedron_patches();
    TetrahedronCases cases;
    for (std::size_t n = 0; n < cases.size(); ++n) cut(patches[n], corners, volume(corners) < 0, cuts, cases[n]);
    return cases;
}

TriangleCases make_triangle_cases(const std::array<Step, 3>& steps, QuadCuts cuts) {
    std::array<Vec3, 3> corners;
    std::transform(steps.begin(), steps.end(), corners.begin(), place_of);
    const TrianglePatches patches = make_triangle_patches();
    TriangleCases cases;
    for (std::size_t n = 0; n < cases.size(); ++n) cut(patches[n], corners, false, cuts, cases[n]);
    return cases;
}

}  // namespace regionmesh
