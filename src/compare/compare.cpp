#include "regionmesh/compare.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel_for.h"
#include "compare/common_labels.h"
#include "compare/model_side.h"
#include "compare/nearest_search.h"
#include "compare/statistics.h"
#include "surface/file_view.h"

namespace regionmesh {
namespace {

/// One per sample of a side: distances to the other side; NaN where it lacks the region, interface or line.
struct Distances {
    std::vector<double> to_all;
    std::array<std::vector<double>, 2> to_region;  // distances to the regions of the interface
    std::vector<double> to_interface, to_line;
};

/// Distances below this are rounded to 0.
double rounding_of(const ModelSide& a, const ModelSide& b) {
    double largest = 0;
    for (const ModelSide* side : {&a, &b}) {
        const Box& box = side->bounds();
        if (box.is_empty()) continue;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max({largest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    }
    return 1e-14 * largest;
}

/// Goals in the other model, for the samples on each interface.
std::vector<Goals> interface_goals(const ModelSide& from, const ModelSide& to) {
    std::set<Label> regions;
    for (const auto& labels : to.interfaces().labels) regions.insert(labels.begin(), labels.end());
    for (const Label label : from.background()) regions.erase(label);
    std::vector<Goals> goals;
    for (const auto& labels : from.interfaces().labels) {
        goals.push_back({.all = !to.interfaces().labels.empty(), .stratum = to.interfaces().find(labels)});
        for (int n = 0; n < 2; ++n)
            if (regions.contains(labels[n])) goals.back().regions[n] = labels[n];
    }
    return goals;
}

std::vector<Goals> line_goals(const ModelSide& from, const ModelSide& to) {
    std::vector<Goals> goals;
    for (const auto& labels : from.lines().labels) goals.push_back({.stratum = to.lines().find(labels)});
    return goals;
}

/// Distances from one side to the other.
Distances measure(ModelSide& from, ModelSide& to, double rounding, std::uint32_t threads) {
    const auto [face_points, line_points] = from.sample();
    NearestSearch faces(face_points, from.face_samples(), interface_goals(from, to));
    NearestSearch lines(line_points, from.line_samples(), line_goals(from, to));
    search(to, faces, lines, threads);
    return {.to_all = faces.take(Goal::kAll, rounding),
            .to_region = {faces.take(Goal::kFirstRegion, rounding), faces.take(Goal::kSecondRegion, rounding)},
            .to_interface = faces.take(Goal::kStratum, rounding),
            .to_line = lines.take(Goal::kStratum, rounding)};
}

/// The samples of one stratum.
void add_part(std::vector<WeightedDistances>& parts, const std::vector<double>& distances, const Samples& samples,
              std::uint32_t stratum) {
    const std::uint64_t begin = samples.begin(stratum), end = samples.end(stratum);
    if (begin < end) parts.push_back({std::span(distances).subspan(begin, end - begin), samples.weight(stratum)});
}

using Parts = std::array<std::vector<WeightedDistances>, 2>;  // distances from A, from B

/// None where one of the two models has no samples.
TwoSidedDistance two_sided(const Parts& parts) {
    if (parts[0].empty() || parts[1].empty()) return {};
    std::vector<WeightedDistances> all = parts[0];
    all.insert(all.end(), parts[1].begin(), parts[1].end());
    return {statistics_of(parts[0]), statistics_of(parts[1]), statistics_of(all)};
}

using Sides = std::array<const ModelSide*, 2>;
using Directions = std::array<Distances, 2>;

TwoSidedDistance whole_distance(const Sides& sides, const Directions& directions) {
    Parts parts;
    for (int n = 0; n < 2; ++n)
        for (std::uint32_t s = 0; s < sides[n]->interfaces().labels.size(); ++s)
            add_part(parts[n], directions[n].to_all, sides[n]->face_samples(), s);
    return two_sided(parts);
}

/// The place of a label in an interface.
struct Place {
    std::uint32_t stratum;
    int place;  // 0 or 1
};

std::vector<std::vector<Place>> places_by_label(const ModelStrata& interfaces, std::uint32_t label_count) {
    std::vector<std::vector<Place>> places(label_count);
    for (std::uint32_t s = 0; s < interfaces.labels.size(); ++s)
        for (int place = 0; place < 2; ++place) {
            const Label label = interfaces.labels[s][place];
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
    const std::array places{places_by_label(sides[0]->interfaces(), label_count),
                            places_by_label(sides[1]->interfaces(), label_count)};
    parallel_for(static_cast<std::uint32_t>(result.size()), threads, [&](std::uint32_t r) {
        Parts parts;
        for (int n = 0; n < 2; ++n)
            for (const auto& [stratum, place] : places[n][result[r].label])
                add_part(parts[n], directions[n].to_region[place], sides[n]->face_samples(), stratum);
        result[r].distance = two_sided(parts);
    });
    return result;
}

/// Interfaces or lines. `strata`, `samples` and `distances` are those of A and B.
std::vector<StratumComparison> compare_strata(const std::array<const ModelStrata*, 2>& strata,
                                              const std::array<const Samples*, 2>& samples,
                                              const std::array<const std::vector<double>*, 2>& distances,
                                              std::uint32_t threads) {
    std::set<std::vector<Label>> all;
    for (const ModelStrata* side : strata) all.insert(side->labels.begin(), side->labels.end());
    std::vector<StratumComparison> result;
    for (const auto& labels : all) result.push_back({.labels = labels, .measures = {}, .distance = {}});
    parallel_for(static_cast<std::uint32_t>(result.size()), threads, [&](std::uint32_t r) {
        Parts parts;
        for (int n = 0; n < 2; ++n) {
            const std::uint32_t s = strata[n]->find(result[r].labels);
            if (s == kNoStratum) continue;
            result[r].measures[n] = samples[n]->measure(s);
            add_part(parts[n], *distances[n], *samples[n], s);
        }
        result[r].distance = two_sided(parts);
    });
    return result;
}

/// One per vertex id, 0 where there is none; nothing for a model that is no mesh in memory.
std::vector<double> distances_of_vertices(const ComparedModel& model, ModelSide& to, double rounding,
                                          std::uint32_t threads) {
    std::vector<double> result;
    if (model.part_count() != 1 || to.interfaces().labels.empty()) return result;
    model.read(0, [&](const Mesh& mesh, const MeshPart* part) {
        if (part) return;
        std::vector<Vec3> points;
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            if (mesh.is_alive(VertexId{v})) points.push_back(mesh.position(VertexId{v}));
        NearestSearch vertices(points), none({});
        search(to, vertices, none, threads);
        const std::vector<double> found = vertices.take(Goal::kAll, rounding);
        result.resize(mesh.vertex_end());
        for (std::uint32_t v = 0, n = 0; v < mesh.vertex_end(); ++v)
            if (mesh.is_alive(VertexId{v})) result[v] = found[n++];
    });
    return result;
}

/// Measures of both models. Violations are not reported here; check does that.
std::array<CheckReport, 2> measure(const std::array<const ComparedModel*, 2>& models, const CompareOptions& options) {
    std::array<CheckReport, 2> reports;
    parallel_for(2, options.threads, [&](std::uint32_t n) {
        CheckOptions check_options{.crossing = false, .threads = options.threads, .listed = 0};
        const LabelTable& labels = models[n]->labels();
        for (Label dense = 0; dense < labels.size(); ++dense)
            if (std::ranges::find(options.background, labels.input(dense)) != options.background.end())
                check_options.background.push_back(dense);
        reports[n] = models[n]->measure(check_options);
    });
    return reports;
}

}  // namespace

ComparedMesh::ComparedMesh(const Mesh& mesh, const LabelTable& labels) : mesh_(mesh), labels_(labels) {
    require_labels(mesh, labels, "mesh");
}

bool ComparedMesh::has_sides() const {
    bool has_exterior = false;
    for (std::uint32_t f = 0; f < mesh_.face_end() && !has_exterior; ++f)
        has_exterior = mesh_.is_alive(FaceId{f}) && is_exterior(mesh_[FaceId{f}].labels[1]);
    if (!has_exterior) return true;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v)
        if (mesh_.is_alive(VertexId{v}) && (mesh_[VertexId{v}].sides & kBoxSides) != 0) return true;
    return false;
}

CompareReport compare(const ComparedModel& a, const ComparedModel& b, const CompareOptions& options) {
    const std::uint32_t threads = options.threads;
    const auto checks = measure({&a, &b}, options);
    const CommonLabels labels(a.labels(), b.labels());
    const SideOptions side_options{.background = labels.common_of(options.background),
                                   .sides_apart = a.has_sides() && b.has_sides(),
                                   .samples = options.samples,
                                   .threads = threads};
    ModelSide side_a(a, labels, 0, side_options), side_b(b, labels, 1, side_options);
    const Sides sides{&side_a, &side_b};
    const double rounding = rounding_of(side_a, side_b);

    CompareReport report;
    if (options.vertex_distances) report.vertex_distances = distances_of_vertices(a, side_b, rounding, threads);
    Directions directions;
    directions[0] = measure(side_a, side_b, rounding, threads);
    side_b.drop_trees();
    directions[1] = measure(side_b, side_a, rounding, threads);
    side_a.drop_trees();
    report.labels = labels.table();
    report.faces = {a.face_count(), b.face_count()};
    report.vertices = {a.vertex_count(), b.vertex_count()};
    report.distance = whole_distance(sides, directions);
    report.regions = compare_regions(checks, labels, sides, directions, threads);
    report.interfaces =
        compare_strata({&side_a.interfaces(), &side_b.interfaces()}, {&side_a.face_samples(), &side_b.face_samples()},
                       {&directions[0].to_interface, &directions[1].to_interface}, threads);
    report.lines = compare_strata({&side_a.lines(), &side_b.lines()}, {&side_a.line_samples(), &side_b.line_samples()},
                                  {&directions[0].to_line, &directions[1].to_line}, threads);
    report.quality = {checks[0].quality, checks[1].quality};
    return report;
}

CompareReport compare(const ComparedMesh& a, const ComparedMesh& b, const CompareOptions& options) {
    const ComparedModel &first = a, &second = b;
    return compare(first, second, options);
}

}  // namespace regionmesh
