#include "judge/judge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "base/option_range.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

/// Where faces are added, the tree of faces gets room for this share more.
constexpr std::uint32_t kSpareShare = 4;

/// Samples on the sides of their box keep their regions only while the surface stays in it.
Box limits_of(const Promises& promises) {
    const Box limits = promises.box.value_or(kUnbounded);
    return promises.samples ? common(limits, promises.samples->extent()) : limits;
}

}  // namespace

void require_in_range(const Promises& promises) {
    if (promises.min_quality) require_number("min_quality", *promises.min_quality, kQualityRange);
    require_number("max_error", promises.max_error, kNotNegativeOrInfinite);
    require_number("scale", promises.scale, kPositive);
    require_number("scale_z", promises.scale_z, kPositive);
    for (int axis = 0; promises.box && axis < 3; ++axis)
        if (!(promises.box->low[axis] <= promises.box->high[axis]))
            throw Error(ErrorCode::kUsage, "box: it ends before it begins; give its lower corner as low");
    if (promises.samples) require_along_axes("samples", *promises.samples);
}

double usual_quality_bound(const Vec3& spacing) {
    const auto [least, greatest] = std::minmax({spacing.x, spacing.y, spacing.z});
    return kUsualQuality / (greatest / least);
}

Judge::Judge(Mesh& mesh, const Promises& promises, const JudgeOptions& options)
    : mesh_(mesh),
      promises_(promises),
      bounds_{.min_quality = promises.quality_bound()},
      limits_(common(options.limits, limits_of(promises))),
      log_(options.log),
      threads_(options.threads) {
    if (!promises.intersect_check || !options.sees_others) return;
    tree_.emplace(mesh, options.threads, options.faces);
    if (options.bounds_regions) rising_.emplace(mesh);
    known_faces_ = mesh.face_end();
}

void Judge::apply(Change& change) {
    switch (change.star.kind) {
        case StarKind::kCollapse:
        case StarKind::kHalf:
            return collapse(change);
        case StarKind::kMove:
            return move(change);
        case StarKind::kFlip:
            return flip(change);
        case StarKind::kSplit:
            return split(change);
        case StarKind::kVertex:
            break;
    }
    assert(false && "a star without a target is no change");
}

/// The faces of the star have their places now: updates their boxes and directions.
void Judge::note_star(const EdgeStar& star, Vec3 position) {
    if (tree_) {
        for (int n = 0; n < star.face_count(); n += 2) {
            const StarPair& pair = star.pairs[n / 2];
            const auto boxes = tree_->boxes_of(both(position), pair.a, pair.b);
            tree_->set(star.faces[n].face, boxes[0]);
            if (n + 1 < star.face_count()) tree_->set(star.faces[n + 1].face, boxes[1]);
        }
    }
    if (rising_ && !star.is_flat) rising_->set(star, position);
}

/// `stays` moves to the position of the merged vertex.
void Judge::collapse(const Change& change) {
    const EdgeStar& star = change.star;
    if (log_)
        log_->collapses.push_back({.position = change.position,
                                   .goes = index(star.goes),
                                   .stays = index(star.stays),
                                   .goes_bound = mesh_[star.goes].error_bound(),
                                   .stays_bound = mesh_[star.stays].error_bound(),
                                   .level = log_->level,
                                   .faces = static_cast<std::uint32_t>(star.dead.size())});
    change.error.apply(mesh_, star.stays);
    for (const FaceId f : star.dead) remove(f);
    mesh_.move_star(star.goes, star.stays);
    mesh_[star.stays].position = change.position;
    note_star(star, change.position);
}

void Judge::move(const Change& change) {
    change.error.apply(mesh_, change.star.goes);
    mesh_[change.star.goes].position = change.position;
    note_star(change.star, change.position);
}

void Judge::flip(Change& change) {
    Flip& flip = change.flip;
    const auto labels = mesh_[flip.f].labels;
    for (const FaceId f : change.gone) remove(f);
    flip.f = mesh_.add_face(flip.c, flip.u, flip.d, labels[0], labels[1]);
    flip.g = mesh_.add_face(flip.c, flip.d, flip.v, labels[0], labels[1]);
    change.star.faces[0].face = flip.f;
    change.star.faces[1].face = flip.g;
    note_star(change.star, change.position);
    change.flip_error.apply(mesh_, flip);
}

void Judge::remove(FaceId f) {
    mesh_.remove_face(f);
    if (tree_) tree_->remove(f);
}

void Judge::propose_split(VertexId u, VertexId v, Change& change) {
    const auto sides = static_cast<SideSet>(mesh_[u].sides & mesh_[v].sides);
    const Vec3 middle = 0.5 * (mesh_.position(u) + mesh_.position(v));
    const VertexId m = mesh_.add_vertex(middle, sides);
    mesh_[m].label_count = static_cast<std::uint8_t>(edge_labels(mesh_, u, v).size());
    mesh_[m].set_error_bound(std::max(mesh_[u].error_bound(), mesh_[v].error_bound()));
    gather_split(mesh_, u, v, m, change.star, change.gone);
}

void Judge::withdraw(const Change& split) { mesh_.remove_vertex(split.star.goes); }

void Judge::split(Change& change) {
    std::vector<std::array<Label, 2>> labels;
    for (const StarFace& face : change.star.faces) labels.push_back(mesh_[face.face].labels);
    for (const FaceId f : change.gone) remove(f);
    std::vector<StarFace>& faces = change.star.faces;
    for (std::size_t n = 0; n < faces.size(); ++n)
        faces[n].face = mesh_.add_face(change.star.goes, faces[n].a, faces[n].b, labels[n][0], labels[n][1]);
    change.error.apply(mesh_, change.star.goes);
    mesh_[change.star.goes].position = change.position;
    make_room();
    note_star(change.star, change.position);
}

/// Where splits need more places than collapses have left free.
void Judge::make_room() {
    if (mesh_.face_end() <= known_faces_) return;
    const std::uint32_t spare = rising_ ? 0 : mesh_.face_end() / kSpareShare;
    if (tree_) tree_->build(threads_, spare);
    if (rising_) rising_->build(mesh_);
    known_faces_ = mesh_.face_end() + spare;
}

void Judge::pack(std::uint32_t threads) {
    mesh_.compact_faces();
    if (tree_) tree_->build(threads);
    if (rising_) rising_->build(mesh_);
    known_faces_ = mesh_.face_end();
}

}  // namespace regionmesh
