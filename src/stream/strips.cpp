#include "stream/strips.h"

#include "cells/compact_cells.h"

namespace regionmesh {

namespace {

/// Weights are rounded: they stay above the margin for which the faces are proved to be embedded.
constexpr double kRoundedMargin = CompactCells::kInnerMargin + 1e-6;

}  // namespace

ChunkOrder strip_order(const SourceShape& shape, std::uint32_t extra) {
    return {.axis = shape.axis(),
            .thickness = shape.strip_thickness,
            .overlap = shape.strip_overlap,
            .extra = extra,
            .frame = {shape.lattice.origin, shape.lattice.spacing},
            .inner_margin = shape.cells == CellKind::kCompact ? kRoundedMargin : 0};
}

std::uint32_t window_strips(const SmoothOptions& options, const ChunkOrder& order) {
    return options.passes > 0 ? make_chunk_smoother(options, order)->most_chunks() : 0;
}

Strips::Strips(FaceSource& source, const SmoothOptions& options, const ChunkOrder& order, RunLog& log)
    : source_(source), log_(log) {
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

/// Feeds the smoother until a strip comes out.
bool Strips::smooth_next(Chunk& strip) {
    for (;;) {
        {
            const StageTimer timer = log_.time("smooth");
            if (smoother_->next(strip)) return true;
        }
        if (!mesh_next(strip)) return false;
        const StageTimer timer = log_.time("smooth");
        if (!smoother_->add(strip, source_.is_last(), source_.low_of(source_.strips_read()))) return false;
    }
}

}  // namespace regionmesh
