#include "blocks/join.h"

#include <fmt/format.h>

#include <cstdio>

#include "blocks/gather.h"
#include "blocks/piece.h"
#include "formats/input_file.h"
#include "regionmesh/limits.h"
#include "stream/place_in_space.h"

namespace regionmesh {
namespace fs = std::filesystem;

Piece read_entry(const Manifest& manifest, const fs::path& folder, std::uint32_t block) {
    const PieceEntry& entry = manifest.pieces[block];
    const fs::path path = piece_path(folder, entry.pass, block);
    if (read_checksum(path) != entry.checksum)
        formats::fail(path, "is not the piece that the manifest names; remove the folder, and run again");
    Piece piece = read_piece(path);
    for (const PieceFace& face : piece.faces)
        for (const Label label : face.labels)
            if (label >= manifest.label_count && !(is_exterior(label) && side_of(label) < kSideCount))
                formats::fail(path, "a face has a label that the folder does not have");
    return piece;
}

fs::path piece_path(const fs::path& folder, std::uint32_t pass, std::uint32_t block) {
    return folder / fmt::format("pass-{}-{:06}.piece", pass, block);
}

std::optional<std::uint32_t> pass_of(const std::string& name) {
    std::uint32_t pass = 0, block = 0;
    if (std::sscanf(name.c_str(), "pass-%u-%u.piece", &pass, &block) != 2) return {};
    if (piece_path({}, pass, block) != name) return {};
    return pass;
}

std::uint64_t count_vertices(const Manifest& manifest, const fs::path& folder) {
    SharedVertices shared;
    std::uint64_t own = 0;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        const Piece piece = read_entry(manifest, folder, block);
        for (const PieceVertex& vertex : piece.vertices)
            if (vertex.is_shared)
                shared.number(vertex.position, 0);
            else
                ++own;
    }
    return own + shared.size();
}

bool is_block_folder(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_directory(folder, ignored) && fs::is_regular_file(manifest_path(folder), ignored) &&
           read_manifest(folder).has_value();
}

MeshFile describe_block_folder(const fs::path& folder) {
    const Manifest manifest = read_complete_manifest(folder);
    MeshFile file{.mesh = {}, .labels = read_labels(manifest, folder)};
    file.names = manifest.names;
    file.colours = manifest.colours;
    file.space = manifest.space;
    file.background = manifest.background;
    return file;
}

MeshFile read_block_folder(const fs::path& folder) {
    const Manifest manifest = read_complete_manifest(folder);
    MeshFile file = describe_block_folder(folder);
    require_mesh_size("the model in pieces", manifest.vertices, manifest.faces);
    file.mesh.reserve(manifest.vertices, manifest.faces);
    SharedVertices shared;
    std::vector<VertexId> ids;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        const Piece piece = read_entry(manifest, folder, block);
        ids.clear();
        for (const PieceVertex& vertex : piece.vertices) {
            const std::uint32_t next = file.mesh.vertex_end();
            const std::uint32_t number = vertex.is_shared ? shared.number(vertex.position, next) : next;
            ids.push_back(VertexId{number});
            if (number == next) file.mesh.add_vertex(vertex.position, vertex.sides);
        }
        for (const PieceFace& face : piece.faces)
            file.mesh.add_face(ids[face.vertices[0]], ids[face.vertices[1]], ids[face.vertices[2]], face.labels[0],
                               face.labels[1]);
    }
    unscale_z(file.mesh, manifest.scale_z);
    place_in_space(file.mesh, manifest.lattice);
    return file;
}

}  // namespace regionmesh
