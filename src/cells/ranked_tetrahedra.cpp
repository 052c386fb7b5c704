#include "cells/ranked_tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>

#include "base/exact_predicates.h"
#include "base/megabytes.h"
#include "base/triangle.h"
#include "cells/tuning.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

using namespace cells;

constexpr Label kMostLabels = 0x7FFFFFFF;

[[noreturn]] void fail(const TetrahedronReader& reader, const std::string& text) {
    throw Error(ErrorCode::kInput, reader.info().source + ": " + text);
}

Sweep longest(const Box& box) {
    Sweep best = kSweepZ;
    for (const Sweep& sweep : {kSweepY, kSweepX}) {
        const int axis = sweep.axes[2], so_far = best.axes[2];
        if (box.high[axis] - box.low[axis] > box.high[so_far] - box.low[so_far]) best = sweep;
    }
    return best;
}

/// Points in a slab across the sweep, one point spacing thick, if points fill the box evenly.
double points_across(const Box& box, const Sweep& sweep, double points) {
    const Vec3 size = box.high - box.low;
    const double length = size[sweep.axes[2]],
                 apart = std::cbrt(size.x) * std::cbrt(size.y) * std::cbrt(size.z) / std::cbrt(points);
    return length > 0 ? std::min(points * apart / length, points) : points;
}

/// A reader may be one of the user.
void require_points(const TetrahedronReader& reader, const LabelledPoints& given) {
    const double scale_z = reader.info().scale_z;
    if (!(scale_z > 0) || !std::isfinite(scale_z))
        fail(reader, "scale_z is " + std::to_string(scale_z) + "; give a number above 0");
    const bool needs_labels = !reader.info().has_cell_labels || !given.labels.empty();
    if (needs_labels && given.labels.size() != given.positions.size())
        fail(reader, std::to_string(given.labels.size()) + " labels for " + std::to_string(given.positions.size()) +
                         " points; give one for each");
    for (std::size_t n = 0; n < given.positions.size(); ++n)
        if (const Vec3 p = given.positions[n]; std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z))
            fail(reader, reader.name_of_point(static_cast<std::uint32_t>(n)) +
                             " has a coordinate that is not a number; mend the points");
}

void require_memory(const TetrahedronReader& reader, std::uint64_t points, double across, std::uint64_t memory) {
    const auto count = static_cast<double>(points);
    const double meshing = kMeshingBytesPerPoint * count + kActiveBytes * across;
    const auto needed = kLeastBytes + static_cast<std::uint64_t>(std::max(kRankingBytesPerPoint * count, meshing));
    if (needed <= memory) return;
    throw Error(ErrorCode::kInput, memory_limit_text(memory) + ": " + reader.info().source + " needs at least " +
                                       megabytes(needed) + " for its " + std::to_string(points) +
                                       " points; raise --memory to that");
}

/// Order by position along the sweep, then by the other coordinates.
struct SweepOrder {
    Sweep sweep;
    std::weak_ordering operator()(const Vec3& p, const Vec3& q) const {
        const auto [fast, slow, along] = sweep.axes;
        for (int axis : {along, slow, fast})
            if (p[axis] != q[axis]) return p[axis] < q[axis] ? std::weak_ordering::less : std::weak_ordering::greater;
        return std::weak_ordering::equivalent;
    }
};

/// Ranks the points; returns the ranks by the reader's numbers. Positions are sorted in place: a second copy would take
/// half as much memory again.
std::vector<std::uint32_t> rank_points(LabelledPoints given, LabelTable& labels, RankedPoints& ranked) {
    const bool has_labels = !given.labels.empty();
    std::vector<Vec3>& positions = given.positions;
    const SweepOrder order{ranked.sweep};
    std::vector<std::uint32_t>& points = ranked.points;
    points.resize(positions.size());
    std::iota(points.begin(), points.end(), 0u);
    std::sort(points.begin(), points.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto compared = order(positions[a], positions[b]);
        return compared != 0 ? compared < 0 : a < b;
    });
    std::vector<std::uint32_t> rank_of(positions.size());
    std::uint32_t count = 0;
    for (std::uint32_t p : points) {
        const std::uint32_t before = count > 0 ? points[count - 1] : p;
        if (count == 0 || positions[p] != positions[before]) {
            points[count++] = p;
            if (has_labels) ranked.labels.push_back(labels.dense(given.labels[p]));
        } else if (has_labels && given.labels[p] != given.labels[before]) {
            ranked.others.try_emplace(count - 1, RankedPoints::Other{p, given.labels[p]});
        }
        rank_of[p] = count - 1;
    }
    points.resize(count);
    std::sort(positions.begin(), positions.end(), [&](const Vec3& p, const Vec3& q) { return order(p, q) < 0; });
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    ranked.positions = std::move(positions);
    return rank_of;
}

/// Puts corners in the order of ranks.
class Ranker {
public:
    Ranker(const TetrahedronReader& reader, const LabelTable& labels, const std::vector<std::uint32_t>& rank_of,
           RankedTetrahedra& ranked)
        : reader_(reader), labels_(labels), rank_of_(rank_of), ranked_(ranked) {}

    void add(const LabelledTetrahedron& given, Label label) {
        RankedTetrahedron made{{}, label, 0};
        for (int n = 0; n < 4; ++n) {
            if (given.corners[n] >= rank_of_.size()) fail_here("has a corner that is none of the points");
            made.corners[n] = rank_of_[given.corners[n]];
        }
        std::sort(made.corners.begin(), made.corners.end());
        if (!ranked_.points.others.empty()) refuse_two_labels(made.corners);
        if (std::adjacent_find(made.corners.begin(), made.corners.end()) != made.corners.end())
            fail_here("has two corners at one place");
        std::array<Vec3, 4> at;
        for (int n = 0; n < 4; ++n) at[n] = ranked_.points.positions[made.corners[n]];
        const int turn = orientation(at[0], at[1], at[2], at[3]);
        if (turn == 0) fail_here("is flat: its corners lie in one plane");
        made.is_mirrored = turn < 0;
        ranked_.six_volumes += std::abs(dot(area_vector(at[0], at[1], at[2]), at[3] - at[0]));
        for (Vec3 p : at) ranked_.points.box.add(p);
        ranked_.sorted.add(made);
        ++count_;
    }

private:
    /// Points that no tetrahedron has may have any label.
    void refuse_two_labels(const std::array<std::uint32_t, 4>& corners) const {
        const RankedPoints& points = ranked_.points;
        for (std::uint32_t rank : corners) {
            const auto other = points.others.find(rank);
            if (other == points.others.end()) continue;
            const auto& [point, label] = other->second;
            fail(reader_, reader_.name_of_point(points.points[rank]) + " and " + reader_.name_of_point(point) +
                              " lie at one place and have the labels " +
                              labels_.text(labels_.input(points.labels[rank])) + " and " + labels_.text(label) +
                              ": leave one of them out");
        }
    }

    [[noreturn]] void fail_here(const char* text) const {
        fail(reader_, reader_.name_of_tetrahedron(count_) + " " + text + "; mend the mesh");
    }

    const TetrahedronReader& reader_;
    const LabelTable& labels_;
    const std::vector<std::uint32_t>& rank_of_;
    RankedTetrahedra& ranked_;
    std::uint64_t count_ = 0;
};

}  // namespace

double RankedTetrahedra::spacing() const { return std::cbrt(six_volumes / static_cast<double>(sorted.size())); }

RankedTetrahedra rank_tetrahedra(TetrahedronReader& reader, LabelTable& labels, const RankOptions& options) {
    RankedTetrahedra ranked{.points = {}, .sorted = ExternalSort<RankedTetrahedron>(options.sort_bytes)};
    LabelledPoints given = reader.take_points();
    require_points(reader, given);
    Box all;
    for (Vec3& p : given.positions) {
        p += Vec3{0, 0, 0};  // -0 becomes 0
        all.add(p);
    }
    if (!all.is_empty()) require_extent(reader.info().source, all);
    ranked.points.sweep = options.sweep ? *options.sweep : longest(all);
    const std::uint64_t count = given.positions.size();
    require_memory(reader, count, points_across(all, ranked.points.sweep, static_cast<double>(count)), options.memory);
    const std::vector<std::uint32_t> rank_of = rank_points(std::move(given), labels, ranked.points);
    Ranker ranker(reader, labels, rank_of, ranked);
    std::vector<LabelledTetrahedron> piece(kPiece);
    while (const std::size_t got = reader.next(piece)) {
        if (got > piece.size()) fail(reader, "gives more tetrahedra than there is room for; mend the reader");
        for (std::size_t n = 0; n < got; ++n)
            ranker.add(piece[n], reader.info().has_cell_labels ? labels.dense(piece[n].label) : 0);
    }
    if (labels.size() > kMostLabels) fail(reader, "more than 2^31 labels");
    if (ranked.sorted.size() == 0) fail(reader, "has no tetrahedra");
    const Vec3 size = ranked.points.box.high - ranked.points.box.low;
    if (!std::isnormal(ranked.six_volumes) || !std::isfinite(length(size)))
        fail(reader, "its tetrahedra are too thin, too small or too large for numbers; scale the coordinates");
    ranked.sorted.finish();
    return ranked;
}

}  // namespace regionmesh
