// Multi-resolution meshes (neuroglancer_multilod_draco): for each region an octree of fragments and a manifest.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/external_sort.h"
#include "blocks/precomputed/chunk_grid.h"
#include "blocks/precomputed/draco_fragment.h"
#include "blocks/precomputed/precomputed.h"
#include "blocks/precomputed/region_files.h"

namespace regionmesh {
namespace {

constexpr std::uint64_t kSortBytes = 64 << 20;

using ChunkPlace = std::array<std::uint32_t, 3>;

/// Bits of x, y and z in turn, those of x lowest: the order of fragments.
std::uint64_t along_curve(const ChunkPlace& place) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 21; ++bit)
        for (int axis = 0; axis < 3; ++axis) code |= std::uint64_t{place[axis] >> bit & 1} << (3 * bit + axis);
    return code;
}

ChunkPlace place_along_curve(std::uint64_t code) {
    ChunkPlace place{};
    for (int bit = 0; bit < 21; ++bit)
        for (int axis = 0; axis < 3; ++axis) place[axis] |= (code >> (3 * bit + axis) & 1) << bit;
    return place;
}

/// A part of a face on one side, in the order of files.
struct SortedFace {
    std::uint32_t rank;  // rank of the region
    std::uint32_t level;
    std::uint64_t chunk;  // along the curve
    std::array<std::array<std::uint16_t, 3>, 3> corners;

    auto operator<=>(const SortedFace&) const = default;
};

/// Regions in the order of shard, minishard and id.
class RegionOrder {
public:
    RegionOrder(const Precomputed& precomputed, ShardLayout layout) : ranks_(precomputed.labels.size()) {
        for (Label label = 0; label < ranks_.size(); ++label)
            if (precomputed.is_region(label)) labels_.push_back(label);
        std::ranges::sort(labels_, {}, [&](Label label) {
            const auto id = static_cast<std::uint64_t>(precomputed.labels.input(label));
            return std::tuple(layout.shard(id), layout.minishard(id), id);
        });
        for (std::uint32_t rank = 0; rank < labels_.size(); ++rank) ranks_[labels_[rank]] = rank;
    }
    std::uint32_t rank(Label label) const { return ranks_[label]; }
    Label label(std::uint32_t rank) const { return labels_[rank]; }

private:
    std::vector<std::uint32_t> ranks_;
    std::vector<Label> labels_;
};

/// The box of the model in nanometres.
Box box_of(const ModelLevels& model, double nanometres) {
    const Box box = model.box();
    if (box.is_empty()) return {{0, 0, 0}, {1, 1, 1}};
    return {box.low * nanometres, box.high * nanometres};
}

/// Chunks of such a size that the last level has one.
ChunkGrid grid_over(const Box& box, std::uint32_t levels) {
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, box.high[axis] - box.low[axis]);
    // A little more: the origin may be rounded down.
    return {box, std::ldexp(longest * (1 + 1e-6), 1 - static_cast<int>(levels))};
}

/// Fragments of a region, by level, along the curve, with their sizes in bytes.
using Fragments = std::vector<std::map<std::uint64_t, std::uint32_t>>;

/// Each fragment needs one round it at the next level, without faces where there are none.
void add_parents(Fragments& fragments) {
    for (std::size_t level = 0; level + 1 < fragments.size(); ++level)
        for (const auto& [code, bytes] : fragments[level]) fragments[level + 1].try_emplace(code >> 3, 0);
}

class Bytes {
public:
    void add(float number) { text_.append(reinterpret_cast<const char*>(&number), sizeof number); }
    void add(std::uint32_t number) { text_.append(reinterpret_cast<const char*>(&number), sizeof number); }
    void add(Vec3 v) {
        for (int axis = 0; axis < 3; ++axis) add(static_cast<float>(v[axis]));
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

std::string manifest_bytes(const ChunkGrid& grid, const std::vector<double>& scales, const Fragments& fragments) {
    Bytes bytes;
    bytes.add(Vec3{grid.chunk(), grid.chunk(), grid.chunk()});
    bytes.add(grid.origin());
    bytes.add(static_cast<std::uint32_t>(fragments.size()));
    for (std::size_t level = 0; level < fragments.size(); ++level) bytes.add(static_cast<float>(scales[level]));
    for (std::size_t level = 0; level < fragments.size(); ++level) bytes.add(Vec3{});  // offsets of vertices
    for (const auto& level : fragments) bytes.add(static_cast<std::uint32_t>(level.size()));
    for (const auto& level : fragments) {
        for (int axis = 0; axis < 3; ++axis)
            for (const auto& [code, size] : level) bytes.add(place_along_curve(code)[axis]);
        for (const auto& [code, size] : level) bytes.add(size);
    }
    return bytes.text();
}

/// Corners become vertices, in the order in which they come.
class FragmentBuilder {
public:
    void add(const SortedFace& face) {
        std::array<std::uint32_t, 3> corners{};
        for (int n = 0; n < 3; ++n) {
            const auto& p = face.corners[n];
            const std::uint64_t key = std::uint64_t{p[0]} << 32 | std::uint64_t{p[1]} << 16 | p[2];
            const auto [place, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
            if (is_new) mesh_.positions.push_back(p);
            corners[n] = place->second;
        }
        mesh_.faces.push_back(corners);
    }
    std::string take() {
        const std::string bytes = encode_draco(mesh_);
        mesh_ = {};
        numbers_.clear();
        return bytes;
    }

private:
    FragmentMesh mesh_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

class MultiResolutionWriter {
public:
    MultiResolutionWriter(const Precomputed& precomputed, ModelLevels& model)
        : precomputed_(precomputed),
          model_(model),
          levels_(precomputed.options.levels > 0 ? precomputed.options.levels : level_count(model.faces())),
          layout_(precomputed.options.is_sharded ? shard_layout(precomputed.labels.size()) : ShardLayout{}),
          order_(precomputed, layout_),
          grid_(grid_over(box_of(model, precomputed.nanometres()), levels_)),
          area_(levels_),
          count_(levels_) {}

    WrittenRegions write() {
        model_.visit(levels_, [&](std::uint32_t level, const Mesh& mesh) { take(level, mesh); });
        faces_.finish();
        const auto files =
            precomputed_.options.is_sharded ? shards_of_regions(precomputed_, layout_) : files_of_regions(precomputed_);
        const std::vector<double> scales = find_scales();
        SortedFace face;
        for (bool has = faces_.next(face); has;) has = write_region(face, scales, *files);
        files->finish();
        written_.info = info();
        return written_;
    }

private:
    /// Cuts the faces of a mesh of a level, once for each region.
    void take(std::uint32_t level, const Mesh& mesh) {
        std::vector<StepPoint> places;
        std::vector<Vec3> positions;
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
            positions.push_back(mesh.position(VertexId{v}) * precomputed_.nanometres());
            places.push_back(grid_.nearest(positions.back(), level));
            if (level == 0) written_.box.add(positions.back());
        }
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
            const Face& face = mesh[FaceId{f}];
            const auto at = [&](int n) { return index(face.vertices[n]); };
            area_[level] += length(cross(positions[at(1)] - positions[at(0)], positions[at(2)] - positions[at(0)])) / 2;
            ++count_[level];
            grid_.cut({places[at(0)], places[at(1)], places[at(2)]}, level,
                      [&](const ChunkFacePart& part) { add(level, face.labels, part); });
            for (const Label label : face.labels)
                if (level == 0 && precomputed_.is_region(label)) ++written_.faces[label];
        }
    }

    void add(std::uint32_t level, const std::array<Label, 2>& labels, const ChunkFacePart& part) {
        for (int side = 0; side < 2; ++side) {
            if (!precomputed_.is_region(labels[side])) continue;
            auto corners = part.corners;
            if (side == 1) std::swap(corners[1], corners[2]);
            faces_.add({order_.rank(labels[side]), level, along_curve(part.chunk), corners});
        }
    }

    /// The resolution of each level: the edge of an equilateral face of mean area.
    std::vector<double> find_scales() const {
        std::vector<double> scales;
        for (std::uint32_t level = 0; level < levels_; ++level) {
            const double mean = count_[level] > 0 ? area_[level] / static_cast<double>(count_[level]) : 1;
            const double edge = std::sqrt(4 / std::sqrt(3.0) * mean);
            scales.push_back(level > 0 ? std::max(edge, scales.back()) : edge);
        }
        return scales;
    }

    /// Reads the region that begins with `face`. Returns whether another one follows, which `face` then begins.
    bool write_region(SortedFace& face, const std::vector<double>& scales, RegionFiles& files) {
        const std::uint32_t rank = face.rank;
        const Label label = order_.label(rank);
        Fragments fragments(1);
        bool has = true;
        while (has && face.rank == rank) {
            const std::uint32_t level = face.level;
            const std::uint64_t chunk = face.chunk;
            for (; has && face.rank == rank && face.level == level && face.chunk == chunk; has = faces_.next(face))
                fragment_.add(face);
            const std::string bytes = fragment_.take();
            files.add_fragment(label, bytes);
            fragments.resize(std::max<std::size_t>(fragments.size(), level + 1));
            fragments[level].emplace(chunk, static_cast<std::uint32_t>(bytes.size()));
        }
        add_parents(fragments);
        files.add_manifest(label, manifest_bytes(grid_, scales, fragments));
        return has;
    }

    Json info() const {
        Json info{{"@type", "neuroglancer_multilod_draco"},
                  {"vertex_quantization_bits", 16},
                  {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                  {"lod_scale_multiplier", 1}};
        if (precomputed_.options.is_sharded)
            info["sharding"] = {{"@type", "neuroglancer_uint64_sharded_v1"},
                                {"preshift_bits", 0},
                                {"hash", "identity"},
                                {"minishard_bits", layout_.minishard_bits},
                                {"shard_bits", layout_.shard_bits},
                                {"minishard_index_encoding", "raw"},
                                {"data_encoding", "raw"}};
        return info;
    }

    const Precomputed& precomputed_;
    ModelLevels& model_;
    std::uint32_t levels_;
    ShardLayout layout_;
    RegionOrder order_;
    ChunkGrid grid_;
    std::vector<double> area_;
    std::vector<std::uint64_t> count_;
    ExternalSort<SortedFace> faces_{kSortBytes};
    FragmentBuilder fragment_;
    WrittenRegions written_;
};

}  // namespace

WrittenRegions write_multi_resolution_meshes(const Precomputed& precomputed, ModelLevels& model) {
    return MultiResolutionWriter(precomputed, model).write();
}

}  // namespace regionmesh
