#include "smooth/smoother.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/error.h"
#include "regionmesh/process.h"

namespace regionmesh {

Smoother::Smoother(const SmoothOptions& options, const ChunkOrder& order)
    : options_(options),
      order_(order),
      neighbours_(options.move_points),
      filter_(make_filter({window_, neighbours_, options_, order_})),
      most_(filter_->farthest() * std::max(options.scale, order.thickness)),
      rounds_(window_, steps_, options_),
      resolver_(window_, steps_, options_) {
    if (std::isfinite(order.thickness)) held_ = 2 * order.chunks_within(most_) + 2 + order.overlap + order.extra;
    plan_stages();
}

void Smoother::plan_stages() {
    stages_.push_back({Stage::kNeighbours, 0, 1});
    for (std::uint32_t pass = 0; pass < filter_->pass_count(); ++pass)
        stages_.push_back({Stage::kPass, pass, filter_->chunks_ahead(pass)});
    // The first round writes over what the last pass read.
    for (std::uint32_t round = 0; round < BacktrackRounds::kRounds; ++round)
        stages_.push_back({Stage::kRound, round, round == 0 ? stages_.back().ahead : 1});
    stages_.push_back({Stage::kResolve, 0, 1});
    const std::uint32_t smooth_at = filter_->pass_count() % 2;
    steps_.smooth = &positions_[smooth_at];
    steps_.now = &positions_[1 - smooth_at];
}

std::uint32_t Smoother::most_chunks() const {
    std::uint32_t chunks = held_ + 1;
    for (const Stage& stage : stages_) chunks += stage.ahead;
    return chunks;
}

bool Smoother::add(const Chunk& chunk, bool is_last, double next_low) {
    window_.add(chunk);
    return work(is_last, next_low);
}

void Smoother::smooth_all(Mesh& mesh) {
    const std::vector<std::uint32_t> number = window_.add(mesh);
    resolver_.note_whole();
    if (!work(true, HUGE_VAL))
        throw Error(ErrorCode::kInput,
                    "smoothing: a region's volume is too small for a number; scale the coordinates, or do not smooth");
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) mesh[VertexId{v}].position = position(number[v]);
}

bool Smoother::next(Chunk& chunk) {
    if (released_ == ready_) return false;
    window_.copy_out(released_, *steps_.now, chunk);
    release_before(released_ + 1);
    return true;
}

/// Advances every stage as far as the chunks so far allow.
bool Smoother::work(bool is_last, double next_low) {
    is_last_ = is_last;
    next_low_ = next_low;
    const std::uint32_t chunk = window_.chunk_end() - 1;
    const NumberRange vertices = window_.vertices_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        for (auto& positions : positions_) positions.push_back(window_.origin[v]);
    double low = HUGE_VAL;
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) low = std::min(low, window_.origin[v][order_.axis]);
    low_.push_back(low - most_);
    resolver_.note_chunk(chunk);
    filter_->note_chunk(chunk);
    // A stage may work on a chunk when the stage before is `ahead` chunks further, or at the end.
    std::uint32_t done_before = window_.chunk_end();
    for (Stage& stage : stages_) {
        const bool is_all = is_last_ && done_before == window_.chunk_end();
        const std::uint32_t end = is_all ? done_before : done_before - std::min(done_before, stage.ahead);
        for (; stage.done < end; ++stage.done) {
            if (run(stage, stage.done)) continue;
            stuck_chunk_ = stage.done;
            return false;
        }
        done_before = stage.done;
        const bool is_last_pass = stage.kind == Stage::kPass && stage.number + 1 == filter_->pass_count();
        if (is_last_pass && !filter_->reads_earlier_neighbours() && stage.done < window_.chunk_end())
            neighbours_.drop_before(window_.vertices_of(stage.done).first);
    }
    note_bytes();
    ready_ = is_last_ ? window_.chunk_end() : done_before - std::min(done_before, held_);
    note_ready();
    return true;
}

/// False where the resolver is stuck.
bool Smoother::run(const Stage& stage, std::uint32_t chunk) {
    const bool is_guard = stage.kind == Stage::kRound || stage.kind == Stage::kResolve;
    const Timer timer(is_guard ? report_.guard_seconds : report_.filter_seconds);
    switch (stage.kind) {
        case Stage::kNeighbours: {
            const ChunkStars stars(window_, chunk);
            neighbours_.add_chunk(window_, stars, options_.threads);
            filter_->note_stars(stars);
            return true;
        }
        case Stage::kPass:
            filter_->run(stage.number, chunk, positions_[stage.number % 2], positions_[1 - stage.number % 2]);
            report_.vertex_passes += window_.vertices_of(chunk).size();
            return true;
        case Stage::kRound:
            if (stage.number == 0) begin_backtracking(chunk);
            rounds_.run(stage.number, chunk, is_last_ && chunk + 1 == window_.chunk_end());
            return true;
        case Stage::kResolve:
            if (!resolver_.add_chunk(chunk)) return false;
            if (held_ > 0 && chunk + 1 > held_) resolver_.release_before(chunk + 1 - held_);
            return true;
    }
    return true;
}

/// Puts all vertices of the chunk at their smoothed positions, or as far as they may go along the sweep.
void Smoother::begin_backtracking(std::uint32_t chunk) {
    const NumberRange vertices = window_.vertices_of(chunk);
    double low = HUGE_VAL;
    steps_.backtrack.grow(vertices.end);
    steps_.wanted.grow(vertices.end);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const Vec3 origin = window_.origin[v];
        Vec3& smooth = (*steps_.smooth)[v];
        const double along = std::abs(smooth[order_.axis] - origin[order_.axis]);
        if (along > most_) {
            smooth = origin + most_ / along * (smooth - origin);
            ++report_.held_vertices;
        }
        (*steps_.now)[v] = smooth;
        low = std::min({low, origin[order_.axis], smooth[order_.axis]});
    }
    low_[chunk] = low;
}

void Smoother::note_ready() {
    report_.turned_faces = rounds_.faults().turned;
    report_.low_quality_faces = rounds_.faults().low_quality;
    report_.crossing_pairs = resolver_.crossings();
    report_.islands = resolver_.islands();
    for (; noted_ < ready_; ++noted_) {
        note_chunk(window_, noted_, *steps_.now, report_);
        const NumberRange vertices = window_.vertices_of(noted_);
        for (std::uint32_t v = vertices.first; v < vertices.end; ++v) report_.backtracked += steps_.backtrack[v] > 0;
    }
}

void Smoother::note_bytes() {
    report_.window_chunks = std::max(report_.window_chunks, window_.chunk_end() - released_);
    const std::uint64_t bytes = window_.bytes() + positions_[0].bytes() + positions_[1].bytes() + neighbours_.bytes() +
                                filter_->bytes() + steps_.backtrack.bytes() + steps_.wanted.bytes() + resolver_.bytes();
    report_.window_bytes = std::max(report_.window_bytes, bytes);
}

void Smoother::release_before(std::uint32_t chunk) {
    released_ = chunk;
    const std::uint32_t first = window_.vertices_of(chunk - 1).first, face_end = window_.faces_of(chunk - 1).end;
    window_.drop_before(chunk);
    for (auto& positions : positions_) positions.drop_before(first);
    if (filter_->reads_earlier_neighbours()) neighbours_.drop_before(first);
    filter_->drop_before(first, face_end);
    steps_.backtrack.drop_before(first);
    steps_.wanted.drop_before(first);
    resolver_.drop_before(first);
    low_.drop_before(chunk);
}

double Smoother::safe_high() const {
    double low = is_last_ ? HUGE_VAL : next_low_ - most_;
    if (released_ == window_.chunk_end()) return low;
    for (std::uint32_t chunk = released_; chunk < window_.chunk_end(); ++chunk) low = std::min(low, low_[chunk]);
    // Faces to come use vertices that are final already.
    const NumberRange faces = window_.faces_of(released_);
    for (std::uint32_t f = faces.first; f < faces.end; ++f)
        for (std::uint32_t v : window_.faces[f].vertices)
            if (v < window_.vertices_of(released_).first) low = std::min(low, position(v)[order_.axis]);
    return low;
}

}  // namespace regionmesh
