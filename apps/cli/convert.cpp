#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "mesh_options.h"
#include "output_options.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string from;
    bool quiet = false;
    InputOptions input;
    MeshOptions mesh;
    OutputOptions output;
};

int convert_command(const Arguments& arguments) {
    arguments.output.require_writable(false);
    MeshFile file = arguments.mesh.read(arguments.from);
    std::vector<Label> background;
    for (const InputLabel label : arguments.input.background_labels()) background.push_back(file.labels.dense(label));
    arguments.output.write(file.mesh, file.labels, background, arguments.output.names_or(file.names));
    if (!arguments.quiet)
        fmt::print("{}: {} faces, {} vertices\n", arguments.output.path, file.mesh.face_count(),
                   file.mesh.vertex_count());
    return 0;
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("convert", "a labelled surface from one format into another");
    command->add_option("from", arguments->from, kMeshRead)->required();
    command->add_option("to", arguments->output.path, kMeshWritten)->required();
    arguments->output.add_content_options(*command);
    arguments->mesh.add_options(*command);
    arguments->input.add_background_options(*command);
    command->add_flag("--quiet", arguments->quiet, "no summary");
    command->callback([arguments, &action] { action = [arguments] { return convert_command(*arguments); }; });
}

}  // namespace regionmesh::cli
