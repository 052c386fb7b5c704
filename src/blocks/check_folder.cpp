// Checks of models that memory does not hold at once.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "blocks/gather.h"
#include "blocks/join.h"
#include "blocks/piece_mesh.h"
#include "check/check_parts.h"
#include "mesh/extent.h"
#include "regionmesh/blocks.h"
#include "regionmesh/process.h"
#include "stream/place_in_space.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// A complete folder, and where its pieces lie.
struct Folder {
    fs::path path;
    Manifest manifest = read_complete_manifest(path);
    BlockGrid grid{piece_lattice(manifest), manifest.block_cells, manifest.shift};
    std::vector<Box> boxes = piece_boxes(manifest, path);

    /// Around what the mesh of a piece with this box contains once it is at its place.
    Box placed(const Box& box) const {
        if (box.is_empty()) return box;
        Mesh corners;
        for (int n = 0; n < 8; ++n)
            corners.add_vertex(
                {(n & 1 ? box.low : box.high).x, (n & 2 ? box.low : box.high).y, (n & 4 ? box.low : box.high).z});
        place(corners);
        Box around = extent_of(corners, 1);
        const double rounding = 1e-12 * (length(around.low) + length(around.high));
        around.low = around.low - Vec3{rounding, rounding, rounding};
        around.high = around.high + Vec3{rounding, rounding, rounding};
        return around;
    }
    /// Moves a mesh of faces of the pieces to its place.
    void place(Mesh& mesh) const {
        unscale_z(mesh, manifest.scale_z);
        place_in_space(mesh, manifest.lattice);
    }
};

/// The faces that touch a block. Vertices are numbered by their position: in the same order in all parts.
Mesh read_part(const Folder& folder, std::uint32_t block, MeshPart& part) {
    part = {
        .number = block, .of_vertex = {}, .of_face = {}, .low_of_face = {}, .key_of_face = {}, .at = [&](Vec3 place) {
            return folder.grid.block_at(place);
        }};
    BlockGatherer gatherer(folder.grid, block);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t n = 0; n < folder.boxes.size(); ++n)
        if (!folder.boxes[n].is_empty() && gatherer.needs(folder.boxes[n])) {
            taken.clear();
            gatherer.add(read_entry(folder.manifest, folder.path, n), 0, &taken);
            for (const std::uint32_t face : taken) part.key_of_face.push_back(std::uint64_t{n} << 32 | face);
        }
    BlockChunk gathered;
    gatherer.take(gathered);
    const Chunk& chunk = gathered.chunk;
    std::vector<std::uint32_t> order(chunk.vertices.size()), number(chunk.vertices.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 &p = chunk.vertices[a].position, &q = chunk.vertices[b].position;
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
    Mesh mesh;
    mesh.reserve(chunk.vertices.size(), chunk.faces.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) {
        const ChunkVertex& vertex = chunk.vertices[order[n]];
        number[order[n]] = n;
        mesh.add_vertex(vertex.position, vertex.sides);
        part.of_vertex.push_back(folder.grid.block_at(vertex.position));
    }
    for (const ChunkFace& face : chunk.faces) {
        const auto& [v, labels] = face;
        mesh.add_face(VertexId{number[v[0]]}, VertexId{number[v[1]]}, VertexId{number[v[2]]}, labels[0], labels[1]);
        part.of_face.push_back(block_of(folder.grid, chunk, face));
        Box box;
        for (const std::uint32_t n : v) box.add(chunk.vertices[n].position);
        part.low_of_face.push_back(box.low);
    }
    folder.place(mesh);
    return mesh;
}

/// The faces that reach into a range of coordinates along an axis, each with vertices of its own piece.
Mesh read_layer(const Folder& folder, int axis, double low, double high) {
    Mesh mesh;
    for (std::uint32_t n = 0; n < folder.boxes.size(); ++n) {
        const Box& box = folder.boxes[n];
        if (box.is_empty() || box.high[axis] < low || box.low[axis] > high) continue;
        const Piece piece = read_entry(folder.manifest, folder.path, n);
        std::vector<VertexId> ids(piece.vertices.size(), kNoVertex);
        for (const PieceFace& face : piece.faces) {
            Box own;
            for (const std::uint32_t v : face.vertices) own.add(piece.vertices[v].position);
            if (own.high[axis] < low || own.low[axis] > high) continue;
            for (const std::uint32_t v : face.vertices)
                if (ids[v] == kNoVertex) ids[v] = mesh.add_vertex(piece.vertices[v].position);
            mesh.add_face(ids[face.vertices[0]], ids[face.vertices[1]], ids[face.vertices[2]], face.labels[0],
                          face.labels[1]);
        }
    }
    folder.place(mesh);
    return mesh;
}

/// The blocks of a layer across an axis.
IndexBox layer_of(const BlockGrid& grid, int axis, std::uint32_t layer) {
    IndexBox blocks{{}, grid.counts()};
    blocks.low[axis] = layer;
    blocks.high[axis] = layer + 1;
    return blocks;
}

/// Into how many parts a layer of pieces is cut, so that each has about `most_faces` faces or fewer.
std::uint32_t parts_of_layer(const Folder& folder, const IndexBox& layer, std::uint32_t sections,
                             std::uint64_t most_faces) {
    std::uint64_t faces = 0;
    folder.grid.for_blocks(layer, [&](std::uint32_t block) { faces += folder.manifest.pieces[block].faces; });
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(faces / most_faces + 1, 1, sections));
}

std::uint32_t section_of_part(std::uint32_t first, std::uint32_t end, std::uint32_t part, std::uint32_t parts) {
    return first + static_cast<std::uint32_t>(std::uint64_t{end - first} * part / parts);
}

bool is_same(const Lattice& a, const Lattice& b) {
    return a.size == b.size && a.spacing == b.spacing && a.origin == b.origin && a.direction == b.direction;
}

}  // namespace

CheckReport check_block_folder(const fs::path& path, const CheckOptions& options) {
    const Folder folder{path};
    Box extent;
    for (const Box& box : folder.boxes) extent.join(box);
    const Box whole = folder.placed(extent);
    PartsCheck parts(options, 0.5 * (whole.low + whole.high));
    for (std::uint32_t block = 0; block < folder.boxes.size(); ++block) {
        MeshPart part;
        const Mesh mesh = read_part(folder, block, part);
        parts.add(mesh, part);
    }
    parts.begin_rays(2 * length(whole.high - whole.low));
    for (std::uint32_t block = 0; block < folder.boxes.size(); ++block)
        if (parts.needs(folder.placed(folder.boxes[block])))
            parts.add_rays(mesh_of(read_entry(folder.manifest, path, block), folder.manifest));
    return parts.finish();
}

bool has_lattice_of(const fs::path& folder, const VolumeInfo& volume) {
    return is_same(read_complete_manifest(folder).lattice, volume.lattice);
}

std::uint64_t voxelise_block_folder(const fs::path& path, const VolumeInfo& volume,
                                    const std::vector<Label>& background,
                                    const std::function<void(std::span<const Label>)>& on_section,
                                    std::uint64_t most_faces) {
    const Folder folder{path};
    const Lattice lattice = piece_lattice(folder.manifest);
    const int axis = volume.sweep.axes[2];
    std::vector<Label> found(std::size_t{volume.lattice.size[volume.sweep.axes[0]]} *
                             volume.lattice.size[volume.sweep.axes[1]]);
    const std::uint32_t layers = folder.grid.counts()[axis];
    std::uint64_t contradictions = 0;
    const auto at = [&](double section) { return lattice.origin[axis] + section * lattice.spacing[axis]; };
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const IndexBox blocks = layer_of(folder.grid, axis, layer), cells = folder.grid.cells(blocks);
        const std::uint32_t first = cells.low[axis];
        const std::uint32_t end = layer + 1 < layers ? cells.high[axis] : volume.lattice.size[axis];
        const std::uint32_t parts = parts_of_layer(folder, blocks, cells.size()[axis], most_faces);
        for (std::uint32_t part = 0; part < parts; ++part) {
            const std::uint32_t low = section_of_part(first, end, part, parts);
            const std::uint32_t high = section_of_part(first, end, part + 1, parts);
            // A section more on each side, for rounding of positions turned in space.
            const Mesh mesh = read_layer(folder, axis, at(low - 1.0), at(high));
            Voxeliser voxeliser(mesh, {.lattice = volume.lattice, .sweep = volume.sweep, .background = background});
            voxeliser.skip_to(low);
            for (std::uint32_t section = low; section < high && voxeliser.next(found); ++section) on_section(found);
            contradictions += voxeliser.contradictions();
        }
    }
    return contradictions;
}

SampleAgreement compare_block_samples(const fs::path& path, LabelTable& labels, const std::vector<Label>& background,
                                      SectionReader& reader) {
    std::vector<InputLabel> given(std::size_t{reader.section_width()} * reader.section_height());
    SampleAgreement result;
    result.contradictions = voxelise_block_folder(path, reader.info(), background, [&](std::span<const Label> found) {
        if (reader.next(given)) add_samples(result, labels, background, given, found);
    });
    return result;
}

}  // namespace regionmesh
