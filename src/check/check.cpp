#include "regionmesh/check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "check/check_steps.h"

namespace regionmesh {
namespace {

constexpr std::array<const char*, kViolationKindCount> kKindNames{
    "open_edge",      "overfull_edge",    "orientation",         "pinched_vertex", "few_edges",
    "duplicate_face", "degenerate_face",  "coincident_vertices", "unused_vertex",  "crossing_faces",
    "euler",          "quadruple_points", "region_pairs",        "nesting",        "non_generic_vertex"};

}  // namespace

const char* to_string(ViolationKind kind) { return kKindNames[static_cast<int>(kind)]; }

std::uint64_t CheckReport::violation_count() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

void list_regions(const CheckOptions& options, const std::vector<RegionReport>& regions, CheckReport& report) {
    for (Label label = 0; label < regions.size(); ++label) {
        if (!(regions[label].area > 0) || options.is_background(label)) continue;
        report.regions.push_back(regions[label]);
        report.regions.back().label = label;
    }
}

void check_volumes(const CheckOptions& options, const std::vector<RegionReport>& sums, const CheckReport& report,
                   Findings& findings) {
    constexpr double kRounding = 1e-9;
    const auto is_negative = [](const RegionReport& region) {
        return region.volume < -kRounding * std::pow(region.area, 1.5);
    };
    const bool is_closed = findings.count(ViolationKind::kOpenEdge) + findings.count(ViolationKind::kOverfullEdge) +
                               findings.count(ViolationKind::kOrientation) ==
                           0;
    if (options.boundary_is_open || !is_closed) return;
    // Each face counts on both sides: where no face has an exterior, the volumes of all labels sum to zero, and one of
    // them, which is outside, is negative; it may be a region or background.
    double sum = 0, all = 0;
    for (const RegionReport& region : sums) {
        sum += region.volume;
        all += std::abs(region.volume);
    }
    if (std::abs(sum) <= kRounding * all && std::ranges::count_if(sums, is_negative) <= 1) return;
    for (const RegionReport& region : report.regions)
        if (is_negative(region))
            findings.add(ViolationKind::kOrientation, {}, {}, [&] {
                return region_name(options, region.label) +
                       " is inside out: its volume is negative; --orient turns its faces";
            });
}

CheckReport check(const Mesh& mesh, const CheckOptions& options) {
    CheckReport report;
    Findings findings(options.listed);
    StarTotals totals;
    check_faces(mesh, options, totals.regions, report, findings);
    check_stars(mesh, options, totals, findings);
    list_regions(options, totals.regions, report);
    check_volumes(options, totals.regions, report, findings);
    report.quadruple_points_inside = totals.quadruple_points_inside;
    report.lines = totals.lines.report();
    report.shapes = measure_shapes(mesh, options.threads);
    check_places(mesh, options, findings);
    std::optional<SortedFaceTree> tree;
    if (options.crossing) {
        tree.emplace(mesh, options.threads);
        check_crossing(mesh, options, *tree, std::move(totals.crossings), findings);
    }
    check_nesting(mesh, options, tree ? &*tree : nullptr, findings);
    check_against_labels(options, report, findings);
    findings.move_to(report);
    for (Violation& violation : report.violations) place_violation(mesh, violation);
    return report;
}

void check_against_labels(const CheckOptions& options, CheckReport& report, Findings& findings) {
    if (!options.oracle) return;
    const LabelOracle& oracle = *options.oracle;
    std::vector<std::int64_t> euler(oracle.euler.size(), 0);
    for (const RegionReport& region : report.regions)
        if (region.label < euler.size()) euler[region.label] = region.euler;
    for (Label label = 0; label < euler.size(); ++label) {
        if (options.is_background(label)) continue;
        if (!options.boundary_is_open && euler[label] != oracle.euler[label])
            findings.add(ViolationKind::kEuler, {}, {}, [&] {
                return region_name(options, label) + ": Euler characteristic " + std::to_string(euler[label]) +
                       ", its labels say " + std::to_string(oracle.euler[label]);
            });
    }
    const auto compare = [&](ViolationKind kind, std::uint64_t found, std::uint64_t expected, const char* what) {
        if (found != expected)
            findings.add(kind, {}, {}, [&] {
                return std::to_string(found) + " " + what + ", the labels say " + std::to_string(expected);
            });
    };
    compare(ViolationKind::kQuadruplePoints, report.quadruple_points_inside, oracle.quadruple_points_inside,
            "interior quadruple points");
    compare(ViolationKind::kRegionPairs, report.region_pairs, oracle.region_pairs,
            "pairs of regions with an interface");
}

}  // namespace regionmesh
