#include "check/check_parts.h"

#include <algorithm>

namespace regionmesh {

void PartsCheck::add(const Mesh& mesh, const MeshPart& part) {
    Findings findings(options_.listed);
    sum_faces(mesh, options_, &part, origin_, faces_, findings);
    CheckReport own;
    const PartStars stars{part, components_};
    check_stars(mesh, options_, stars_, own, findings, &stars);
    nesting_.add(mesh, part);
    report_.quadruple_points_inside += own.quadruple_points_inside;
    check_places(mesh, options_, findings, &part);
    if (options_.crossing) check_crossing(mesh, options_, SortedFaceTree(mesh, options_.threads), findings, &part);
    lines_.append(sum_lines(mesh, &part, options_.threads));
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
    for (Label label = 0; label < stars_.size(); ++label) {
        if (label >= regions.size()) regions.resize(label + 1);
        regions[label].euler += stars_[label].euler;
        regions[label].components += stars_[label].components;
    }
    list_regions(options_, regions, report_);
    report_.quality = faces_.quality.report();
    report_.region_pairs = faces_.pairs.size();
    report_.lines = lines_.report();
    nesting_.report(options_, all_);
    check_against_labels(options_, report_, all_);
    all_.move_to(report_);
    return std::move(report_);
}

}  // namespace regionmesh
