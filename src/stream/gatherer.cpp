#include "stream/gatherer.h"

#include <algorithm>

namespace regionmesh {

bool Gatherer::next(GatheredStrips& made) {
    const FaceSource& source = strips_.source();
    const std::uint32_t first = strips_.count();
    Chunk& chunk = made.chunk;
    chunk.clear();
    // Room that is never written costs no memory, and growth would hold two copies. Arrays of an earlier chunk are used
    // again.
    if (chunk.vertices.capacity() < most_vertices_) chunk.vertices.reserve(most_vertices_ + most_vertices_ / 4);
    if (chunk.faces.capacity() < most_faces_) chunk.faces.reserve(most_faces_ + most_faces_ / 4);
    while (strips_.count() - first < chunk_strips_ && strips_.next(strip_)) {
        const StageTimer timer = log_.time("reconstruct");
        chunk.append(strip_);
    }
    most_vertices_ = std::max(most_vertices_, chunk.vertices.size());
    most_faces_ = std::max(most_faces_, chunk.faces.size());
    made.end = strips_.count();
    made.is_last = strips_.is_at_end();
    made.safe_high = strips_.safe_high();
    const bool is_whole = made.end - first == chunk_strips_ || made.is_last;
    if (made.end == first || !is_whole) return false;
    // Earlier chunks may reach up into this one, and later ones down.
    made.safe = {std::max(source.low_of(first), reach_), std::min(source.low_of(made.end), made.safe_high)};
    for (const ChunkVertex& vertex : chunk.vertices) reach_ = std::max(reach_, vertex.position[source.shape().axis()]);
    made.carried = std::move(active_);
    active_ = active_vertices(chunk, made.carried);
    return true;
}

}  // namespace regionmesh
