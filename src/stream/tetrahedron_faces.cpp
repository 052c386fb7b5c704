#include "stream/tetrahedron_faces.h"

#include <algorithm>
#include <cmath>

#include "base/megabytes.h"
#include "cells/tetrahedron_mesher.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "stream/footprint.h"
#include "stream/place_in_space.h"
#include "stream/star_watch.h"
#include "stream/tuning.h"

namespace regionmesh {
namespace {

using namespace stream;

std::uint64_t sort_bytes(std::uint64_t memory) { return std::min(memory / kSortShare, kMostSortBytes); }

std::uint32_t cells_along(double length, double spacing) {
    return static_cast<std::uint32_t>(std::max(std::ceil(length / spacing - 1e-9), 1.0));
}

/// A lattice round the box, with cells as large as a cube that six tetrahedra fill.
Lattice lattice_round(const Box& box, double spacing, double tetrahedra) {
    const Vec3 size = box.high - box.low;
    const auto cells = [&] {
        double product = 1;
        for (int axis = 0; axis < 3; ++axis) product *= std::max(size[axis] / spacing, 1.0);
        return product;
    };
    while (cells() > kMostCells * tetrahedra || std::max({size.x, size.y, size.z}) > kMostStrips * spacing)
        spacing *= 1.25;
    Lattice lattice{.size = {}, .spacing = {spacing, spacing, spacing}, .origin = box.low};
    for (int axis = 0; axis < 3; ++axis) lattice.size[axis] = cells_along(size[axis], spacing) + 1;
    return lattice;
}

}  // namespace

TetrahedronFaces::TetrahedronFaces(TetrahedronReader& reader, const TetrahedronOptions& options)
    : reader_(reader),
      options_(options),
      labels_(reader.info().is_unsigned),
      background_(dense_background(options.background, labels_)),
      spilled_(sort_bytes(options.memory)) {
    if (options.sweep) require_sweep(reader.info().source, *options.sweep);
    shape_.name = reader.info().source;
    shape_.scale_z = reader.info().scale_z;
}

std::optional<FaceCount> TetrahedronFaces::count(const OnStripsCounted& /*on_strips*/) {
    if (strips_.empty()) make_all();
    FaceCount count{.strip_faces = {}, .face_count = spilled_.face_count(), .oracle = oracle_};
    for (StripRange strip : strips_) count.strip_faces.push_back(spilled_.faces_of(strip));
    return count;
}

void TetrahedronFaces::make_all() {
    RankedTetrahedra tetrahedra = rank_tetrahedra(
        reader_, labels_,
        {.sweep = options_.sweep, .sort_bytes = sort_bytes(options_.memory), .memory = options_.memory});
    point_count_ = tetrahedra.points.size();
    tetrahedron_count_ = tetrahedra.sorted.size();
    samples_.assign(labels_.size(), 0);
    for (Label label : tetrahedra.points.labels) ++samples_[label];
    shape_lattice(tetrahedra);
    mesh(tetrahedra);
    shape_strips_of_faces();
}

void TetrahedronFaces::shape_lattice(const RankedTetrahedra& tetrahedra) {
    const Box& box = tetrahedra.points.box;
    const double spacing = tetrahedra.spacing();
    shape_.sweep = tetrahedra.points.sweep;
    shape_.scale = spacing;
    shape_.lattice = lattice_round(box, spacing, static_cast<double>(tetrahedron_count_));
}

/// One pass over the tetrahedra in the order of the sweep; each strip is spilled when it is made.
void TetrahedronFaces::mesh(RankedTetrahedra& tetrahedra) {
    const RankedPoints& points = tetrahedra.points;
    const StripOptions options{.cap = options_.cap, .background = background_};
    TetrahedronMesher mesher(points, reader_, options);
    StarWatch watch(options);
    const double low = shape_.lattice.origin[shape_.axis()], thickness = shape_.lattice.spacing[shape_.axis()];
    const std::uint32_t thin_strips = shape_.lattice.size[shape_.axis()] - 1;
    std::uint32_t strip = 0;
    std::uint64_t pinned = 0;
    const auto end_strip = [&] {
        require_memory(points.size() * kBytesPerPoint + tetrahedra.sorted.bytes() + mesher.bytes() + spilled_.bytes());
        double top = -HUGE_VAL;
        for (const ChunkVertex& vertex : mesher.strip().vertices) top = std::max(top, vertex.position[shape_.axis()]);
        spilled_.add(mesher.strip(), top);
        if (!reader_.info().hull_is_convex) {
            watch.add(mesher.strip());
            watch.judge(mesher.finalized());
        }
        for (const FinalizedVertex& end : mesher.finalized()) {
            spilled_.add_finalized(end);
            pinned += end.is_pinned;
        }
        mesher.finalized().clear();
        mesher.begin_strip(++strip);
    };
    // Labels of tetrahedra get their dense numbers in the order of ranks, too.
    const bool has_cell_labels = reader_.info().has_cell_labels;
    LabelTable in_order(labels_.is_unsigned());
    dense_background(options_.background, in_order);
    RankedTetrahedron tetrahedron;
    while (tetrahedra.sorted.next(tetrahedron)) {
        if (has_cell_labels) tetrahedron.label = in_order.dense(labels_.input(tetrahedron.label));
        const std::uint32_t lowest = tetrahedron.corners[0];
        mesher.finalize_before(lowest);
        const double along = (points.along(lowest) - low) / thickness;
        const auto own = std::min(static_cast<std::uint32_t>(std::floor(along + 1e-9)), thin_strips - 1);
        while (strip < own) end_strip();
        mesher.add(tetrahedron);
        if (has_cell_labels) ++samples_[tetrahedron.label];
    }
    if (has_cell_labels) labels_ = std::move(in_order);
    mesher.finalize_all();
    while (strip < thin_strips) end_strip();
    spilled_.finish(mesher.hull_is_box());
    if (mesher.hull_is_box()) high_ = points.box.high[shape_.axis()];
    oracle_ = mesher.oracle();
    // Where the hull touches itself, the formula for the boundary of a region does not hold.
    if (!has_cell_labels && pinned > 0) oracle_.euler.clear();
}

void TetrahedronFaces::require_memory(std::uint64_t held) const {
    if (kProcessBytes + held <= options_.memory) return;
    throw Error(ErrorCode::kInput, memory_limit_text(options_.memory) + ": " + shape_.name + " needs more than " +
                                       megabytes(kProcessBytes + held) +
                                       " while its faces are made; raise --memory, or change --sweep");
}

/// Strips are thin strips, or ranges of them where smoothing needs thicker ones.
void TetrahedronFaces::shape_strips_of_faces() {
    if (options_.for_smoothing) {
        strips_ = spilled_.strips_for_smoothing();
    } else {
        for (std::uint32_t strip = 0; strip < spilled_.strip_count(); ++strip) strips_.push_back({strip, strip + 1});
    }
    shape_.strip_count = static_cast<std::uint32_t>(strips_.size());
    std::uint32_t thinnest = spilled_.strip_count();
    double top = -HUGE_VAL;
    std::uint64_t most_faces = 0;
    for (std::uint32_t n = 0; n < strips_.size(); ++n) {
        if (n + 1 < strips_.size()) thinnest = std::min(thinnest, strips_[n].end - strips_[n].first);
        // A face has vertices of its own strip and the one before.
        const double own_top = spilled_.top_of(strips_[n]), face_top = std::max(top, own_top);
        std::uint32_t behind = n + 1;
        while (behind < strips_.size() && low_of(behind) < face_top) ++behind;
        shape_.strip_overlap = std::max(shape_.strip_overlap, behind - n - 1);
        top = own_top;
        most_faces = std::max(most_faces, spilled_.faces_of(strips_[n]));
    }
    shape_.strip_thickness = thinnest * shape_.lattice.spacing[shape_.axis()];
    // A strip twice: as it is read, and smoothed or gathered.
    shape_.reading_bytes = kProcessBytes + most_faces * 2 * kChunkBytesPerFace + spilled_.bytes();
}

double TetrahedronFaces::low_of(std::uint32_t strip) const {
    if (strip == strips_.size()) return high_;
    return shape_.lattice.origin[shape_.axis()] + strips_[strip].first * shape_.lattice.spacing[shape_.axis()];
}

bool TetrahedronFaces::advance() {
    if (strips_read_ == strips_.size()) return false;
    ++strips_read_;
    return true;
}

void TetrahedronFaces::make_faces(Chunk& chunk) { spilled_.read(strips_[strips_read_ - 1], chunk); }

void TetrahedronFaces::place(Mesh& mesh) const { unscale_z(mesh, shape_.scale_z); }

bool TetrahedronFaces::rewind() {
    strips_read_ = 0;
    spilled_.rewind();
    return true;
}

}  // namespace regionmesh
