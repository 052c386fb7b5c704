// Bytes that each stage takes, derived from the sizes of the items that it holds (docs/explanation/memory.md).
#pragma once

#include <cstdint>

#include "base/megabytes.h"
#include "regionmesh/mesh.h"
#include "regionmesh/section_reader.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Surfaces with many regions have 0.484 vertices per face; half a vertex is counted.
constexpr std::uint64_t per_face(std::uint64_t face_bytes, std::uint64_t vertex_bytes) {
    return face_bytes + vertex_bytes / 2;
}

/// A tree of boxes: six coordinates of 16 bits at the lowest level, and 1/7 of that for the levels above. A box holds
/// one face, or two while the whole mesh is decimated.
inline constexpr std::uint64_t kTreeBytesPerFace = 6 * sizeof(std::uint16_t) + 2;
inline constexpr std::uint64_t kPairedTreeBytesPerFace = kTreeBytesPerFace / 2;

inline constexpr std::uint64_t kMeshBytesPerFace = per_face(sizeof(Face), sizeof(Vertex));
static_assert(kMeshBytesPerFace == 48);

/// Per vertex a quadric of ten floats, the partner and the key of its cheapest edge, and the key up to which edges were
/// refused; and 16 bytes of a second choice for every second vertex.
inline constexpr std::uint64_t kDecimationBytesPerFace =
    per_face(kPairedTreeBytesPerFace, 10 * sizeof(float) + 3 * sizeof(std::uint32_t)) + 4;
inline constexpr std::uint64_t kBytesPerFace = kMeshBytesPerFace + kDecimationBytesPerFace;
static_assert(kBytesPerFace == 85, "docs/explanation/memory.md has this number");

/// The mesh while it is sorted or decimated, as a whole or in tiles (93 bytes a face), with free places in between.
inline constexpr std::uint64_t kWorkBytesPerFace = 100;
static_assert(kWorkBytesPerFace >= 93 && kWorkBytesPerFace >= kBytesPerFace);

/// A chunk, with its list of active vertices and room at the ends of its arrays. The model is made of them until it is
/// decimated as a whole.
inline constexpr std::uint64_t kChunkBytesPerFace = per_face(sizeof(ChunkFace), sizeof(ChunkVertex)) + 4;
static_assert(kChunkBytesPerFace == 40);

/// In addition for a chunk whose tiles are decimated: order of the faces, numbers of the vertices, and half of the
/// chunk once more while it is put together again.
inline constexpr std::uint64_t kTilesBytesPerFace =
    per_face(sizeof(std::uint32_t), sizeof(std::uint32_t)) + per_face(sizeof(ChunkFace), sizeof(ChunkVertex)) / 2;
static_assert(kTilesBytesPerFace == 24);
/// A tile in flight is a small mesh that is decimated, with a box for each face, a heap (an entry and a place of 8
/// bytes more than the key alone), the directions along which faces rise, and free places in between.
inline constexpr std::uint64_t kTileBytesPerFace =
    kBytesPerFace + per_face(kTreeBytesPerFace - kPairedTreeBytesPerFace, 8) + sizeof(std::uint32_t) + 4;
static_assert(kTileBytesPerFace == 104);

/// The window of smoothing: faces, their trees, and per vertex three positions, about six neighbours and the start of
/// their list, the separate part it belongs to, backtrack, request and sides.
inline constexpr std::uint64_t kSmoothBytesPerFace =
    per_face(sizeof(ChunkFace) + kTreeBytesPerFace, 3 * sizeof(Vec3) + (6 + 1 + 1) * sizeof(std::uint32_t) + 3);
/// Arrays slide: their front is released when it is a quarter of all.
inline constexpr std::uint64_t kWindowBytesPerFace = kSmoothBytesPerFace + 3;
static_assert(kWindowBytesPerFace == 90);

/// In addition to the finished mesh: for the largest step of its check, a tree of boxes and what comes with it; and for
/// --preserve-volume, the window of smoothing for all of it, the targets, three states that may be returned to, and
/// what arrays that grow leave free. Measured: 156 to 175.
inline constexpr std::uint64_t kCheckBytesPerFace = kTreeBytesPerFace + 6;
inline constexpr std::uint64_t kPreserveBytesPerFace = kSmoothBytesPerFace + per_face(0, 4 * sizeof(Vec3) + 2) + 42;
static_assert(kCheckBytesPerFace == 20 && kPreserveBytesPerFace == 178);

/// In addition to the finished mesh, at most, while it is written. Measured: 5 a face as .vtp, 8 as .stl, 25 as .glb,
/// 30 as .smesh, 33 as .msh.
inline constexpr std::uint64_t kWriteBytesPerFace = 36;

/// A labelled point while faces of tetrahedra are made: position, label, input number, and whether it is used.
inline constexpr std::uint64_t kBytesPerPoint = sizeof(Vec3) + sizeof(Label) + sizeof(std::uint32_t) + 1;
static_assert(kBytesPerPoint == 33);

/// Bytes that the process, reading and meshing of a volume take in addition to the mesh.
std::uint64_t reading_bytes(const VolumeInfo& volume);

}  // namespace regionmesh
