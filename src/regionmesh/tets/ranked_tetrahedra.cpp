#include "regionmesh/tets/ranked_tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "regionmesh/base/error.h"
#include "regionmesh/base/exact_predicates.h"
#include "regionmesh/base/triangle.h"

namespace regionmesh {
namespace {

constexpr std::size_t kPiece = 1 << 14;  // tetrahedra asked for at a time
constexpr Label kMostLabels = 0x7FFFFFFF;

/// That a point takes while it is ranked: its place twice, labels, and numbers.
constexpr std::uint64_t kRankingBytesPerPoint = 80;

[[noreturn]] void fail(const TetrahedronReader& reader, const std::string& text) {
    throw Error(ErrorCode::kInput, reader.info().source + ": " + text);
}

void require_memory(const TetrahedronReader& reader, std::uint64_t points, std::uint64_t memory) {
    const std::uint64_t needed = points * kRankingBytesPerPoint;
    if (needed <= memory) return;
    const auto megabytes = [](std::uint64_t bytes) { return std::to_string((bytes + 999'999) / 1'000'000) + " MB"; };
    throw Error(ErrorCode::kInput, "--memory " + megabytes(memory) + ": " + reader.info().source + " needs at least " +
                                       megabytes(needed) + " for its " + std::to_string(points) +
                                       " points; give so much");
}

Sweep longest(const Box& box) {
    Sweep best = kSweepZ;
    for (const Sweep& sweep : {kSweepY, kSweepX}) {
        const int axis = sweep.axes[2], so_far = best.axes[2];
        if (box.high[axis] - box.low[axis] > box.high[so_far] - box.low[so_far]) best = sweep;
    }
    return best;
}

/// The reader's numbers of points in the order of ranks.
std::vector<std::uint32_t> order_of(const std::vector<Vec3>& positions, const Sweep& sweep) {
    const auto [fast, slow, along] = sweep.axes;
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&, fast = fast, slow = slow, along = along](std::uint32_t a, std::uint32_t b) {
                  const Vec3 &p = positions[a], &q = positions[b];
                  if (p[along] != q[along]) return p[along] < q[along];
                  if (p[slow] != q[slow]) return p[slow] < q[slow];
                  return p[fast] != q[fast] ? p[fast] < q[fast] : a < b;
              });
    return order;
}

/// Gives points their ranks; returns those by the reader's numbers.
std::vector<std::uint32_t> rank_points(const TetrahedronReader& reader, LabelledPoints given, LabelTable& labels,
                                       RankedPoints& ranked) {
    const bool has_labels = !given.labels.empty();
    std::vector<std::uint32_t> rank_of(given.positions.size());
    ranked.positions.reserve(given.positions.size());
    for (std::uint32_t p : order_of(given.positions, ranked.sweep)) {
        if (ranked.size() > 0 && given.positions[p] == ranked.positions.back()) {
            const std::uint32_t before = ranked.points.back();
            if (has_labels && given.labels[p] != given.labels[before])
                fail(reader, reader.name_of_point(before) + " and " + reader.name_of_point(p) +
                                 " lie at one place and have the labels " + labels.text(given.labels[before]) +
                                 " and " + labels.text(given.labels[p]) + ": leave one of them out");
        } else {
            ranked.positions.push_back(given.positions[p]);
            ranked.points.push_back(p);
            if (has_labels) ranked.labels.push_back(labels.dense(given.labels[p]));
        }
        rank_of[p] = ranked.size() - 1;
    }
    return rank_of;
}

/// Puts corners in the order of ranks.
class Ranker {
public:
    Ranker(const TetrahedronReader& reader, const std::vector<std::uint32_t>& rank_of, RankedTetrahedra& ranked)
        : reader_(reader), rank_of_(rank_of), ranked_(ranked) {}

    void add(const LabelledTetrahedron& given, Label label) {
        RankedTetrahedron made{{}, label, 0};
        for (int n = 0; n < 4; ++n) {
            if (given.corners[n] >= rank_of_.size()) fail_here("has a corner that is none of the points");
            made.corners[n] = rank_of_[given.corners[n]];
        }
        std::sort(made.corners.begin(), made.corners.end());
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
    [[noreturn]] void fail_here(const char* text) const {
        fail(reader_, reader_.name_of_tetrahedron(count_) + " " + text + "; mend the mesh");
    }

    const TetrahedronReader& reader_;
    const std::vector<std::uint32_t>& rank_of_;
    RankedTetrahedra& ranked_;
    std::uint64_t count_ = 0;
};

}  // namespace

double RankedTetrahedra::spacing() const { return std::cbrt(six_volumes / static_cast<double>(sorted.size())); }

RankedTetrahedra rank_tetrahedra(TetrahedronReader& reader, LabelTable& labels, const RankOptions& options) {
    RankedTetrahedra ranked{.points = {}, .sorted = ExternalSort<RankedTetrahedron>(options.sort_bytes)};
    LabelledPoints given = reader.take_points();
    require_memory(reader, given.positions.size(), options.memory);
    Box all;
    for (Vec3& p : given.positions) {
        p += Vec3{0, 0, 0};  // -0 becomes 0
        all.add(p);
    }
    ranked.points.sweep = options.sweep ? *options.sweep : longest(all);
    const std::vector<std::uint32_t> rank_of = rank_points(reader, std::move(given), labels, ranked.points);
    Ranker ranker(reader, rank_of, ranked);
    std::vector<LabelledTetrahedron> piece(kPiece);
    while (const std::size_t count = reader.next(piece))
        for (std::size_t n = 0; n < count; ++n)
            ranker.add(piece[n], reader.info().has_cell_labels ? labels.dense(piece[n].label) : 0);
    if (labels.size() > kMostLabels) fail(reader, "more than 2^31 labels");
    if (ranked.sorted.size() == 0) fail(reader, "has no tetrahedra");
    ranked.sorted.finish();
    return ranked;
}

}  // namespace regionmesh
