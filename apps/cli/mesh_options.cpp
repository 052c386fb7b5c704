#include "mesh_options.h"

#include <fmt/core.h>

#include "input_options.h"

namespace regionmesh::cli {

void MeshOptions::add_options(CLI::App& command) {
    command.add_option("--weld", weld,
                       "join points of the model no farther apart than this, in its unit; 0: points at one place");
    command.add_flag("--orient", orient, "turn faces so that neighbours agree on which side each region lies");
}

MeshFile MeshOptions::read(const std::string& path) const {
    ReadMeshOptions options{.orient = orient};
    if (!weld.empty()) options.weld = parse_number("--weld", weld);
    return read_mesh(path, options);
}

std::string counts_text(const CheckReport& report) {
    std::string text;
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (report.counts[kind] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(static_cast<ViolationKind>(kind)),
                                report.counts[kind]);
    return text;
}

void print_orient_hint(const CheckReport& report) {
    if (report.counts[static_cast<int>(ViolationKind::kOrientation)] > 0)
        fmt::print("faces that look opposite ways can be turned: --orient\n");
}

void print_unsound(const FixedPart& fixed, const CheckReport& before, const CheckReport& after) {
    if (before.violation_count() > 0)
        fmt::print("{} vertices and {} faces left as they came: {}\n", fixed.vertices, fixed.faces,
                   counts_text(before));
    print_orient_hint(before);
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (after.counts[kind] > before.counts[kind])
            fmt::print("worse than it came: {} {}, before {}\n", to_string(static_cast<ViolationKind>(kind)),
                       after.counts[kind], before.counts[kind]);
}

}  // namespace regionmesh::cli
