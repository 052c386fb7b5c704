#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/box.h"
#include "base/option_range.h"
#include "base/triangle.h"
#include "mesh/alive.h"
#include "mesh/region_volumes.h"
#include "regionmesh/mesh.h"
#include "regionmesh/smooth.h"
#include "smooth/chunk_smoother.h"
#include "smooth/filters/guarded_move.h"
#include "smooth/filters/relax.h"
#include "smooth/preserve_within.h"
#include "smooth/region_matrix.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using namespace smoothing;

constexpr std::uint8_t kForEver = 255;  // rounds of rest of a vertex that may never move
constexpr int kMostLabels = 4;
constexpr double kRounding = 1e-10;  // relative rounding error of sums of volumes

/// Gradients of the volumes of the regions at a vertex.
struct Gradient {
    std::array<Label, kMostLabels> labels;
    std::array<Vec3, kMostLabels> of;
    int size = 0;
    double area = 0;  // a third of the area of the star
};

/// Positions of vertices, and how far the volumes of regions are off there.
struct State {
    std::vector<Vec3> positions;
    std::vector<double> drifts;  // |volume / wanted - 1| by region; 0 where nothing is wanted

    std::uint64_t regions_off() const {
        return static_cast<std::uint64_t>(
            std::count_if(drifts.begin(), drifts.end(), [](double drift) { return drift > kVolumeTolerance; }));
    }
    double worst() const { return drifts.empty() ? 0 : *std::max_element(drifts.begin(), drifts.end()); }
    bool is_better_than(const State& other) const {
        return std::pair(regions_off(), worst()) < std::pair(other.regions_off(), other.worst());
    }
};

State state_of(const Mesh& mesh, const WantedVolumes& wanted) {
    State state{std::vector<Vec3>(mesh.vertex_end()), std::vector<double>(wanted.size())};
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) state.positions[v] = mesh.position(VertexId{v});
    const std::vector<double> volumes = region_volumes(mesh);
    for (Label label = 0; label < wanted.size(); ++label)
        if (wanted[label] && *wanted[label] != 0)
            state.drifts[label] = std::abs((label < volumes.size() ? volumes[label] : 0) / *wanted[label] - 1);
    return state;
}

void put_back(Mesh& mesh, const std::vector<Vec3>& positions) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) mesh[VertexId{v}].position = positions[v];
}

/// Calls visit(v) for the vertices round the regions that are marked, more than once for most.
template <class Visit>
void for_boundaries(const Mesh& mesh, const std::vector<bool>& marked, Visit&& visit) {
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        for (Label label : mesh[FaceId{f}].labels)
            if (label < marked.size() && marked[label])
                for (VertexId v : mesh[FaceId{f}].vertices) visit(v);
    }
}

/// Of the box of the options, and of the sides that vertices lie on: how far these vertices reach, since the sides of
/// an open model need not lie along the axes.
Box limits_of(const Mesh& mesh, const std::optional<Box>& box) {
    Box limits;
    SideSet sides = 0;
    for_vertices(mesh, [&](VertexId v) {
        sides |= mesh[v].sides;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(mesh[v].sides >> (2 * axis) & 3)) continue;
            const double place = mesh.position(v)[axis];
            limits.low[axis] = std::min(limits.low[axis], place);
            limits.high[axis] = std::max(limits.high[axis], place);
        }
    });
    for (int axis = 0; axis < 3; ++axis) {
        if (!(sides >> (2 * axis) & 1)) limits.low[axis] = -HUGE_VAL;
        if (!(sides >> (2 * axis + 1) & 1)) limits.high[axis] = HUGE_VAL;
    }
    return box ? common(limits, *box) : limits;
}

/// The largest error bound that a vertex can store which is not above `max_error`.
double storable_bound(double max_error) {
    Vertex vertex{};
    double bound = max_error;
    for (vertex.set_error_bound(bound); vertex.error_bound() > max_error; vertex.set_error_bound(bound))
        bound -= 0x1p-9 * max_error;
    return vertex.error_bound();
}

/// How far each vertex may get from where it was.
struct Reach {
    const std::vector<Vec3>& from;
    double most_bound = HUGE_VAL;

    Vec3 nearest(const Mesh& mesh, VertexId v, Vec3 to) const {
        if (most_bound == HUGE_VAL) return to;
        const Vec3 start = from[index(v)], way = to - start;
        const double far = length(way), room = std::max(most_bound - mesh[v].error_bound(), 0.0);
        constexpr double kRounded = 1 - 1e-6;
        return far <= room * kRounded ? to : start + (room * kRounded / far) * way;
    }
};

/// Rounds that bring the volumes nearer to those wanted.
class VolumeRounds {
public:
    /// The regions in `left` stay as they are.
    VolumeRounds(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options, const std::vector<bool>& left,
                 const Reach& reach)
        : mesh_(mesh), wanted_(wanted), options_(options), left_(left), reach_(reach), rest_(mesh.vertex_end()) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            if (!mesh.is_alive(VertexId{v}) || mesh[VertexId{v}].is_fixed) rest_[v] = kForEver;
        for_boundaries(mesh, left, [&](VertexId v) { rest_[index(v)] = kForEver; });
        note_missing();
    }

    bool is_done() const {
        for (Label label = 0; label < wanted_.size(); ++label)
            if (is_wanted(label) && std::abs(missing_[label]) > kEnoughDrift * std::abs(*wanted_[label])) return false;
        return true;
    }

    /// Returns the number of vertices that the guard stopped.
    std::uint64_t run_round() {
        is_first_ = false;
        const std::vector<double> multipliers = solve();
        std::vector<Vec3> to(mesh_.vertex_end());
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) to[v] = target(VertexId{v}, multipliers);
        const std::uint64_t held = hold(move_guarded(mesh_, to, options_));
        note_missing();
        return held;
    }

    double largest_displacement() const { return largest_displacement_; }

private:
    /// Has a wanted volume, and is not given up.
    bool is_wanted(Label label) const {
        return label < wanted_.size() && wanted_[label] && !left_[label] && stalled_[label] < kPatience;
    }

    /// Notes the volume that each region is missing, and the volume that it asks for in the next round.
    void note_missing() {
        const std::vector<double> volumes = region_volumes(mesh_);
        const std::vector<double> most = most_asked();
        for (Label label = 0; label < wanted_.size(); ++label) {
            if (!wanted_[label] || *wanted_[label] == 0) continue;
            const double missing = *wanted_[label] - (label < volumes.size() ? volumes[label] : 0);
            const double drift = std::abs(missing / *wanted_[label]);
            if (!is_first_ && drift > kVolumeTolerance) {
                const double gained = std::abs(missing_[label]) - std::abs(missing);
                stalled_[label] = gained < kLeastGain * std::abs(asked_[label]) ? stalled_[label] + 1 : 0;
            }
            missing_[label] = missing;
            asked_[label] = is_wanted(label) ? std::clamp(missing, -most[label], most[label]) : 0;
        }
        balance();
    }

    /// Where no region is free the missing volumes sum to zero up to rounding, and so must the volumes asked for: all
    /// regions take a share of the difference, by their volumes.
    void balance() {
        double missing = 0, asked = 0, all = 0;
        for (Label label = 0; label < wanted_.size(); ++label) {
            if (!is_wanted(label)) continue;
            missing += missing_[label];
            asked += asked_[label];
            all += *wanted_[label];
        }
        if (!(std::abs(missing) < kRounding * all)) return;
        for (Label label = 0; label < wanted_.size(); ++label)
            if (is_wanted(label)) asked_[label] -= asked * *wanted_[label] / all;
    }

    /// By region: the area of its boundary times the most mean displacement.
    std::vector<double> most_asked() const {
        std::vector<double> most(wanted_.size());
        for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
            if (!mesh_.is_alive(FaceId{f})) continue;
            const auto [a, b, c] = mesh_.corners(FaceId{f});
            const double reach = 0.5 * length(area_vector(a, b, c)) * kMostAsked * edge_;
            for (Label label : mesh_[FaceId{f}].labels)
                if (label < most.size()) most[label] += reach;
        }
        return most;
    }

    /// Vertices that backtracked rest for some rounds. Returns their number.
    std::uint64_t hold(const std::vector<std::uint8_t>& levels) {
        std::uint64_t held = 0;
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            if (rest_[v] == kForEver) continue;
            if (rest_[v] > 0) --rest_[v];
            if (levels[v] == 0) continue;
            rest_[v] = kRestRounds;
            ++held;
        }
        return held;
    }

    /// Decimation has moved the vertices of a hull that is not a box; so they may move back.
    SideSet kept_sides(VertexId v) const { return mesh_[v].sides & static_cast<SideSet>(~kOnHull); }

    Gradient gradient(VertexId v) const {
        Gradient gradient;
        const SideSet sides = kept_sides(v);
        mesh_.for_star(v, [&](FaceId f, int) {
            const auto [a, b, c] = mesh_.corners(f);
            const Vec3 normal = area_vector(a, b, c);
            gradient.area += length(normal) / 6;
            for (int side = 0; side < 2; ++side) {
                const Label label = mesh_[f].labels[side];
                if (!is_wanted(label)) continue;
                int n = 0;
                while (n < gradient.size && gradient.labels[n] != label) ++n;
                if (n == kMostLabels) continue;
                if (n == gradient.size) {
                    gradient.labels[gradient.size] = label;
                    gradient.of[gradient.size++] = {};
                }
                gradient.of[n] += (side == 0 ? 1 : -1) / 6.0 * normal;
            }
        });
        for (int n = 0; n < gradient.size; ++n) keep_on_sides(sides, {}, gradient.of[n]);
        return gradient;
    }

    std::vector<double> solve() const {
        RegionMatrix matrix(static_cast<std::uint32_t>(wanted_.size()));
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            if (rest_[v] > 0) continue;
            const Gradient g = gradient(VertexId{v});
            if (!(g.area > 0)) continue;
            for (int m = 0; m < g.size; ++m)
                for (int n = m; n < g.size; ++n) matrix.add(g.labels[m], g.labels[n], dot(g.of[m], g.of[n]) / g.area);
        }
        return matrix.solve(asked_);
    }

    Vec3 target(VertexId v, const std::vector<double>& multipliers) {
        const Vec3 from = mesh_.position(v);
        if (rest_[index(v)] > 0) return from;
        const Gradient g = gradient(v);
        Vec3 step;
        for (int n = 0; n < g.size; ++n) step += multipliers[g.labels[n]] / g.area * g.of[n];
        const double size = length(step), longest = kLongestStep * edge_;
        if (size > longest) step = longest / size * step;
        largest_displacement_ = std::max(largest_displacement_, std::min(size, longest));
        Vec3 to = from + step;
        // A vertex that came in beyond the limits need not go back.
        for (int axis = 0; axis < 3; ++axis)
            to[axis] =
                std::clamp(to[axis], std::min(limits_.low[axis], from[axis]), std::max(limits_.high[axis], from[axis]));
        keep_on_sides(kept_sides(v), from, to);
        return reach_.nearest(mesh_, v, to);
    }

    Mesh& mesh_;
    const WantedVolumes& wanted_;
    const SmoothOptions& options_;
    const std::vector<bool>& left_;
    const Reach& reach_;
    Box limits_ = limits_of(mesh_, options_.box);
    bool is_first_ = true;
    std::vector<std::uint8_t> rest_;  // rounds to sit out
    double edge_ = typical_edge(mesh_);
    std::vector<double> missing_ = std::vector<double>(wanted_.size());
    std::vector<double> asked_ = std::vector<double>(wanted_.size());
    std::vector<int> stalled_ = std::vector<int>(wanted_.size());  // rounds without progress
    double largest_displacement_ = 0;
};

/// The faces of a vertex that moved follow it, and no point of them moves farther than their corners, in between.
void raise_error_bounds(Mesh& mesh, const std::vector<Vec3>& before) {
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        Vertex& vertex = mesh[VertexId{n}];
        if (vertex.is_alive && vertex.position != before[n])
            vertex.set_error_bound(vertex.error_bound() + length(vertex.position - before[n]));
    }
}

/// Regions that are farther off now than before.
std::vector<Label> worse_regions(const State& before, const State& now) {
    std::vector<Label> worse;
    for (Label label = 0; label < now.drifts.size(); ++label)
        if (now.drifts[label] > std::max(before.drifts[label], kVolumeTolerance)) worse.push_back(label);
    return worse;
}

}  // namespace

PreserveReport preserve_volumes(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options) {
    return preserve_volumes_within(mesh, wanted, options, HUGE_VAL);
}

PreserveReport preserve_volumes_within(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options,
                                       double max_error) {
    require_in_range(options);
    for (const std::optional<double>& volume : wanted)
        if (volume) require_number("wanted", *volume, {-kMostNumber, kMostNumber, "any size"});
    const State before = state_of(mesh, wanted);
    State best = before;
    const Reach reach{before.positions, std::isfinite(max_error) ? storable_bound(max_error) : HUGE_VAL};
    PreserveReport report;
    std::vector<bool> left(wanted.size());
    for (std::uint32_t attempt = 0; attempt < kMostAttempts; ++attempt) {
        put_back(mesh, before.positions);
        VolumeRounds rounds(mesh, wanted, options, left, reach);
        std::vector<Label> worse;
        for (std::uint32_t round = 0; round < kMostVolumeRounds && !rounds.is_done(); ++round) {
            report.held_vertices += rounds.run_round();
            ++report.rounds;
            State now = state_of(mesh, wanted);
            worse = worse_regions(before, now);
            if (worse.empty() && now.is_better_than(best)) best = std::move(now);
        }
        report.largest_displacement = std::max(report.largest_displacement, rounds.largest_displacement());
        if (worse.empty()) break;
        for (Label label : worse) left[label] = true;
    }
    put_back(mesh, best.positions);
    raise_error_bounds(mesh, before.positions);
    report.drift_before = before.worst();
    report.drift = best.worst();
    report.regions_off = best.regions_off();
    return report;
}

}  // namespace regionmesh
