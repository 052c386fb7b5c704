#include "regionmesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/option_range.h"
#include "improve/length_steps.h"
#include "judge/error_bound.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

constexpr OptionRange kEdgeLengths{kLeastLength, kMostLength, "1e-100 to 1e+100"};

/// The mesh is sorted again where splits have added this share of its faces: new ones are far in memory from those
/// round them.
constexpr std::uint32_t kSortShare = 4;

/// Most rounds of splits in a sweep. Each halves the longest edges.
constexpr int kMostSplitRounds = 40;

/// Sweeps end where they make fewer steps than this share of the faces.
constexpr double kFewSteps = 1e-3;

EdgeLengths lengths_of(const Mesh& mesh, const RemeshOptions& options) {
    EdgeLengths lengths;
    if (mesh.face_count() == 0) return lengths;
    lengths.least = HUGE_VAL;
    double sum = 0;
    std::vector<VertexId> ends;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        ends.clear();
        mesh.for_star(VertexId{v}, [&](FaceId f, int) {
            for (const VertexId w : mesh[f].vertices)
                if (index(w) > v) ends.push_back(w);
        });
        std::ranges::sort(ends);
        ends.erase(std::ranges::unique(ends).begin(), ends.end());
        for (const VertexId w : ends) {
            Vec3 step = mesh.position(w) - mesh.position(VertexId{v});
            step.z /= options.promises.scale_z;
            const double size = length(step);
            ++lengths.edges;
            lengths.wanted +=
                size >= kLeastOfLength * options.edge_length && size <= kMostOfLength * options.edge_length;
            lengths.least = std::min(lengths.least, size);
            lengths.largest = std::max(lengths.largest, size);
            sum += size;
        }
    }
    lengths.mean = sum / static_cast<double>(lengths.edges);
    return lengths;
}

class RemeshLoop {
public:
    RemeshLoop(Mesh& mesh, const RemeshOptions& options)
        : mesh_(mesh), options_(options), kept_(kept_of(mesh, options)) {}

    void run(RemeshResult& result) {
        begin();
        for (now_ = 2; result.sweeps < options_.sweeps; ++now_) {
            ++result.sweeps;
            const std::uint64_t splits = sweep_splits(), collapses = sweep_collapses(), flips = sweep_flips(),
                                moves = sweep_moves();
            result.splits += splits;
            result.collapses += collapses;
            result.flips += flips;
            result.moves += moves;
            if (static_cast<double>(splits + collapses + flips + moves) <= kFewSteps * mesh_.face_count()) break;
        }
        steps_.reset();
        judge_.reset();
    }

private:
    /// The promises; no faces may cross, whatever the options say. Samples keep the surface in its place; without them
    /// the error bound does, which adds up what single steps may have done and so is far above the distance.
    static Promises kept_of(const Mesh& mesh, const RemeshOptions& options) {
        Promises kept = options.promises;
        kept.intersect_check = true;
        if (kept.max_error == HUGE_VAL && !kept.samples)
            kept.max_error = largest_error_bound(mesh) + kRemeshError * options.edge_length;
        return kept;
    }

    /// Vertices and faces in a spatial order, all due.
    void begin() {
        steps_.reset();
        judge_.reset();
        mesh_.sort_spatially();
        count_labels(mesh_);
        judge_.emplace(mesh_, kept_);
        steps_.emplace(*judge_, options_.edge_length);
        changed_.assign(mesh_.vertex_end(), now_);
        sorted_faces_ = mesh_.face_end();
    }

    void note() {
        changed_.resize(mesh_.vertex_end(), now_);
        for (const VertexId v : steps_->changed()) changed_[index(v)] = now_;
    }
    /// Has something round it changed in this sweep or the one before?
    bool is_due(VertexId v) const { return changed_[index(v)] + 1 >= now_; }
    bool is_due(FaceId f) const {
        return mesh_.is_alive(f) && std::ranges::any_of(mesh_[f].vertices, [&](VertexId v) { return is_due(v); });
    }
    void report_progress(std::uint32_t n) {
        if (options_.on_progress && (n & 0x3FFF) == 0) options_.on_progress();
    }

    /// In rounds over all faces, as each split makes faces that may be split again.
    std::uint64_t sweep_splits() {
        std::uint64_t count = 0;
        for (int round = 0; round < kMostSplitRounds; ++round) {
            const std::uint64_t before = count;
            const std::uint32_t end = mesh_.face_end();
            for (std::uint32_t f = 0; f < end; ++f) {
                report_progress(f);
                if (!is_due(FaceId{f}) || !steps_->try_split(FaceId{f})) continue;
                note();
                ++count;
            }
            if (mesh_.face_end() - sorted_faces_ > sorted_faces_ / kSortShare) begin();
            if (count == before) break;
        }
        return count;
    }

    std::uint64_t sweep_collapses() {
        std::uint64_t count = 0;
        for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
            report_progress(f);
            if (!is_due(FaceId{f}) || !steps_->try_collapse(FaceId{f})) continue;
            note();
            ++count;
        }
        return count;
    }

    std::uint64_t sweep_flips() {
        std::uint64_t count = 0;
        for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
            report_progress(f);
            for (int place = 0; place < 3 && is_due(FaceId{f}); ++place) {
                if (!steps_->try_flip(FaceId{f}, place)) continue;
                note();
                ++count;
            }
        }
        return count;
    }

    std::uint64_t sweep_moves() {
        std::uint64_t count = 0;
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            report_progress(v);
            if (!is_due(VertexId{v}) || !steps_->try_move(VertexId{v})) continue;
            note();
            ++count;
        }
        return count;
    }

    Mesh& mesh_;
    const RemeshOptions& options_;
    Promises kept_;
    std::optional<Judge> judge_;
    std::optional<LengthSteps> steps_;
    std::vector<std::uint32_t> changed_;  // by vertex: the last sweep that changed its star
    std::uint32_t now_ = 1;
    std::uint32_t sorted_faces_ = 0;  // when they were sorted last
};

}  // namespace

RemeshResult remesh(Mesh& mesh, const RemeshOptions& options) {
    require_in_range(options.promises);
    require_number("edge_length", options.edge_length, kEdgeLengths);
    require_along_axes(mesh);
    RemeshResult result;
    result.before = lengths_of(mesh, options);
    RemeshLoop(mesh, options).run(result);
    mesh.compact();
    result.after = lengths_of(mesh, options);
    result.error_bound = largest_error_bound(mesh);
    return result;
}

}  // namespace regionmesh
