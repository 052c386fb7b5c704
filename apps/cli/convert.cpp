#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "output.h"
#include "printable.h"

namespace regionmesh::cli {

int run_convert(const Settings& settings) {
    require_outputs(settings);
    MeshFile file = read_mesh(settings.models.front(), settings.surface);
    const CheckOptions options = check_options(settings, file.labels);
    OutputFiles files(settings.writing);
    write_model(settings, {file.mesh, file.labels, options.background, names_or(settings, file.names)}, files);
    files.commit();
    if (!settings.quiet)
        fmt::print("{}: {} faces, {} vertices\n", printable(settings.output), file.mesh.face_count(),
                   file.mesh.vertex_count());
    return kGood;
}

}  // namespace regionmesh::cli
