#include "simplify/placement/vertex_quadrics.h"

#include "base/parallel_for.h"
#include "base/triangle.h"
#include "mesh/strata.h"

namespace regionmesh {

/// Each part visits all faces in the order of their ids: the sums do not depend on the number of parts.
VertexQuadrics::VertexQuadrics(const Mesh& mesh, std::uint32_t threads) {
    constexpr std::uint32_t kParts = 4;
    quadrics_.resize(mesh.vertex_end());
    const std::uint32_t parts = threads == 1 ? 1 : kParts, count = mesh.vertex_end() / parts + 1;
    parallel_for(parts, threads, [&](std::uint32_t part) { gather(mesh, {part * count, count}); });
}

void VertexQuadrics::gather(const Mesh& mesh, Part part) {
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const Face& face = mesh[FaceId{f}];
        const auto& [a, b, c] = face.vertices;
        if (!part.has(a) && !part.has(b) && !part.has(c)) continue;
        const auto p = mesh.corners(FaceId{f});
        const Vec3 area = area_vector(p[0], p[1], p[2]);
        const double twice = length(area);
        if (!(twice > 0)) continue;
        const Vec3 normal = area / twice;
        const double weight = face.labels[1] == exterior(kHull) ? kHullWeight : 1;
        for (VertexId v : face.vertices)
            if (part.has(v)) add_plane(v, normal, weight * twice / 6);
        add_lines(mesh, face, normal, part);
    }
}

/// A plane through the vertex: no offset, relative to it.
void VertexQuadrics::add_plane(VertexId v, Vec3 n, double weight) {
    PackedQuadric& q = quadrics_[index(v)];
    const Vec3 wn = weight * n;
    q.xx += static_cast<float>(wn.x * n.x);
    q.xy += static_cast<float>(wn.x * n.y);
    q.xz += static_cast<float>(wn.x * n.z);
    q.yy += static_cast<float>(wn.y * n.y);
    q.yz += static_cast<float>(wn.y * n.z);
    q.zz += static_cast<float>(wn.z * n.z);
}

void VertexQuadrics::add_lines(const Mesh& mesh, const Face& face, Vec3 normal, Part part) {
    for (int n = 0; n < 3; ++n) {
        const VertexId a = face.vertices[n], b = face.vertices[(n + 1) % 3];
        if (mesh[a].label_count < 3 || mesh[b].label_count < 3 || edge_labels(mesh, a, b).size() < 3) continue;
        const Vec3 along = mesh.position(b) - mesh.position(a);
        const Vec3 upright = cross(along, normal) / length(along);
        for (VertexId v : {a, b})
            if (part.has(v)) add_plane(v, upright, kLineWeight * length2(along) / 2);
    }
}

}  // namespace regionmesh
