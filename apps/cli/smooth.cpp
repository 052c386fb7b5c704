#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"

namespace regionmesh::cli {
namespace {

void print_summary(const Settings& settings, const Report& report, const CheckReport& before) {
    say("{}: {} vertices, {} of them backtracked; largest displacement {:.3g}; lowest quality {:.3f}; {} violations "
        "(before {})",
        output_text(settings), report.smoothing.vertices, report.smoothing.backtracked,
        report.smoothing.largest_displacement, report.check.quality.min, report.check.violation_count(),
        before.violation_count());
}

}  // namespace

int run_smooth(const Settings& given) {
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    ModelChange change = smooth_model(file.mesh, settings, options);
    Report& report = change.report;
    write_changed(kSmooth, settings, file, options, report);
    print_summary(settings, report, change.before);
    print_locked_part(change);
    return exit_code(report);
}

}  // namespace regionmesh::cli
