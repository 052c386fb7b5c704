#include "regionmesh/tets/marching_tetrahedra.h"

#include <algorithm>

#include "regionmesh/base/triangle.h"

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

/// A polygon of three or four vertices between two corners' labels, in either direction.
struct Patch {
    std::vector<CornerSet> vertices;
    int first, second;
};

/// Smallest quality of the two triangles of a quad cut from vertex `start` to the one opposite.
template <std::size_t N>
double cut_quality(const std::vector<CornerSet>& quad, int start, const std::array<Vec3, N>& corners) {
    const auto at = [&](int i) { return centroid_of(quad[(start + i) % 4], corners); };
    return std::min(face_quality(at(0), at(1), at(2)), face_quality(at(0), at(2), at(3)));
}

template <std::size_t N>
void cut(const Patch& patch, const std::array<Vec3, N>& corners, std::vector<CaseFace>& faces) {
    const auto& v = patch.vertices;
    const auto face = [&](CornerSet a, CornerSet b, CornerSet c) {
        faces.push_back({{a, b, c}, std::uint8_t(patch.first), std::uint8_t(patch.second)});
    };
    if (v.size() == 3) return face(v[0], v[1], v[2]);
    const int start = cut_quality(v, 1, corners) > cut_quality(v, 0, corners) + 1e-12 ? 1 : 0;
    const auto at = [&](int i) { return v[(start + i) % 4]; };
    face(at(0), at(1), at(2));
    face(at(0), at(2), at(3));
}

/// The patches for labels given as small numbers; the rule in words is in DESIGN 4.
std::vector<Patch> patches_of(const std::array<int, 4>& label) {
    std::vector<Patch> patches;
    std::array<std::vector<int>, 4> groups;  // corners by label
    for (int c = 0; c < 4; ++c) groups[label[c]].push_back(c);
    const auto count = std::count_if(groups.begin(), groups.end(), [](const auto& g) { return !g.empty(); });
    std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    if (count == 2 && groups[0].size() == 3) {
        const auto& g = groups[0];
        const int tip = groups[1][0];
        patches.push_back({{bits(g[0], tip), bits(g[1], tip), bits(g[2], tip)}, g[0], tip});
    } else if (count == 2) {
        const int a = groups[0][0], b = groups[0][1], c = groups[1][0], d = groups[1][1];
        patches.push_back({{bits(a, c), bits(b, c), bits(b, d), bits(a, d)}, a, c});
    } else if (count == 3) {
        const int a = groups[0][0], b = groups[0][1], c = groups[1][0], d = groups[2][0];
        const CornerSet acd = bits(a, c, d), bcd = bits(b, c, d);
        patches.push_back({{bits(a, c), bits(b, c), bcd, acd}, a, c});
        patches.push_back({{bits(a, d), bits(b, d), bcd, acd}, a, d});
        patches.push_back({{bits(c, d), acd, bcd}, c, d});
    } else if (count == 4) {
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) {
                const CornerSet rest = kWhole & ~bits(a, b);
                const CornerSet c = rest & -rest, d = rest & (rest - 1);
                patches.push_back({{bits(a, b), CornerSet(bits(a, b) | c), kWhole, CornerSet(bits(a, b) | d)}, a, b});
            }
    }
    return patches;
}

/// The corners of a regular tetrahedron. Which way a face turns is invariant under affine maps up to their sign, and
/// here every patch lies square to the line between the corners it separates.
constexpr std::array<Vec3, 4> kRegular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

}  // namespace

TetrahedronCases make_tetrahedron_cases(const std::array<Step, 4>& steps) {
    std::array<Vec3, 4> corners;
    std::transform(steps.begin(), steps.end(), corners.begin(), place_of);
    const auto volume = [](const std::array<Vec3, 4>& p) { return dot(area_vector(p[0], p[1], p[2]), p[3] - p[0]); };
    const bool mirrors = (volume(corners) > 0) != (volume(kRegular) > 0);
    TetrahedronCases cases;
    std::array<int, 4> label{};
    for (label[1] = 0; label[1] < 2; ++label[1])
        for (label[2] = 0; label[2] < 3; ++label[2])
            for (label[3] = 0; label[3] < 4; ++label[3]) {
                auto& faces = cases[tetrahedron_pattern(label[0], label[1], label[2], label[3])];
                if (!faces.empty()) continue;
                for (const Patch& patch : patches_of(label)) cut(patch, corners, faces);
                for (CaseFace& face : faces) {
                    const auto at = [&](int i) { return centroid_of(face.vertices[i], kRegular); };
                    const bool points_to_second =
                        dot(area_vector(at(0), at(1), at(2)), kRegular[face.second] - kRegular[face.first]) > 0;
                    if (points_to_second == mirrors) std::swap(face.vertices[1], face.vertices[2]);
                }
            }
    return cases;
}

TriangleCases make_triangle_cases(const std::array<Step, 3>& steps) {
    std::array<Vec3, 3> corners;
    std::transform(steps.begin(), steps.end(), corners.begin(), place_of);
    TriangleCases cases;
    for (int l1 = 0; l1 < 2; ++l1)
        for (int l2 = 0; l2 < 3; ++l2) {
            auto& faces = cases[triangle_pattern(0, l1, l2)];
            if (!faces.empty()) continue;
            if (l1 == 0 && l2 == 0) {
                cut(Patch{{bits(0), bits(1), bits(2)}, 0, 0}, corners, faces);
            } else if (l1 != 0 && l2 != 0 && l1 != l2) {
                for (int a = 0; a < 3; ++a)
                    cut(Patch{{bits(a), bits(a, (a + 1) % 3), bits(0, 1, 2), bits(a, (a + 2) % 3)}, a, 0}, corners,
                        faces);
            } else {
                const int tip = l1 == 0 ? 2 : l2 == 0 ? 1 : 0;
                const int a = (tip + 1) % 3, b = (tip + 2) % 3;
                cut(Patch{{bits(tip), bits(tip, a), bits(b, tip)}, tip, 0}, corners, faces);
                cut(Patch{{bits(a), bits(b), bits(b, tip), bits(tip, a)}, a, 0}, corners, faces);
            }
        }
    return cases;
}

}  // namespace regionmesh
