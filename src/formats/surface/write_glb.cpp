// Binary glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "formats/codec/number_writer.h"
#include "formats/report/json_parts.h"
#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "mesh/extent.h"
#include "regionmesh/error.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

constexpr int kFloat = 5126, kUnsignedInt = 5125;            // types of components
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;  // purposes of buffer views
constexpr std::uint64_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// Vertices and outward faces of one region. Without normals glTF shades faces flat.
struct Part {
    std::vector<VertexId> vertices;
    std::vector<std::uint32_t> corners;
};

/// A colour of sRGB in linear RGB, as glTF needs it, without transparency.
std::array<double, 4> linear_colour(std::uint32_t colour) {
    std::array<double, 4> linear{0, 0, 0, 1};
    for (int n = 0; n < 3; ++n) {
        const double value = (colour >> (16 - 8 * n) & 0xFF) / 255.0;
        linear[n] = std::round(1e4 * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4))) / 1e4;
    }
    return linear;
}

class GlbWriter {
public:
    GlbWriter(const FileView& view, double metres, OutputFile& file)
        : view_(view),
          file_(file),
          metres_(metres),
          regions_(view),
          faces_(faces_by_region(view, regions_)),
          colours_(region_colours(view)),
          middle_(middle_of(view)) {}

    void write() {
        std::string json = describe();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        const std::uint64_t total = 12 + 8 + json.size() + 8 + bytes_;
        if (total > std::numeric_limits<std::uint32_t>::max())
            throw Error(ErrorCode::kOutput, fmt::format("a .glb holds 4 GiB, and the model takes {} bytes: decimate it "
                                                        "further, or write .vtp",
                                                        total));
        formats::NumberWriter numbers(file_);
        const auto put = [&](std::uint64_t word) { numbers.put(static_cast<std::uint32_t>(word)); };
        for (const std::uint64_t word : {kMagic, kVersion, total, std::uint64_t{json.size()}, kJsonChunk}) put(word);
        numbers.flush();
        file_.write(json);
        put(bytes_);
        put(kBinaryChunk);
        for (std::size_t n = 0; n < regions_.all().size(); ++n) {
            const Part part = part_of(n);
            for (const VertexId v : part.vertices)
                for (const float number : position(v)) numbers.put(number);
            for (const std::uint32_t corner : part.corners) put(corner);
        }
        numbers.flush();
    }

private:
    static Vec3 middle_of(const FileView& view) {
        const Box box = extent_of(view.mesh(), 0);
        return box.is_empty() ? Vec3{} : 0.5 * (box.low + box.high);
    }

    std::array<float, 3> position(VertexId v) const {
        const Vec3 p = view_.mesh().position(v) - middle_;
        return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }

    Part part_of(std::size_t group) const {
        Part part;
        faces_.for_group(group, [&](FaceId f, std::uint32_t side) {
            for (const VertexId v : turned_vertices(view_.mesh(), f, side)) part.vertices.push_back(v);
        });
        const std::vector<VertexId> corners = part.vertices;
        std::ranges::sort(part.vertices);
        part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());
        for (const VertexId v : corners)
            part.corners.push_back(
                static_cast<std::uint32_t>(std::ranges::lower_bound(part.vertices, v) - part.vertices.begin()));
        return part;
    }

    /// Adds a view of the next `bytes` of the buffer and an accessor for its contents.
    std::size_t add_accessor(Json& json, Json accessor, std::uint64_t bytes, int target) {
        accessor["bufferView"] = json["bufferViews"].size();
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", bytes}, {"target", target}});
        bytes_ += bytes;
        json["accessors"].push_back(std::move(accessor));
        return json["accessors"].size() - 1;
    }

    Json positions_json(const Part& part) const {
        std::array<float, 3> low = position(part.vertices[0]), high = low;
        for (const VertexId v : part.vertices) {
            const auto p = position(v);
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], p[axis]);
                high[axis] = std::max(high[axis], p[axis]);
            }
        }
        return {
            {"componentType", kFloat}, {"count", part.vertices.size()}, {"type", "VEC3"}, {"min", low}, {"max", high}};
    }

    void add_region(std::size_t n, Json& json) {
        const FileRegion& region = regions_.all()[n];
        const Part part = part_of(n);
        const std::size_t positions = add_accessor(json, positions_json(part), 12 * part.vertices.size(), kArrayBuffer);
        const std::size_t corners =
            add_accessor(json, {{"componentType", kUnsignedInt}, {"count", part.corners.size()}, {"type", "SCALAR"}},
                         4 * part.corners.size(), kElementBuffer);
        const InputLabel label = view_.labels().input(region.label);
        json["materials"].push_back({{"name", region.title},
                                     {"pbrMetallicRoughness",
                                      {{"baseColorFactor", linear_colour(colours_[view_.rank(region.label)])},
                                       {"metallicFactor", 0},
                                       {"roughnessFactor", 0.7}}}});
        json["meshes"].push_back(
            {{"name", region.title},
             {"primitives",
              Json::array({{{"attributes", {{"POSITION", positions}}}, {"indices", corners}, {"material", n}}})}});
        json["nodes"].push_back(
            {{"name", region.title}, {"mesh", n}, {"extras", {{"label", label_json(label, view_.labels())}}}});
        json["nodes"][0]["children"].push_back(n + 1);
    }

    /// The JSON of the file; counts the bytes of the buffer.
    std::string describe() {
        const double half = std::sqrt(0.5);  // a quarter turn: y is up in glTF, z in volumes
        Json json{{"asset", {{"version", "2.0"}, {"generator", "regionmesh"}}}, {"scene", 0}};
        json["scenes"] = Json::array({{{"nodes", {0}}}});
        json["nodes"] = Json::array({{{"name", "model"}, {"rotation", {-half, 0, 0, half}}}});
        if (regions_.all().empty()) return json.dump();
        // glTF applies the rotation before the translation.
        json["nodes"][0]["translation"] = {metres_ * middle_.x, metres_ * middle_.z, -metres_ * middle_.y};
        if (metres_ != 1) json["nodes"][0]["scale"] = {metres_, metres_, metres_};
        for (std::size_t n = 0; n < regions_.all().size(); ++n) add_region(n, json);
        json["buffers"] = Json::array({{{"byteLength", bytes_}}});
        return json.dump();
    }

    const FileView& view_;
    OutputFile& file_;
    double metres_;  // in a unit of the coordinates
    FileRegions regions_;
    GroupedFaces faces_;
    std::vector<std::uint32_t> colours_;  // by place in the order of files
    Vec3 middle_;
    std::uint64_t bytes_ = 0;  // of the buffer
};

}  // namespace

void write_glb(const FileView& view, double metres, OutputFile& file) { GlbWriter(view, metres, file).write(); }

}  // namespace regionmesh
