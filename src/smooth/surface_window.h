// The layers of a surface that smoothing holds at a time, as flat arrays.
#pragma once

#include <array>
#include <cstdint>

#include "base/sliding_array.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct WindowFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<Label, 2> labels;  // the normal points from the first to the second
};

/// Numbers from `first` up to `end`, without it.
struct NumberRange {
    std::uint32_t first = 0, end = 0;
    std::uint32_t size() const { return end - first; }
};

/// A layer is what one strip adds: its faces, and the vertices that they are the first to use. A face has vertices of
/// its own layer and the one before, so that all faces of a vertex lie in its layer and the next. A surface that is
/// wholly in core is one layer.
class SurfaceWindow {
public:
    SlidingArray<Vec3> origin;  // places before smoothing
    SlidingArray<SideSet> sides;
    SlidingArray<WindowFace> faces;

    SurfaceWindow() { layers_.push_back({0, 0}); }

    /// Vertices and faces added since the last call are a layer.
    void end_layer() { layers_.push_back({origin.end(), faces.end()}); }
    std::uint32_t layer_end() const { return layers_.end() - 1; }
    std::uint32_t first_layer() const { return layers_.first(); }
    NumberRange vertices_of(std::uint32_t layer) const { return {layers_[layer].vertex, layers_[layer + 1].vertex}; }
    NumberRange faces_of(std::uint32_t layer) const { return {layers_[layer].face, layers_[layer + 1].face}; }

    /// Lets go of the layers before this one; vertices of the last of them stay for the faces that use them.
    void drop_before(std::uint32_t layer) {
        if (layer == 0) return;
        layers_.drop_before(layer - 1);
        origin.drop_before(layers_[layer - 1].vertex);
        sides.drop_before(layers_[layer - 1].vertex);
        faces.drop_before(layers_[layer].face);
    }
    std::size_t bytes() const { return origin.bytes() + sides.bytes() + faces.bytes(); }

private:
    struct Start {
        std::uint32_t vertex, face;
    };
    SlidingArray<Start> layers_;
};

}  // namespace regionmesh
