// How large is a model?
#pragma once

#include <cstdint>

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/base/vec3.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// The box round all vertices.
inline Box extent_of(const Model& model, std::uint32_t threads) {
    Box extent;
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        Box box;
        for (std::uint32_t v = first; v < end; ++v)
            if (model.is_alive(VertexId{v})) box.add(model.position(VertexId{v}));
        return box;
    };
    for_chunks(model.vertex_end(), 1 << 16, threads, find, [&](const Box& box) { extent.join(box); });
    return extent;
}

}  // namespace regionmesh
