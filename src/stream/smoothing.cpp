#include "stream/smoothing.h"

#include <cassert>

namespace regionmesh {

void Smoothing::add(const Chunk& batch, bool is_last, double plane) {
    assert(batch.carried == open_.size());
    SurfaceWindow& window = smoother_.window();
    const std::uint32_t first = window.origin.end();
    Strip strip{open_, {}};
    const auto number = [&](std::uint32_t local) {
        return local < batch.carried ? strip.carried[local] : first + (local - batch.carried);
    };
    for (const ChunkVertex& vertex : batch.vertices) {
        window.origin.push_back(vertex.position);
        window.sides.push_back(vertex.sides);
    }
    for (const ChunkFace& face : batch.faces)
        window.faces.push_back(
            {{number(face.vertices[0]), number(face.vertices[1]), number(face.vertices[2])}, face.labels});
    for (std::uint32_t local : batch.open) strip.open.push_back(number(local));
    open_ = strip.open;
    strips_.push_back(std::move(strip));
    smoother_.end_layer(is_last, plane);
}

bool Smoothing::next(Chunk& batch) {
    if (handed_out_ == smoother_.ready_end()) return false;
    hand_out(handed_out_++, strips_.front(), batch);
    strips_.pop_front();
    smoother_.release_before(handed_out_);
    return true;
}

void Smoothing::hand_out(std::uint32_t layer, const Strip& strip, Chunk& batch) {
    const SurfaceWindow& window = smoother_.read_window();
    const NumberRange vertices = window.vertices_of(layer), faces = window.faces_of(layer);
    batch.clear();
    batch.carried = static_cast<std::uint32_t>(strip.carried.size());
    // Carried vertices belong to the layer before; the others follow them in their order.
    const std::uint32_t before = layer == 0 ? vertices.first : window.vertices_of(layer - 1).first;
    std::vector<std::uint32_t> local_of_carried(vertices.first - before);
    for (std::uint32_t n = 0; n < batch.carried; ++n) local_of_carried[strip.carried[n] - before] = n;
    const auto local = [&](std::uint32_t v) {
        return v < vertices.first ? local_of_carried[v - before] : batch.carried + (v - vertices.first);
    };
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        batch.vertices.push_back({smoother_.place(v), window.sides[v]});
    for (std::uint32_t f = faces.first; f < faces.end; ++f) {
        const auto& [v, labels] = window.faces[f];
        batch.faces.push_back({{local(v[0]), local(v[1]), local(v[2])}, labels});
    }
    for (std::uint32_t v : strip.open) batch.open.push_back(local(v));
}

}  // namespace regionmesh
