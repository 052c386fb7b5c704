// Checks of models that memory does not hold at once.
#include <algorithm>

#include "blocks/folder_parts.h"
#include "blocks/join.h"
#include "blocks/piece_mesh.h"
#include "check/check_parts.h"
#include "regionmesh/blocks.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// The faces that reach into a range of coordinates along an axis, each with vertices of its own piece.
Mesh read_layer(const BlockFolder& folder, int axis, double low, double high) {
    Mesh mesh;
    for (std::uint32_t n = 0; n < folder.pieces.boxes().size(); ++n) {
        const Box& box = folder.pieces.boxes()[n];
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
std::uint32_t parts_of_layer(const BlockFolder& folder, const IndexBox& layer, std::uint32_t sections,
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
    const BlockFolder folder{path};
    Box extent;
    for (const Box& box : folder.pieces.boxes()) extent.join(box);
    const Box whole = folder.placed(extent);
    PartsCheck parts(options, 0.5 * (whole.low + whole.high));
    for (std::uint32_t block = 0; block < folder.pieces.boxes().size(); ++block) {
        MeshPart part;
        const Mesh mesh = read_part(folder, block, part);
        parts.add(mesh, part);
    }
    parts.begin_rays(2 * length(whole.high - whole.low));
    for (std::uint32_t block = 0; block < folder.pieces.boxes().size(); ++block)
        if (parts.needs(folder.placed(folder.pieces.boxes()[block])))
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
    const BlockFolder folder{path};
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
    if (reader.info().can_rewind) reader.rewind();
    std::vector<InputLabel> given(std::size_t{reader.section_width()} * reader.section_height());
    SampleAgreement result;
    std::uint32_t section = 0;
    result.contradictions = voxelise_block_folder(path, reader.info(), background, [&](std::span<const Label> found) {
        require_section(reader.next(given), reader.info(), section++);
        add_samples(result, labels, background, given, found);
    });
    return result;
}

}  // namespace regionmesh
