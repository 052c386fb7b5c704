#include "stream/gatherer.h"

#include <algorithm>

namespace regionmesh {

bool Gatherer::next(Chunk& chunk) {
    const FaceSource& source = strips_.source();
    const std::uint32_t first = strips_.count();
    chunk.clear();
    while (strips_.count() - first < chunk_strips_ && strips_.next(strip_)) {
        const StageTimer timer = log_.time("reconstruct");
        chunk.append(strip_);
    }
    const bool is_whole = strips_.count() - first == chunk_strips_ || strips_.is_at_end();
    if (strips_.count() == first || !is_whole) return false;
    ++count_;
    // Earlier chunks may reach up into this one, and later ones down.
    safe_.low = std::max(source.low_of(first), reach_);
    safe_.high = std::min(source.low_of(strips_.count()), strips_.safe_high());
    for (const ChunkVertex& vertex : chunk.vertices) reach_ = std::max(reach_, vertex.position[source.shape().axis()]);
    carried_ = std::move(active_);
    active_.clear();
    for (std::uint32_t local : chunk.active)
        active_.push_back(local < chunk.carried ? carried_[local] : chunk.vertices[local - chunk.carried]);
    return true;
}

}  // namespace regionmesh
