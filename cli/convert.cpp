#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "model_options.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string from, to;
    bool quiet = false;
    InputOptions input;
    ModelOptions model;
};

int convert_command(const Arguments& arguments) {
    require_writable_model(arguments.to);
    ModelFile file = arguments.model.read(arguments.from);
    WriteOptions options{.names = file.names};
    for (const InputLabel label : arguments.input.background_labels())
        options.background.push_back(file.labels.dense(label));
    write_model(file.model, file.labels, arguments.to, options);
    if (!arguments.quiet)
        fmt::print("{}: {} faces, {} vertices\n", arguments.to, file.model.face_count(), file.model.vertex_count());
    return 0;
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("convert", "a labelled surface from one format into another");
    command->add_option("from", arguments->from, kModelRead)->required();
    command->add_option("to", arguments->to, "model to write; the extension says how")->required();
    arguments->model.add_options(*command);
    arguments->input.add_background_options(*command);
    command->add_flag("--quiet", arguments->quiet, "no summary");
    command->callback([arguments, &action] { action = [arguments] { return convert_command(*arguments); }; });
}

}  // namespace regionmesh::cli
