#include "regionmesh/improve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/option_range.h"
#include "base/triangle.h"
#include "improve/edge_flips.h"
#include "improve/short_edges.h"
#include "improve/vertex_moves.h"
#include "judge/error_bound.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"

namespace regionmesh {
namespace {

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi; }

FaceShapes shapes_of(const Mesh& mesh, double min_quality, double scale_z) {
    if (mesh.face_count() == 0) return {};
    FaceShapes shapes{.min_quality = 1, .min_angle = 180};
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        auto p = mesh.corners(FaceId{f});
        for (Vec3& corner : p) corner.z /= scale_z;
        const double quality = face_quality(p[0], p[1], p[2]);
        shapes.min_quality = std::min(shapes.min_quality, quality);
        shapes.mean_quality += quality;
        shapes.faces_below += quality < min_quality;
        for (int n = 0; n < 3; ++n) {
            const double angle = angle_between(p[(n + 1) % 3] - p[n], p[(n + 2) % 3] - p[n]);
            shapes.min_angle = std::min(shapes.min_angle, angle);
            shapes.max_angle = std::max(shapes.max_angle, angle);
        }
    }
    shapes.mean_quality /= mesh.face_count();
    return shapes;
}

class ImproveLoop {
public:
    ImproveLoop(Mesh& mesh, const ImproveOptions& options)
        : mesh_(mesh),
          options_(options),
          kept_(kept_of(mesh, options)),
          judge_(mesh, kept_),
          poor_(options.promises.quality_bound()),
          drift_(mesh.vertex_end(), options.tolerance * kept_.scale),
          flips_(judge_, drift_, poor_),
          moves_(judge_, drift_, poor_),
          short_edges_(judge_, drift_),
          changed_(mesh.vertex_end(), 0) {}

    void run(ImproveResult& result) {
        while (result.sweeps < options_.sweeps) {
            now_ = ++result.sweeps;
            const std::uint64_t flips = sweep_flips(), moves = sweep_moves(), collapses = sweep_short_edges();
            result.flips += flips;
            result.moves += moves;
            result.collapses += collapses;
            if (flips + moves + collapses == 0) break;
        }
    }

private:
    /// The promises, but for quality: FanShape demands more. No faces may cross, whatever the options say: few changes
    /// are made here, so that the test costs little. Moves add to the error within the tolerance alone.
    static Promises kept_of(const Mesh& mesh, const ImproveOptions& options) {
        Promises kept = options.promises;
        kept.min_quality = 0;
        kept.intersect_check = true;
        kept.max_error = std::min(
            kept.max_error, largest_error_bound(mesh) + SurfaceDrift::kPoorShare * options.tolerance * kept.scale);
        return kept;
    }

    /// Has something near the vertex changed in this sweep or the one before?
    bool is_fresh(VertexId v) const { return changed_[index(v)] + 1 >= now_; }
    void note(VertexId v) { changed_[index(v)] = now_; }
    void report_progress(std::uint32_t n) {
        if (options_.on_progress && (n & 0x3FFF) == 0) options_.on_progress();
    }

    std::uint64_t sweep_flips() {
        std::uint64_t count = 0;
        for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
            report_progress(f);
            for (int place = 0; place < 3 && mesh_.is_alive(FaceId{f}); ++place) {
                if (!is_fresh(FaceId{f})) break;
                const auto flip = flips_.try_flip(FaceId{f}, place);
                if (!flip) continue;
                for (VertexId w : {flip->u, flip->v, flip->c, flip->d}) note(w);
                ++count;
            }
        }
        return count;
    }

    bool is_fresh(FaceId f) const {
        const auto& v = mesh_[f].vertices;
        return is_fresh(v[0]) || is_fresh(v[1]) || is_fresh(v[2]);
    }

    std::uint64_t sweep_short_edges() {
        std::uint64_t count = 0;
        for (std::uint32_t n = 0; n < mesh_.face_end(); ++n) {
            const FaceId f{n};
            if (!mesh_.is_alive(f) || !is_fresh(f)) continue;
            const auto p = mesh_.corners(f);
            if (face_quality(p[0], p[1], p[2]) >= poor_ || !short_edges_.try_collapse(f)) continue;
            for (VertexId w : short_edges_.changed()) note(w);
            ++count;
        }
        return count;
    }

    std::uint64_t sweep_moves() {
        std::uint64_t count = 0;
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            report_progress(v);
            if (!is_fresh(VertexId{v}) || !moves_.try_move(VertexId{v})) continue;
            note(VertexId{v});
            for (VertexId w : moves_.link()) note(w);
            ++count;
        }
        return count;
    }

    const Mesh& mesh_;
    const ImproveOptions& options_;
    Promises kept_;
    Judge judge_;
    double poor_;  // quality below which faces are poor
    SurfaceDrift drift_;
    EdgeFlips flips_;
    VertexMoves moves_;
    ShortEdges short_edges_;
    std::vector<std::uint32_t> changed_;  // by vertex: the last sweep that changed its star
    std::uint32_t now_ = 0;
};

void require_options(const ImproveOptions& options) {
    require_in_range(options.promises);
    require_number("tolerance", options.tolerance, kNotNegative);
}

}  // namespace

ImproveResult improve(Mesh& mesh, const ImproveOptions& options) {
    require_options(options);
    require_along_axes(mesh);
    const double bound = options.promises.quality_bound(), scale_z = options.promises.scale_z;
    ImproveResult result;
    result.before = shapes_of(mesh, bound, scale_z);
    mesh.sort_spatially();
    count_labels(mesh);
    ImproveLoop(mesh, options).run(result);
    if (result.collapses > 0) mesh.compact();
    result.after = shapes_of(mesh, bound, scale_z);
    result.error_bound = largest_error_bound(mesh);
    return result;
}

}  // namespace regionmesh
