// Multi-resolution meshes read back with Draco's decoder, by the rules of Neuroglancer's format.
#pragma once

#include <draco/compression/decode.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Corners in steps from the origin of the grid: 65535 in a chunk, at each level.
using DecodedPoint = std::array<std::int64_t, 3>;
using DecodedFace = std::array<DecodedPoint, 3>;

struct DecodedFragment {
    std::array<std::uint32_t, 3> chunk;
    std::vector<DecodedFace> faces;
};

struct DecodedRegion {
    Vec3 chunk_shape, origin;
    std::vector<float> scales;
    std::vector<std::vector<DecodedFragment>> levels;
    std::uint64_t fragment_bytes = 0;

    /// The length of a step at a level.
    double step(std::size_t level) const { return chunk_shape.x * static_cast<double>(1u << level) / 65535; }
    Vec3 position(const DecodedPoint& point, std::size_t level) const {
        return origin + Vec3{double(point[0]), double(point[1]), double(point[2])} * step(level);
    }
    std::vector<DecodedFace> faces(std::size_t level) const {
        std::vector<DecodedFace> all;
        for (const DecodedFragment& fragment : levels[level])
            all.insert(all.end(), fragment.faces.begin(), fragment.faces.end());
        return all;
    }
};

class WordReader {
public:
    explicit WordReader(std::string_view bytes) : bytes_(bytes) {}
    template <class T>
    T next() {
        T word{};
        EXPECT_LE(at_ + sizeof(T), bytes_.size());
        if (at_ + sizeof(T) <= bytes_.size()) std::memcpy(&word, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return word;
    }
    Vec3 vector() {
        Vec3 v;
        for (int axis = 0; axis < 3; ++axis) v[axis] = next<float>();
        return v;
    }
    bool is_at_end() const { return at_ == bytes_.size(); }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

inline std::vector<DecodedFace> decode_fragment(std::string_view bytes, const std::array<std::uint32_t, 3>& chunk) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    EXPECT_TRUE(decoded.ok());
    if (!decoded.ok()) return {};
    const draco::Mesh& mesh = *decoded.value();
    const draco::PointAttribute* positions = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
    EXPECT_EQ(positions->data_type(), draco::DT_INT32);
    std::vector<DecodedFace> faces(mesh.num_faces());
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (int n = 0; n < 3; ++n) {
            std::array<std::int32_t, 3> local{};
            positions->GetMappedValue(mesh.face(draco::FaceIndex(f))[n], local.data());
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_TRUE(local[axis] >= 0 && local[axis] <= 65535) << local[axis];
                faces[f][n][axis] = std::int64_t{65535} * chunk[axis] + local[axis];
            }
        }
    return faces;
}

/// Reads a manifest, and its fragments, which lie one after another from the beginning of `data`.
inline DecodedRegion decode_region(std::string_view manifest, std::string_view data) {
    DecodedRegion region;
    WordReader words(manifest);
    region.chunk_shape = words.vector();
    region.origin = words.vector();
    region.levels.resize(words.next<std::uint32_t>());
    for (std::size_t n = 0; n < region.levels.size(); ++n) region.scales.push_back(words.next<float>());
    for (std::size_t n = 0; n < region.levels.size(); ++n) EXPECT_EQ(words.vector(), Vec3{});
    for (auto& level : region.levels) level.resize(words.next<std::uint32_t>());
    for (auto& level : region.levels) {
        for (int axis = 0; axis < 3; ++axis)
            for (DecodedFragment& fragment : level) fragment.chunk[axis] = words.next<std::uint32_t>();
        for (DecodedFragment& fragment : level) {
            const auto bytes = words.next<std::uint32_t>();
            if (bytes > 0) fragment.faces = decode_fragment(data.substr(region.fragment_bytes, bytes), fragment.chunk);
            region.fragment_bytes += bytes;
        }
    }
    EXPECT_TRUE(words.is_at_end());
    return region;
}

}  // namespace regionmesh
