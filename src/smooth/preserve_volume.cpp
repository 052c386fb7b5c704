#include <algorithm>
#include <array>
#include <cmath>

#include "base/triangle.h"
#include "mesh/region_volumes.h"
#include "regionmesh/mesh.h"
#include "regionmesh/smooth.h"
#include "smooth/guarded_move.h"
#include "smooth/region_matrix.h"
#include "smooth/relax.h"
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

class Preserving {
public:
    Preserving(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options)
        : mesh_(mesh), wanted_(wanted), options_(options), rest_(mesh.vertex_end()) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            if (!mesh.is_alive(VertexId{v}) || mesh[VertexId{v}].is_fixed) rest_[v] = kForEver;
    }

    PreserveReport run() {
        note_missing();
        report_.drift_before = report_.drift;
        while (!is_done() && report_.rounds < kMostVolumeRounds) {
            ++report_.rounds;
            const std::vector<double> multipliers = solve();
            std::vector<Vec3> to(mesh_.vertex_end());
            for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) to[v] = target(VertexId{v}, multipliers);
            hold(move_guarded(mesh_, to, options_));
            note_missing();
        }
        return report_;
    }

private:
    /// Has a wanted volume, and is not given up.
    bool is_wanted(Label label) const {
        return label < wanted_.size() && wanted_[label] && stalled_[label] < kPatience;
    }

    /// Notes the volume that each region is missing, and the volume that it asks for in the next round.
    void note_missing() {
        const std::vector<double> volumes = region_volumes(mesh_);
        const std::vector<double> most = most_asked();
        report_.drift = 0;
        report_.regions_off = 0;
        for (Label label = 0; label < wanted_.size(); ++label) {
            if (!wanted_[label] || *wanted_[label] == 0) continue;
            const double missing = *wanted_[label] - (label < volumes.size() ? volumes[label] : 0);
            const double drift = std::abs(missing / *wanted_[label]);
            report_.drift = std::max(report_.drift, drift);
            report_.regions_off += drift > kVolumeTolerance;
            if (report_.rounds > 0 && drift > kVolumeTolerance) {
                const double gained = std::abs(missing_[label]) - std::abs(missing);
                stalled_[label] = gained < kLeastGain * std::abs(asked_[label]) ? stalled_[label] + 1 : 0;
            }
            missing_[label] = missing;
            asked_[label] = is_wanted(label) ? std::clamp(missing, -most[label], most[label]) : 0;
        }
        balance();
    }

    /// Without background the missing volumes sum to zero up to rounding, and so must the volumes asked for: the
    /// largest region takes the difference.
    void balance() {
        Label largest = 0;
        double missing = 0, asked = 0, all = 0;
        for (Label label = 0; label < wanted_.size(); ++label) {
            if (!is_wanted(label)) continue;
            if (!is_wanted(largest) || *wanted_[label] > *wanted_[largest]) largest = label;
            missing += missing_[label];
            asked += asked_[label];
            all += *wanted_[label];
        }
        if (is_wanted(largest)) asked_[largest] += (std::abs(missing) < kRounding * all ? 0 : missing) - asked;
    }

    bool is_done() const {
        for (Label label = 0; label < wanted_.size(); ++label)
            if (is_wanted(label) && std::abs(missing_[label]) > kEnoughDrift * std::abs(*wanted_[label])) return false;
        return true;
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

    /// Vertices that backtracked rest for some rounds.
    void hold(const std::vector<std::uint8_t>& levels) {
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            if (rest_[v] == kForEver) continue;
            if (rest_[v] > 0) --rest_[v];
            if (levels[v] == 0) continue;
            rest_[v] = kRestRounds;
            ++report_.held_vertices;
        }
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
        report_.largest_displacement = std::max(report_.largest_displacement, std::min(size, longest));
        Vec3 to = from + step;
        keep_on_sides(kept_sides(v), from, to);
        return to;
    }

    Mesh& mesh_;
    const WantedVolumes& wanted_;
    const SmoothOptions& options_;
    std::vector<std::uint8_t> rest_;  // rounds to sit out
    double edge_ = typical_edge(mesh_);
    std::vector<double> missing_ = std::vector<double>(wanted_.size());
    std::vector<double> asked_ = std::vector<double>(wanted_.size());
    std::vector<int> stalled_ = std::vector<int>(wanted_.size());  // rounds without progress
    PreserveReport report_;
};

}  // namespace

PreserveReport preserve_volumes(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options) {
    return Preserving(mesh, wanted, options).run();
}

}  // namespace regionmesh
