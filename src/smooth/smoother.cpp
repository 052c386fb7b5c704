#include "smooth/smoother.h"

#include <algorithm>
#include <cmath>

#include "mesh/region_volumes.h"
#include "regionmesh/process.h"
#include "smooth/relax.h"

namespace regionmesh {
namespace {

/// Farthest that a vertex may go along the sweep, in units of the larger of scale and strip. Taubin's filter comes
/// nowhere near; Laplace's does at the ends of threads.
double farthest(const SmoothOptions& options) {
    switch (options.filter) {
        case SmoothFilter::kTaubin:
            return 1 + options.passes / 20.0;
        case SmoothFilter::kLaplacian:
            return 1 + options.passes / 10.0;
        case SmoothFilter::kNifpms:
            return options.nifpms_reach;
    }
    return 0;
}

std::uint32_t layers_within(double length, const LayerOrder& order) {
    return static_cast<std::uint32_t>(std::ceil(length / order.thickness));
}

}  // namespace

Smoother::Smoother(const SmoothOptions& options, const LayerOrder& order)
    : options_(options),
      order_(order),
      most_(farthest(options) * std::max(options.scale, order.thickness)),
      neighbours_(options.move_points),
      nifpms_(window_, neighbours_, options_),
      rounds_(window_, stand_, options_),
      settling_(window_, stand_, options_) {
    if (std::isfinite(order.thickness)) held_ = 2 * layers_within(most_, order) + 2 + order.overlap + options.more_hold;
    plan_stages();
}

void Smoother::plan_stages() {
    stages_.push_back({Stage::kNeighbours, 0, 1});
    if (options_.filter == SmoothFilter::kNifpms) {
        stages_.push_back({Stage::kMollify, 0, layers_within(nifpms_.mollifying_reach(), order_) + 1 + order_.overlap});
        stages_.push_back({Stage::kPredict, 1, layers_within(nifpms_.predicting_reach(), order_) + 1 + order_.overlap});
        smooth_at_ = 0;
    } else {
        for (std::uint32_t pass = 0; pass < options_.passes; ++pass) stages_.push_back({Stage::kRelax, pass, 1});
        smooth_at_ = static_cast<int>(options_.passes % 2);
    }
    // The first round writes over what the last pass read.
    for (std::uint32_t round = 0; round < StepBackRounds::kRounds; ++round)
        stages_.push_back({Stage::kRound, round, round == 0 ? stages_.back().reach : 1});
    stages_.push_back({Stage::kSettle, 0, 1});
    stand_.smooth = &places_[smooth_at_];
    stand_.now = &places_[1 - smooth_at_];
}

std::uint32_t Smoother::most_layers() const {
    std::uint32_t layers = held_ + 1;
    for (const Stage& stage : stages_) layers += stage.reach;
    return layers;
}

void Smoother::end_layer(bool is_last, double plane) {
    window_.end_layer();
    is_last_ = is_last;
    plane_ = plane;
    const std::uint32_t layer = window_.layer_end() - 1;
    const NumberRange vertices = window_.vertices_of(layer);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        for (auto& places : places_) places.push_back(window_.origin[v]);
    double low = HUGE_VAL;
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) low = std::min(low, window_.origin[v][order_.axis]);
    low_.push_back(low - most_);
    settling_.note_layer(layer);
    if (options_.filter == SmoothFilter::kNifpms) nifpms_.note_layer(layer);
    // A stage may work on a layer when the stage before has done `reach` more, or all.
    std::uint32_t done_before = window_.layer_end();
    for (Stage& stage : stages_) {
        const bool is_all = is_last_ && done_before == window_.layer_end();
        const std::uint32_t end = is_all ? done_before : done_before - std::min(done_before, stage.reach);
        for (; stage.done < end; ++stage.done) run(stage, stage.done);
        done_before = stage.done;
        // After the last pass nobody asks for neighbours.
        if (stage.kind == Stage::kRelax && stage.number + 1 == options_.passes && stage.done < window_.layer_end())
            neighbours_.drop_before(window_.vertices_of(stage.done).first);
    }
    note_bytes();
    ready_ = is_last_ ? window_.layer_end() : done_before - std::min(done_before, held_);
    note_ready();
}

void Smoother::run(const Stage& stage, std::uint32_t layer) {
    const bool is_guard = stage.kind == Stage::kRound || stage.kind == Stage::kSettle;
    const Timer timer(is_guard ? report_.guard_seconds : report_.filter_seconds);
    const NumberRange vertices = window_.vertices_of(layer);
    switch (stage.kind) {
        case Stage::kNeighbours: {
            const LayerStars stars(window_, layer);
            neighbours_.add_layer(window_, stars, options_.threads);
            if (options_.filter == SmoothFilter::kNifpms) nifpms_.add_layer(stars);
            return;
        }
        case Stage::kRelax:
            relax(window_, neighbours_, vertices, relax_factor(options_, stage.number), places_[stage.number % 2],
                  places_[1 - stage.number % 2], options_.threads);
            break;
        case Stage::kMollify:
            nifpms_.mollify(vertices, places_[1]);
            break;
        case Stage::kPredict:
            nifpms_.predict(vertices, window_.faces_of(std::min(layer + stage.reach, window_.layer_end()) - 1).end,
                            places_[1], places_[0]);
            break;
        case Stage::kRound:
            if (stage.number == 0) begin_stepping_back(layer);
            rounds_.run(stage.number, layer, is_last_ && layer + 1 == window_.layer_end());
            return;
        case Stage::kSettle:
            settling_.add_layer(layer);
            if (held_ > 0 && layer + 1 > held_) settling_.let_go_before(layer + 1 - held_);
            return;
    }
    report_.vertex_passes += vertices.size();
}

/// All vertices of the layer stand where smoothing took them, but within reach.
void Smoother::begin_stepping_back(std::uint32_t layer) {
    const NumberRange vertices = window_.vertices_of(layer);
    double low = HUGE_VAL;
    stand_.level.grow(vertices.end);
    stand_.wanted.grow(vertices.end);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const Vec3 origin = window_.origin[v];
        Vec3& smooth = (*stand_.smooth)[v];
        const double along = std::abs(smooth[order_.axis] - origin[order_.axis]);
        if (along > most_) {
            smooth = origin + most_ / along * (smooth - origin);
            ++report_.held_vertices;
        }
        (*stand_.now)[v] = smooth;
        low = std::min({low, origin[order_.axis], smooth[order_.axis]});
    }
    low_[layer] = low;
}

/// Sums over what has become final; layer by layer, so that no sum depends on when it is taken.
void Smoother::note_ready() {
    report_.turned_faces = rounds_.faults().turned;
    report_.low_quality_faces = rounds_.faults().low_quality;
    report_.crossing_pairs = settling_.crossings();
    report_.islands = settling_.islands();
    for (; noted_ < ready_; ++noted_) {
        double sum = report_.rms_displacement * report_.rms_displacement * static_cast<double>(report_.vertices);
        const NumberRange vertices = window_.vertices_of(noted_), faces = window_.faces_of(noted_);
        for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
            const double moved = length2(place(v) - window_.origin[v]);
            sum += moved;
            report_.largest_displacement = std::max(report_.largest_displacement, std::sqrt(moved));
            report_.stepped_back += stand_.level[v] > 0;
        }
        report_.vertices += vertices.size();
        if (report_.vertices > 0) report_.rms_displacement = std::sqrt(sum / static_cast<double>(report_.vertices));
        for (std::uint32_t f = faces.first; f < faces.end; ++f) {
            const auto& [v, labels] = window_.faces[f];
            add_cone(report_.volume_before, labels, window_.origin[v[0]], window_.origin[v[1]], window_.origin[v[2]]);
            add_cone(report_.volume_after, labels, place(v[0]), place(v[1]), place(v[2]));
        }
    }
}

void Smoother::note_bytes() {
    report_.window_layers = std::max(report_.window_layers, window_.layer_end() - released_);
    const std::uint64_t bytes = window_.bytes() + places_[0].bytes() + places_[1].bytes() + neighbours_.bytes() +
                                nifpms_.bytes() + stand_.level.bytes() + stand_.wanted.bytes() + settling_.bytes();
    report_.window_bytes = std::max(report_.window_bytes, bytes);
}

void Smoother::release_before(std::uint32_t layer) {
    if (layer == released_) return;
    released_ = layer;
    const std::uint32_t first = window_.vertices_of(layer - 1).first, face_end = window_.faces_of(layer - 1).end;
    window_.drop_before(layer);
    for (auto& places : places_) places.drop_before(first);
    if (options_.filter == SmoothFilter::kNifpms) neighbours_.drop_before(first);
    nifpms_.drop_before(first, face_end);
    stand_.level.drop_before(first);
    stand_.wanted.drop_before(first);
    settling_.drop_before(first);
    low_.drop_before(layer);
}

double Smoother::floor() const {
    if (released_ == window_.layer_end()) return is_last_ ? HUGE_VAL : plane_ - most_;
    double low = is_last_ ? HUGE_VAL : plane_ - most_;
    for (std::uint32_t layer = released_; layer < window_.layer_end(); ++layer) low = std::min(low, low_[layer]);
    // Faces to come hang on vertices that are final already.
    const NumberRange faces = window_.faces_of(released_);
    for (std::uint32_t f = faces.first; f < faces.end; ++f)
        for (std::uint32_t v : window_.faces[f].vertices)
            if (v < window_.vertices_of(released_).first) low = std::min(low, place(v)[order_.axis]);
    return low;
}

}  // namespace regionmesh
