// Surfaces of a few faces.
#pragma once

#include <array>
#include <vector>

#include "regionmesh/mesh.h"

namespace regionmesh::test {

/// Vertices by number; the normal points from the first label to the second.
struct ShapeFace {
    std::array<std::uint32_t, 3> v;
    Label first = 0, second = 1;
};

/// Adds vertices and faces; face numbers count from the first vertex added.
inline void add_shape(Mesh& mesh, const std::vector<Vec3>& positions, const std::vector<ShapeFace>& faces) {
    const std::uint32_t start = mesh.vertex_end();
    for (Vec3 p : positions) mesh.add_vertex(p);
    for (const ShapeFace& f : faces)
        mesh.add_face(VertexId{start + f.v[0]}, VertexId{start + f.v[1]}, VertexId{start + f.v[2]}, f.first, f.second);
}

inline Mesh shape(const std::vector<Vec3>& positions, const std::vector<ShapeFace>& faces) {
    Mesh mesh;
    add_shape(mesh, positions, faces);
    return mesh;
}

/// |x / size.x| + |y / size.y| + |z / size.z| = 1 round `middle`; vertices -x +x -y +y -z +z.
inline void add_octahedron(Mesh& mesh, Vec3 middle = {}, Vec3 size = {1, 1, 1}, Label inside = 0, Label outside = 1) {
    std::vector<Vec3> positions(6, middle);
    for (int n = 0; n < 6; ++n) positions[n][n / 2] += n % 2 ? size[n / 2] : -size[n / 2];
    std::vector<ShapeFace> faces;
    for (std::uint32_t n = 0; n < 8; ++n) {
        const std::uint32_t x = n & 1, y = 2 + (n >> 1 & 1), z = 4 + (n >> 2);
        const bool mirrors = (n & 1) + (n >> 1 & 1) + (n >> 2) != 1 && n != 7;
        faces.push_back({mirrors ? std::array{x, z, y} : std::array{x, y, z}, inside, outside});
    }
    add_shape(mesh, positions, faces);
}

inline Mesh octahedron() {
    Mesh mesh;
    add_octahedron(mesh);
    return mesh;
}

/// An octahedron cut in two by a membrane round vertex 6, in the plane z = 0: region 0 below, 1 above, 2 outside.
inline Mesh halved_octahedron() {
    const std::vector<Vec3> p{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}};
    std::vector<ShapeFace> faces;
    constexpr std::array<std::uint32_t, 5> ring{1, 3, 0, 2, 1};
    for (int n = 0; n < 4; ++n) {
        faces.push_back({{ring[n], ring[n + 1], 5}, 1, 2});
        faces.push_back({{ring[n + 1], ring[n], 4}, 0, 2});
        faces.push_back({{ring[n], ring[n + 1], 6}, 0, 1});
    }
    return shape(p, faces);
}

/// Vertices at the origin and one step along each axis.
inline const std::vector<Vec3> kTetrahedronCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline std::vector<ShapeFace> tetrahedron_faces(Label inside = 0, Label outside = 1) {
    return {{{0, 2, 1}, inside, outside},
            {{0, 1, 3}, inside, outside},
            {{0, 3, 2}, inside, outside},
            {{1, 2, 3}, inside, outside}};
}

/// An edge from vertex 0 at the origin to vertex 1 at (1,0,0) in a flat sheet, with the eight vertices round it: 2 and
/// 3 are its apexes. The normal is +z, from label 0 to 1.
inline Mesh edge_in_sheet() {
    return shape({{0, 0, 0},
                  {1, 0, 0},
                  {0.5, 1, 0},
                  {0.5, -1, 0},
                  {-0.5, 1, 0},
                  {-1, 0, 0},
                  {-0.5, -1, 0},
                  {1.5, 1, 0},
                  {2, 0, 0},
                  {1.5, -1, 0}},
                 {{{0, 1, 2}},
                  {{1, 0, 3}},
                  {{0, 2, 4}},
                  {{0, 4, 5}},
                  {{0, 5, 6}},
                  {{0, 6, 3}},
                  {{1, 7, 2}},
                  {{1, 8, 7}},
                  {{1, 9, 8}},
                  {{1, 3, 9}}});
}

}  // namespace regionmesh::test
