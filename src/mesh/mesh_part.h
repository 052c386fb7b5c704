// A part of a surface in a mesh that also has the faces round it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "regionmesh/ids.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The part of each vertex and each face. Each belongs to one. The mesh has all faces whose boxes reach into
/// the space of the part.
struct MeshPart {
    std::uint32_t number = 0;
    std::vector<std::uint32_t> of_vertex, of_face;
    std::vector<Vec3> low_of_face;                    // the low corner of its box
    std::vector<std::uint64_t> key_of_face;           // below 2^63, the same in all parts that have the face
    std::function<std::uint32_t(Vec3)> at = nullptr;  // the part whose space has a point

    bool has(VertexId v) const { return of_vertex[index(v)] == number; }
    bool has(FaceId f) const { return of_face[index(f)] == number; }
    /// A pair of faces belongs to the part at the low corner of what their boxes have in common: it has both.
    bool has(FaceId f, FaceId g) const { return at(max(low_of_face[index(f)], low_of_face[index(g)])) == number; }

    /// The parts that have the corners of a face.
    struct Span {
        std::uint32_t first, last;
        bool has_own;  // this part has one
    };
    Span span_of(const std::array<VertexId, 3>& corners) const {
        Span span{of_vertex[index(corners[0])], of_vertex[index(corners[0])], false};
        for (const VertexId v : corners) {
            span.first = std::min(span.first, of_vertex[index(v)]);
            span.last = std::max(span.last, of_vertex[index(v)]);
            span.has_own |= has(v);
        }
        return span;
    }
    std::string text() const { return text_of(number); }
    static std::string text_of(std::uint32_t number) { return " in part " + std::to_string(number); }
};

}  // namespace regionmesh
