#include "regionmesh/improve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/option_range.h"
#include "base/triangle.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"
#include "improve/edge_flips.h"
#include "judge/error_bound.h"
#include "improve/short_edges.h"
#include "improve/vertex_moves.h"

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
          tree_(mesh),
          drift_(mesh.vertex_end(), options.tolerance * options.scale),
          flips_(mesh, tree_, drift_, options),
          moves_(mesh, tree_, drift_, options),
          short_edges_(mesh, tree_, drift_, options),
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
            if (face_quality(p[0], p[1], p[2]) >= options_.min_quality || !short_edges_.try_collapse(f)) continue;
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

    Mesh& mesh_;
    const ImproveOptions& options_;
    FaceTree tree_;
    SurfaceDrift drift_;
    EdgeFlips flips_;
    VertexMoves moves_;
    ShortEdges short_edges_;
    std::vector<std::uint32_t> changed_;  // by vertex: the last sweep that changed its star
    std::uint32_t now_ = 0;
};

void require_in_range(const ImproveOptions& options) {
    require_number("min_quality", options.min_quality, kQualityRange);
    require_number("scale", options.scale, kPositive);
    require_number("tolerance", options.tolerance, kNotNegative);
    require_number("max_error", options.max_error, kNotNegativeOrInfinite);
    require_number("scale_z", options.scale_z, kPositive);
    if (options.samples) require_along_axes("samples", *options.samples);
}

}  // namespace

ImproveOptions improve_options(const SimplifyOptions& simplified) {
    return {.min_quality = simplified.min_quality,
            .scale = simplified.scale,
            .max_error = simplified.max_error,
            .samples = simplified.samples};
}

ImproveResult improve(Mesh& mesh, const ImproveOptions& given) {
    require_in_range(given);
    require_along_axes(mesh);
    ImproveOptions options = given;
    options.max_error =
        std::min(given.max_error, largest_error_bound(mesh) + SurfaceDrift::kPoorShare * given.tolerance * given.scale);
    ImproveResult result;
    result.before = shapes_of(mesh, options.min_quality, options.scale_z);
    mesh.sort_spatially();
    count_labels(mesh);
    ImproveLoop(mesh, options).run(result);
    if (result.collapses > 0) mesh.compact();
    result.after = shapes_of(mesh, options.min_quality, options.scale_z);
    result.error_bound = largest_error_bound(mesh);
    return result;
}

}  // namespace regionmesh
