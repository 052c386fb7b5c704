#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"

namespace regionmesh::cli {

int run_view(const Settings& given) {
    require_page(given.output, given.writing);
    const std::string& path = given.models.front();
    MeshFile file = read_model(path, given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    const CheckReport report = check(file.mesh, options);
    const auto [names, colours] = describe(settings, file.names, file.colours);
    OutputFiles files(settings.writing);
    const Model model{file.mesh, file.labels, options.background, names, colours, file.coordinates};
    write_page(
        settings.output, {page_model(path, model)},
        page_options(kView, settings, check_json(report, file.labels, names, nullptr, file.coordinates.metres), false),
        files);
    files.commit();
    say("{}: {}, {}, {}", printable(settings.output), counted(file.mesh.face_count(), "face"),
        counted(report.regions.size(), "region"), counted(report.violation_count(), "violation"));
    print_violations(report, 0);
    return kGood;
}

}  // namespace regionmesh::cli
