// Models that are broken here and there.
#pragma once

#include <algorithm>
#include <vector>

#include "regionmesh/mesh.h"
#include "support/random.h"

namespace regionmesh::test {

enum class Damage { kCracks, kMovedVertices, kSplitVertices, kTurnedFaces, kOtherLabels, kFins };
inline constexpr Damage kDamages[] = {Damage::kCracks,      Damage::kMovedVertices, Damage::kSplitVertices,
                                      Damage::kTurnedFaces, Damage::kOtherLabels,   Damage::kFins};

/// Does it `count` times, in places that the seed says. Requires a model without free places.
inline void damage(Mesh& mesh, Damage kind, int count, std::uint64_t seed) {
    Random random(seed);
    const std::uint32_t faces = mesh.face_end(), vertices = mesh.vertex_end();
    for (int n = 0; n < count; ++n) {
        const FaceId f{static_cast<std::uint32_t>(random.below(faces))};
        const VertexId v{static_cast<std::uint32_t>(random.below(vertices))};
        const auto step = [&] { return random.unit() - 0.5; };
        if (!mesh.is_alive(f)) continue;
        const Face face = mesh[f];
        const auto [a, b, c] = face.vertices;
        switch (kind) {
            case Damage::kCracks:
                mesh.remove_face(f);
                break;
            case Damage::kMovedVertices:
                mesh[v].position += Vec3{3 * step(), 3 * step(), 3 * step()};
                break;
            case Damage::kSplitVertices: {
                const VertexId copy = mesh.add_vertex(mesh.position(a), mesh[a].sides);
                mesh.remove_face(f);
                mesh.add_face(copy, b, c, face.labels[0], face.labels[1]);
                break;
            }
            case Damage::kTurnedFaces:
                mesh.remove_face(f);
                mesh.add_face(a, c, b, face.labels[0], face.labels[1]);
                break;
            case Damage::kOtherLabels:
                mesh.remove_face(f);
                mesh.add_face(a, b, c, face.labels[0], static_cast<Label>(100 + n));
                break;
            case Damage::kFins: {
                const VertexId tip = mesh.add_vertex(mesh.position(a) + Vec3{step(), step(), step()});
                mesh.add_face(a, b, tip, face.labels[0], face.labels[1]);
                break;
            }
        }
    }
}

}  // namespace regionmesh::test
