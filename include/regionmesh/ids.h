// Distinct types for 32-bit ids, so that a vertex cannot be taken for a face.
#pragma once

#include <cstdint>

namespace regionmesh {

enum class VertexId : std::uint32_t {};
enum class FaceId : std::uint32_t {};

constexpr std::uint32_t index(VertexId v) { return static_cast<std::uint32_t>(v); }
constexpr std::uint32_t index(FaceId f) { return static_cast<std::uint32_t>(f); }

inline constexpr VertexId kNoVertex{0xFFFFFFFFu};
inline constexpr FaceId kNoFace{0xFFFFFFFFu};

}  // namespace regionmesh
