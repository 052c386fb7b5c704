#include "stream/strips.h"

#include <utility>

#include "base/parallel_invoke.h"
#include "base/stop.h"

namespace regionmesh {

ChunkOrder strip_order(const SourceShape& shape, std::uint32_t extra) {
    return {.axis = shape.axis(),
            .thickness = shape.strip_thickness,
            .overlap = shape.strip_overlap,
            .extra = extra,
            .frame = {shape.lattice.origin, shape.lattice.spacing},
            .cells = shape.cells};
}

std::uint32_t window_strips(const SmoothOptions& options, const ChunkOrder& order) {
    return options.passes > 0 ? make_chunk_smoother(options, order)->most_chunks() : 0;
}

Strips::Strips(FaceSource& source, const SmoothOptions& options, const ChunkOrder& order, RunLog& log)
    : source_(source), log_(log), threads_(options.threads) {
    if (options.passes > 0) smoother_ = make_chunk_smoother(options, order);
}

std::optional<std::uint32_t> Strips::stuck_strip() const { return smoother_ ? smoother_->stuck_chunk() : std::nullopt; }

bool Strips::next(Chunk& strip) {
    if (!(smoother_ ? smooth_next(strip) : mesh_next(strip))) return false;
    ++count_;
    log_.note_strips_through(WorkStage::kSmooth, count_);
    return true;
}

bool Strips::mesh_next(Chunk& strip) {
    throw_if(stop_of_this_thread());
    {
        const StageTimer timer = log_.time("read");
        if (!source_.advance()) return false;
    }
    {
        const StageTimer timer = log_.time("reconstruct");
        source_.make_faces(strip);
    }
    log_.note_strip(source_.strips_read(), strip.faces.size(), strip.vertices.size());
    return true;
}

/// Feeds the smoother until a strip comes out. The faces of the next strip are made while one is added.
bool Strips::smooth_next(Chunk& strip) {
    for (;;) {
        {
            const StageTimer timer = log_.time("smooth");
            if (smoother_->next(strip)) return true;
        }
        if (std::exchange(is_ahead_, false))
            std::swap(strip, ahead_);
        else if (!mesh_next(strip))
            return false;
        const bool is_last = source_.is_last();
        const double next_low = source_.low_of(source_.strips_read());
        bool is_added = false;
        parallel_invoke(
            threads_, [&] { is_ahead_ = !is_last && mesh_next(ahead_); },
            [&] {
                const StageTimer timer = log_.time("smooth");
                is_added = smoother_->add(strip, is_last, next_low);
            });
        if (!is_added) return false;
    }
}

}  // namespace regionmesh
