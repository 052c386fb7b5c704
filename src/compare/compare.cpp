#include "regionmesh/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "base/parallel_for.h"
#include "compare/common_labels.h"
#include "compare/sample.h"
#include "compare/sorted_strata.h"
#include "compare/strata_tree.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 4096;  // samples or vertices per task; each search starts at the result before
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // no distance: the other model lacks the part

std::uint32_t chunks_of(std::uint64_t count) { return static_cast<std::uint32_t>((count + kChunk - 1) / kChunk); }

/// One of the two models, prepared for sampling and searching.
struct Side {
    Side(const CommonView& v, bool sides_apart, std::uint64_t samples, std::uint32_t threads)
        : view(v),
          interfaces(interfaces_of(v, threads)),
          lines(lines_of(v, sides_apart, threads)),
          face_tree(interfaces, threads),
          line_tree(lines, threads),
          face_samples(interfaces, samples, threads),
          line_samples(lines, samples / 10, threads) {}
    Side(const Side&) = delete;  // its parts refer to one another

    const CommonView view;
    const SortedStrata interfaces, lines;
    const StrataTree face_tree, line_tree;
    const Samples face_samples, line_samples;
};

/// Whether the exterior faces of the model are labelled by side of the box. Files whose exterior is no box lack that.
bool has_sides(const Mesh& mesh) {
    bool has_exterior = false;
    for (std::uint32_t f = 0; f < mesh.face_end() && !has_exterior; ++f)
        has_exterior = mesh.is_alive(FaceId{f}) && is_exterior(mesh[FaceId{f}].labels[1]);
    if (!has_exterior) return true;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v}) && mesh[VertexId{v}].sides != 0) return true;
    return false;
}

/// By sample of a side: distances to the other side.
struct FaceDistances {
    std::vector<double> to_all;
    std::array<std::vector<double>, 2> to_region;  // of the first and the second label of the interface
    std::vector<double> to_interface;
};

/// Distances below this are rounded to 0.
double rounding_of(const Side& a, const Side& b) {
    double largest = 0;
    for (const Side* side : {&a, &b}) {
        if (side->interfaces.points.empty()) continue;
        const Box& box = side->interfaces.bounds;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max({largest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    }
    return 1e-14 * largest;
}

/// From one side to the other.
class Direction {
public:
    Direction(const Side& from, const Side& to, double rounding, std::uint32_t threads)
        : from_(from), to_(to), rounding_(rounding), threads_(threads) {
        measure_faces();
        measure_lines();
    }

    const FaceDistances& faces() const { return faces_; }
    const std::vector<double>& lines() const { return lines_; }

private:
    double distance(const Nearest& nearest) const {
        if (nearest.simplex == kNoSimplex) return kNone;
        const double distance = std::sqrt(nearest.squared);
        return distance > rounding_ ? distance : 0;
    }

    /// For each stratum of `a`, the one of `b` with the same labels.
    static std::vector<std::uint32_t> twins(const SortedStrata& a, const SortedStrata& b) {
        std::vector<std::uint32_t> found;
        for (const Stratum& stratum : a.strata) found.push_back(b.find(stratum.labels));
        return found;
    }

    bool is_region(Label label) const {
        const auto& background = from_.view.background;
        return !is_exterior(label) && std::ranges::find(background, label) == background.end();
    }

    /// The nearest simplex of all is also the nearest of its region and interface, so these are searched only where it
    /// has other labels.
    void measure_faces() {
        const Samples& samples = from_.face_samples;
        const auto twin_of = twins(from_.interfaces, to_.interfaces);
        for (auto* distances : {&faces_.to_all, &faces_.to_region[0], &faces_.to_region[1], &faces_.to_interface})
            distances->assign(samples.size(), kNone);
        for_chunks(samples.size(), [&](std::uint64_t first, std::uint64_t last) {
            Nearest nearest;
            samples.for_range(first, last, [&](std::uint64_t sample, std::uint32_t stratum, Vec3 p) {
                nearest = to_.face_tree.nearest(p, nearest);
                if (nearest.simplex == kNoSimplex) return;
                const double least = distance(nearest);
                faces_.to_all[sample] = least;
                const Stratum& there = to_.interfaces.strata[nearest.stratum];
                for (int n = 0; n < 2; ++n) {
                    const Label label = from_.interfaces.strata[stratum].labels[n];
                    if (!is_region(label)) continue;
                    faces_.to_region[n][sample] =
                        there.contains(label) ? least : distance(to_.face_tree.nearest_of_label(p, label));
                }
                const std::uint32_t twin = twin_of[stratum];
                faces_.to_interface[sample] =
                    twin == nearest.stratum ? least : distance(to_.face_tree.nearest_of_stratum(p, twin));
            });
        });
    }

    void measure_lines() {
        const Samples& samples = from_.line_samples;
        const auto twin_of = twins(from_.lines, to_.lines);
        lines_.assign(samples.size(), kNone);
        for_chunks(samples.size(), [&](std::uint64_t first, std::uint64_t last) {
            samples.for_range(first, last, [&](std::uint64_t sample, std::uint32_t stratum, Vec3 p) {
                lines_[sample] = distance(to_.line_tree.nearest_of_stratum(p, twin_of[stratum]));
            });
        });
    }

    void for_chunks(std::uint64_t count, const std::function<void(std::uint64_t, std::uint64_t)>& work) const {
        parallel_for(chunks_of(count), threads_, [&](std::uint32_t chunk) {
            const std::uint64_t first = std::uint64_t{chunk} * kChunk;
            work(first, std::min(count, first + kChunk));
        });
    }

    const Side& from_;
    const Side& to_;
    double rounding_;
    std::uint32_t threads_;
    FaceDistances faces_;
    std::vector<double> lines_;
};

/// The samples of one stratum.
void add_part(std::vector<WeightedDistances>& parts, const std::vector<double>& distances, const Samples& samples,
              std::uint32_t stratum) {
    const std::uint64_t begin = samples.begin(stratum), end = samples.end(stratum);
    if (begin < end) parts.push_back({std::span(distances).subspan(begin, end - begin), samples.weight(stratum)});
}

using Parts = std::array<std::vector<WeightedDistances>, 2>;  // from A, from B

/// None where one of the two models has no samples.
TwoSidedDistance two_sided(const Parts& parts) {
    if (parts[0].empty() || parts[1].empty()) return {};
    std::vector<WeightedDistances> all = parts[0];
    all.insert(all.end(), parts[1].begin(), parts[1].end());
    return {statistics_of(parts[0]), statistics_of(parts[1]), statistics_of(all)};
}

using Sides = std::array<const Side*, 2>;
using Directions = std::array<const Direction*, 2>;

TwoSidedDistance whole_distance(const Sides& sides, const Directions& directions) {
    Parts parts;
    for (int n = 0; n < 2; ++n)
        for (std::uint32_t s = 0; s < sides[n]->interfaces.strata.size(); ++s)
            add_part(parts[n], directions[n]->faces().to_all, sides[n]->face_samples, s);
    return two_sided(parts);
}

/// The place of a label in an interface.
struct Place {
    std::uint32_t stratum;
    int place;  // 0 or 1
};

std::vector<std::vector<Place>> places_by_label(const SortedStrata& interfaces, std::uint32_t label_count) {
    std::vector<std::vector<Place>> places(label_count);
    for (std::uint32_t s = 0; s < interfaces.strata.size(); ++s)
        for (int place = 0; place < 2; ++place) {
            const Label label = interfaces.strata[s].labels[place];
            if (!is_exterior(label)) places[label].push_back({s, place});
        }
    return places;
}

std::vector<RegionComparison> compare_regions(const std::array<CheckReport, 2>& checks, const CommonLabels& labels,
                                              const Sides& sides, const Directions& directions, std::uint32_t threads) {
    std::set<Label> all;
    for (int n = 0; n < 2; ++n)
        for (const RegionReport& region : checks[n].regions) all.insert(labels.common(n, region.label));
    std::vector<RegionComparison> result;
    for (const Label label : all) result.push_back({.label = label, .measures = {}, .distance = {}});
    for (int n = 0; n < 2; ++n)
        for (RegionReport region : checks[n].regions) {
            region.label = labels.common(n, region.label);
            std::ranges::lower_bound(result, region.label, {}, &RegionComparison::label)->measures[n] = region;
        }
    const std::uint32_t label_count = labels.table().size();
    const std::array places{places_by_label(sides[0]->interfaces, label_count),
                            places_by_label(sides[1]->interfaces, label_count)};
    parallel_for(static_cast<std::uint32_t>(result.size()), threads, [&](std::uint32_t r) {
        Parts parts;
        for (int n = 0; n < 2; ++n)
            for (const auto& [stratum, place] : places[n][result[r].label])
                add_part(parts[n], directions[n]->faces().to_region[place], sides[n]->face_samples, stratum);
        result[r].distance = two_sided(parts);
    });
    return result;
}

/// Interfaces or lines. `sorted`, `samples` and `distances` are those of A and B.
std::vector<StratumComparison> compare_strata(const std::array<const SortedStrata*, 2>& sorted,
                                              const std::array<const Samples*, 2>& samples,
                                              const std::array<const std::vector<double>*, 2>& distances,
                                              std::uint32_t threads) {
    std::set<std::vector<Label>> all;
    for (const SortedStrata* side : sorted)
        for (const Stratum& stratum : side->strata) all.insert(stratum.labels);
    std::vector<StratumComparison> result;
    for (const auto& labels : all) result.push_back({.labels = labels, .measures = {}, .distance = {}});
    parallel_for(static_cast<std::uint32_t>(result.size()), threads, [&](std::uint32_t r) {
        Parts parts;
        for (int n = 0; n < 2; ++n) {
            const std::uint32_t s = sorted[n]->find(result[r].labels);
            if (s == kNoStratum) continue;
            result[r].measures[n] = samples[n]->measure(s);
            add_part(parts[n], *distances[n], *samples[n], s);
        }
        result[r].distance = two_sided(parts);
    });
    return result;
}

std::vector<double> distances_of_vertices(const Mesh& mesh, const StrataTree& tree, double rounding,
                                          std::uint32_t threads) {
    if (tree.sorted().simplices.empty()) return {};
    std::vector<double> result(mesh.vertex_end(), 0);
    parallel_for(chunks_of(result.size()), threads, [&](std::uint32_t chunk) {
        Nearest nearest;
        const std::size_t end = std::min(result.size(), (std::size_t{chunk} + 1) * kChunk);
        for (std::size_t n = std::size_t{chunk} * kChunk; n < end; ++n) {
            const VertexId v{static_cast<std::uint32_t>(n)};
            if (!mesh.is_alive(v)) continue;
            nearest = tree.nearest(mesh.position(v), nearest);
            const double distance = std::sqrt(nearest.squared);
            result[n] = distance > rounding ? distance : 0;
        }
    });
    return result;
}

/// Measures of both models. Violations are not reported here; check does that.
std::array<CheckReport, 2> measure(const std::array<ComparedMesh, 2>& meshes, const CompareOptions& options) {
    std::array<CheckReport, 2> reports;
    parallel_for(2, options.threads, [&](std::uint32_t n) {
        CheckOptions check_options{.crossing = false, .listed = 0};
        const LabelTable& labels = meshes[n].labels;
        for (Label dense = 0; dense < labels.size(); ++dense)
            if (std::ranges::find(options.background, labels.input(dense)) != options.background.end())
                check_options.background.push_back(dense);
        reports[n] = check(meshes[n].mesh, check_options);
    });
    return reports;
}

}  // namespace

CompareReport compare(const ComparedMesh& a, const ComparedMesh& b, const CompareOptions& options) {
    const CommonLabels labels(a.labels, b.labels);
    const std::vector<Label> background = labels.common_of(options.background);
    const bool sides_apart = has_sides(a.mesh) && has_sides(b.mesh);
    const std::uint32_t threads = options.threads;

    const Side side_a({a.mesh, labels, 0, background}, sides_apart, options.samples, threads);
    const Side side_b({b.mesh, labels, 1, background}, sides_apart, options.samples, threads);
    const double rounding = rounding_of(side_a, side_b);
    const Direction from_a(side_a, side_b, rounding, threads), from_b(side_b, side_a, rounding, threads);
    const Sides sides{&side_a, &side_b};
    const Directions directions{&from_a, &from_b};
    const auto checks = measure({a, b}, options);

    CompareReport report;
    report.labels = labels.table();
    report.faces = {a.mesh.face_count(), b.mesh.face_count()};
    report.vertices = {a.mesh.vertex_count(), b.mesh.vertex_count()};
    report.distance = whole_distance(sides, directions);
    report.regions = compare_regions(checks, labels, sides, directions, threads);
    report.interfaces =
        compare_strata({&side_a.interfaces, &side_b.interfaces}, {&side_a.face_samples, &side_b.face_samples},
                       {&from_a.faces().to_interface, &from_b.faces().to_interface}, threads);
    report.lines = compare_strata({&side_a.lines, &side_b.lines}, {&side_a.line_samples, &side_b.line_samples},
                                  {&from_a.lines(), &from_b.lines()}, threads);
    report.quality = {checks[0].quality, checks[1].quality};
    if (options.vertex_distances)
        report.vertex_distances = distances_of_vertices(a.mesh, side_b.face_tree, rounding, threads);
    return report;
}

}  // namespace regionmesh
