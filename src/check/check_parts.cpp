#include "check/check_parts.h"

#include <algorithm>
#include <utility>

namespace regionmesh {

void PartsCheck::add(const Mesh& mesh, const MeshPart& part) {
    Findings findings(options_.listed);
    sum_faces(mesh, options_, &part, origin_, faces_, findings);
    const PartStars stars{part, components_};
    check_stars(mesh, options_, stars_, findings, &stars);
    nesting_.add(mesh, part);
    check_places(mesh, options_, findings, &part);
    if (options_.crossing)
        check_crossing(mesh, options_, SortedFaceTree(mesh, options_.threads), std::exchange(stars_.crossings, {}),
                       findings, &part);
    CheckReport found;
    findings.move_to(found);
    for (Violation& violation : found.violations) {
        place_violation(mesh, violation);
        violation.text += part.text();
    }
    Findings placed(options_.listed);
    placed.take_from(std::move(found));
    all_.append(std::move(placed));
}

CheckReport PartsCheck::finish() {
    std::vector<RegionReport>& regions = faces_.regions;
    for (Label label = 0; label < stars_.regions.size(); ++label) {
        if (label >= regions.size()) regions.resize(label + 1);
        regions[label].euler += stars_.regions[label].euler;
        regions[label].components += stars_.regions[label].components;
    }
    list_regions(options_, regions, report_);
    check_volumes(options_, regions, report_, all_);
    report_.quality = faces_.quality.report();
    report_.region_pairs = faces_.pairs.size();
    report_.quadruple_points_inside = stars_.quadruple_points_inside;
    report_.lines = stars_.lines.report();
    nesting_.report(options_, all_);
    check_against_labels(options_, report_, all_);
    all_.move_to(report_);
    return std::move(report_);
}

}  // namespace regionmesh
