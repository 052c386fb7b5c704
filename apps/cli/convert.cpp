#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "output.h"
#include "printable.h"

namespace regionmesh::cli {

int run_convert(const Settings& given) {
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    const auto [names, colours] = describe(settings, file.names, file.colours);
    OutputFiles files(model_writing(settings));
    const auto written =
        write_model(settings, {file.mesh, file.labels, options.background, names, colours, file.space}, files);
    files.commit();
    print_region_files(settings, written);
    if (!settings.quiet)
        fmt::print("{}: {} faces, {} vertices\n", printable(settings.output), file.mesh.face_count(),
                   file.mesh.vertex_count());
    return kGood;
}

}  // namespace regionmesh::cli
