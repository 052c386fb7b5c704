#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "output.h"

namespace regionmesh::cli {

int run_convert(const Settings& given) {
    require_outputs(given);
    MeshFile file = read_mesh(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    write_model(settings, file.mesh, file.labels, options.background, {names_or(settings, file.names), file.space});
    if (!settings.quiet)
        fmt::print("{}: {} faces, {} vertices\n", settings.output, file.mesh.face_count(), file.mesh.vertex_count());
    return kGood;
}

}  // namespace regionmesh::cli
