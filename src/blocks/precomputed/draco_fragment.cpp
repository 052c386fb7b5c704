#include "blocks/precomputed/draco_fragment.h"

#include "regionmesh/error.h"

#if REGIONMESH_WITH_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#endif

namespace regionmesh {

#if REGIONMESH_WITH_DRACO

std::string encode_draco(const FragmentMesh& mesh) {
    draco::Mesh copy;
    copy.SetNumFaces(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        draco::Mesh::Face face;
        for (int n = 0; n < 3; ++n) face[n] = draco::PointIndex(mesh.faces[f][n]);
        copy.SetFace(draco::FaceIndex(f), face);
    }
    copy.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
    draco::GeometryAttribute layout;
    // Neuroglancer takes positions as 32-bit integers with a sign.
    layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false, 3 * sizeof(std::int32_t), 0);
    const int id = copy.AddAttribute(layout, true, static_cast<std::uint32_t>(mesh.positions.size()));
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const auto& p = mesh.positions[v];
        const std::array<std::int32_t, 3> position{p[0], p[1], p[2]};
        copy.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), position.data());
    }
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    if (const draco::Status status = encoder.EncodeMeshToBuffer(copy, &buffer); !status.ok())
        throw Error(ErrorCode::kOutput, std::string("Draco cannot compress a fragment: ") + status.error_msg());
    return {buffer.data(), buffer.size()};
}

#else

std::string encode_draco(const FragmentMesh&) {
    throw Error(ErrorCode::kOutput,
                "this build has no Draco, which multi-resolution meshes need; give --precomputed legacy");
}

#endif

}  // namespace regionmesh
