// Levels of detail of a model in pieces.
#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/external_sort.h"
#include "blocks/block_grid.h"
#include "blocks/gather.h"
#include "blocks/join.h"
#include "blocks/piece_mesh.h"
#include "blocks/precomputed/levels.h"
#include "mesh/extent.h"
#include "regionmesh/simplify.h"
#include "stream/place_in_space.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSortBytes = 32 << 20;

using Place = std::array<std::uint32_t, 3>;  // of a block or a part, along the axes

Vec3 position_of(const PositionBits& bits) {
    return {std::bit_cast<double>(bits[0]), std::bit_cast<double>(bits[1]), std::bit_cast<double>(bits[2])};
}

/// As in the temporary file.
struct PartVertex {
    Vec3 position;
    std::uint32_t free_from = 0;  // the first level at which all its faces are in one part
    SideSet sides = 0;
};

struct Part {
    std::vector<PartVertex> vertices;
    std::vector<PieceFace> faces;
};

/// Parts of a level, by place.
class StoredParts {
public:
    void put(const Place& place, const Part& part) {
        stored_[place] = {file_.size(), part.vertices.size(), part.faces.size()};
        file_.append_items(std::span<const PartVertex>(part.vertices));
        file_.append_items(std::span<const PieceFace>(part.faces));
    }
    /// Nothing where there is no part.
    std::optional<Part> get(const Place& place) const {
        const auto found = stored_.find(place);
        if (found == stored_.end()) return {};
        Part part;
        const std::uint64_t faces = file_.read_items(found->second.offset, found->second.vertices, part.vertices);
        file_.read_items(faces, found->second.faces, part.faces);
        return part;
    }

private:
    struct Stored {
        std::uint64_t offset, vertices, faces;
    };
    TemporaryFile file_;
    std::map<Place, Stored> stored_;
};

/// For the shared vertices of each piece, the first level at which all pieces that have one are in one part.
class SharedLevels {
public:
    SharedLevels(const fs::path& folder, const Manifest& manifest, const BlockGrid& grid) : grid_(grid) {
        for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
            if (manifest.pieces[block].faces == 0) continue;
            for (const PieceVertex& vertex : read_entry(manifest, folder, block).vertices)
                if (vertex.is_shared) uses_.add({bits_of(vertex.position), block});
        }
        uses_.finish();
        find_levels();
        has_next_ = levels_.next(next_);
    }

    /// Sets free_from of the vertices of a piece. Requires pieces in the order of their numbers.
    void set(std::uint32_t block, Part& part) {
        SharedVertices numbers;
        std::vector<std::uint32_t> levels;
        for (; has_next_ && next_.block == block; has_next_ = levels_.next(next_)) {
            numbers.number(position_of(next_.position), static_cast<std::uint32_t>(levels.size()));
            levels.push_back(next_.level);
        }
        for (PartVertex& vertex : part.vertices) {
            const std::uint32_t number = numbers.number(vertex.position, ~0u);
            vertex.free_from = number < levels.size() ? levels[number] : 1;
        }
    }

private:
    struct Use {
        PositionBits position;
        std::uint32_t block;
        auto operator<=>(const Use&) const = default;
    };
    struct Level {
        std::uint32_t block, level;
        PositionBits position;
        auto operator<=>(const Level&) const = default;
    };

    void find_levels() {
        std::vector<Use> same;
        const auto end = [&] {
            int bits = 0;
            for (const Use& use : same)
                for (int axis = 0; axis < 3; ++axis)
                    bits = std::max<int>(
                        bits, std::bit_width(grid_.place(use.block)[axis] ^ grid_.place(same[0].block)[axis]));
            for (const Use& use : same) levels_.add({use.block, 1u + static_cast<std::uint32_t>(bits), use.position});
            same.clear();
        };
        for (Use use; uses_.next(use); same.push_back(use))
            if (!same.empty() && same[0].position != use.position) end();
        end();
        levels_.finish();
    }

    const BlockGrid& grid_;
    ExternalSort<Use> uses_{kSortBytes};
    ExternalSort<Level> levels_{kSortBytes};
    Level next_{};
    bool has_next_ = false;
};

Part part_of(const Piece& piece) {
    Part part;
    for (const PieceVertex& vertex : piece.vertices) part.vertices.push_back({vertex.position, 1, vertex.sides});
    part.faces = piece.faces;
    return part;
}

/// Adds a part of the level before `level`; vertices that both have become one.
void join(Part& whole, SharedVertices& shared, const Part& part, std::uint32_t level) {
    std::vector<std::uint32_t> numbers;
    for (const PartVertex& vertex : part.vertices) {
        const auto next = static_cast<std::uint32_t>(whole.vertices.size());
        numbers.push_back(vertex.free_from >= level ? shared.number(vertex.position, next) : next);
        if (numbers.back() == next) whole.vertices.push_back(vertex);
    }
    for (PieceFace face : part.faces) {
        for (std::uint32_t& v : face.vertices) v = numbers[v];
        whole.faces.push_back(face);
    }
}

Mesh mesh_of(const Part& part, std::uint32_t level) {
    Mesh mesh;
    mesh.reserve(part.vertices.size(), part.faces.size());
    for (const PartVertex& vertex : part.vertices)
        mesh.add_vertex(vertex.position, vertex.sides, vertex.free_from > level);
    for (const PieceFace& face : part.faces)
        mesh.add_face(VertexId{face.vertices[0]}, VertexId{face.vertices[1]}, VertexId{face.vertices[2]},
                      face.labels[0], face.labels[1]);
    return mesh;
}

/// Faces on seams, which stay: two of their vertices at least are in other parts, too.
std::uint32_t faces_on_seams(const Part& part, std::uint32_t level) {
    const auto is_on_seam = [&](const PieceFace& face) {
        return std::ranges::count_if(face.vertices,
                                     [&](std::uint32_t v) { return part.vertices[v].free_from > level; }) > 1;
    };
    return static_cast<std::uint32_t>(std::ranges::count_if(part.faces, is_on_seam));
}

/// Simplifies a part to a mesh with an eighth of its faces, those on seams not counted: else the regions within it
/// would be as much coarser.
Mesh simplified(Part& part, std::uint32_t level) {
    Mesh mesh = mesh_of(part, level);
    SharedVertices locked;
    std::vector<std::uint32_t> levels;
    for (const PartVertex& vertex : part.vertices) {
        if (vertex.free_from <= level) continue;
        locked.number(vertex.position, static_cast<std::uint32_t>(levels.size()));
        levels.push_back(vertex.free_from);
    }
    SimplifyOptions options = next_level_options(mesh);
    const std::uint32_t on_seams = faces_on_seams(part, level);
    options.target_faces = (mesh.face_count() - on_seams) / kFacesPerLevel + on_seams;
    simplify(mesh, options);
    mesh.compact();
    part = {};
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const Vertex& vertex = mesh[VertexId{v}];
        part.vertices.push_back(
            {vertex.position, vertex.is_fixed ? levels[locked.number(vertex.position, 0)] : level, vertex.sides});
    }
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const Face& face = mesh[FaceId{f}];
        part.faces.push_back(
            {{index(face.vertices[0]), index(face.vertices[1]), index(face.vertices[2])}, face.labels});
    }
    return mesh;
}

class LevelMaker {
public:
    LevelMaker(const fs::path& folder, const Manifest& manifest, const ModelLevels::Visit& visit)
        : folder_(folder), manifest_(manifest), visit_(visit), grid_(piece_grid(manifest_)) {}

    void make(std::uint32_t levels) {
        if (levels > 1) shared_.emplace(folder_, manifest_, grid_);
        for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block) {
            if (manifest_.pieces[block].faces == 0) continue;
            const Piece piece = read_entry(manifest_, folder_, block);
            visit_(0, regionmesh::mesh_of(piece, manifest_));
            if (levels == 1) continue;
            Part part = part_of(piece);
            shared_->set(block, part);
            add(1, grid_.place(block), part);
        }
        shared_.reset();
        for (std::uint32_t level = 2; level < levels; ++level) make_from_parts(level);
    }

private:
    /// Reduces a part to its level.
    void add(std::uint32_t level, const Place& place, Part& part) {
        Mesh mesh = simplified(part, level);
        made_->put(place, part);
        part = {};
        unscale_z(mesh, manifest_.scale_z);
        place_in_space(mesh, manifest_.lattice);
        visit_(level, mesh);
    }

    void make_from_parts(std::uint32_t level) {
        const std::unique_ptr<StoredParts> last = std::exchange(made_, std::make_unique<StoredParts>());
        Place end;
        for (int axis = 0; axis < 3; ++axis) end[axis] = ((grid_.counts()[axis] - 1) >> (level - 1)) + 1;
        for (std::uint32_t n = 0; n < end[0] * end[1] * end[2]; ++n) {
            const Place place{n % end[0], n / end[0] % end[1], n / end[0] / end[1]};
            Part whole;
            SharedVertices shared;
            for (std::uint32_t child = 0; child < 8; ++child)
                if (const auto part = last->get(
                        {2 * place[0] + (child & 1), 2 * place[1] + (child >> 1 & 1), 2 * place[2] + (child >> 2)}))
                    join(whole, shared, *part, level);
            if (!whole.faces.empty()) add(level, place, whole);
        }
    }

    const fs::path& folder_;
    const Manifest& manifest_;
    const ModelLevels::Visit& visit_;
    BlockGrid grid_;
    std::optional<SharedLevels> shared_;
    std::unique_ptr<StoredParts> made_ = std::make_unique<StoredParts>();
};

class FolderLevels final : public ModelLevels {
public:
    FolderLevels(fs::path folder, const Manifest& manifest) : folder_(std::move(folder)), manifest_(manifest) {}

    std::uint64_t faces() const override { return manifest_.faces; }
    /// Reads the headers of the pieces.
    Box box() const override {
        Mesh corners;
        for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block) {
            const PieceEntry& entry = manifest_.pieces[block];
            if (entry.faces == 0) continue;
            const Box box = read_entry_header(manifest_, folder_, block).box;
            for (int n = 0; n < 8; ++n)
                corners.add_vertex(
                    {(n & 1 ? box.high : box.low).x, (n & 2 ? box.high : box.low).y, (n & 4 ? box.high : box.low).z});
        }
        unscale_z(corners, manifest_.scale_z);
        place_in_space(corners, manifest_.lattice);
        return extent_of(corners, 1);
    }
    void visit(std::uint32_t levels, const Visit& visit) override {
        LevelMaker(folder_, manifest_, visit).make(levels);
    }

private:
    fs::path folder_;
    const Manifest& manifest_;
};

}  // namespace

std::unique_ptr<ModelLevels> levels_of_folder(const fs::path& folder, const Manifest& manifest) {
    return std::make_unique<FolderLevels>(folder, manifest);
}

}  // namespace regionmesh
