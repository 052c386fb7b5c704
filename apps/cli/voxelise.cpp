#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "mesh_options.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string mesh, output, outside = "0";
    std::vector<std::string> like;
    bool quiet = false;
    InputOptions input;
    MeshOptions reading;
};

int voxelise_command(const Arguments& arguments) {
    MeshFile file = arguments.reading.read(arguments.mesh);
    const VolumeInfo info = arguments.input.open(arguments.like)->info();
    VoxeliseOptions options{.lattice = info.lattice};
    for (const InputLabel label : arguments.input.background_labels())
        options.background.push_back(file.labels.dense(label));
    const auto outside = static_cast<InputLabel>(parse_number("--outside", arguments.outside));
    Voxeliser voxeliser(file.mesh, options);
    const auto writer = create_volume(arguments.output, info.lattice, info.type);
    std::vector<Label> section(std::size_t{info.lattice.size[0]} * info.lattice.size[1]);
    std::vector<InputLabel> written(section.size());
    while (voxeliser.next(section)) {
        for (std::size_t n = 0; n < section.size(); ++n)
            written[n] = is_exterior(section[n]) ? outside : file.labels.input(section[n]);
        writer->write(written);
    }
    if (voxeliser.contradictions() != 0)
        throw Error(ErrorCode::kInput,
                    fmt::format("{}: the surface contradicts itself at {} samples: it is not closed there; "
                                "regionmesh check says where",
                                arguments.mesh, voxeliser.contradictions()));
    writer->commit();
    if (!arguments.quiet)
        fmt::print("{}: {} x {} x {} samples\n", arguments.output, info.lattice.size[0], info.lattice.size[1],
                   info.lattice.size[2]);
    return 0;
}

}  // namespace

void add_voxelise(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("voxelise", "writes the label of each sample: the inverse of reconstruct");
    command->add_option("model", arguments->mesh, kMeshRead)->required();
    arguments->reading.add_options(*command);
    command->add_option("--like", arguments->like, "volume whose lattice and type of samples the labels get")
        ->required();
    arguments->input.add_volume_options(*command);
    arguments->input.add_background_options(*command);
    command->add_option("-o,--output", arguments->output, "labels to write: .npy .nii .nii.gz .nrrd .raw")->required();
    command->add_option("--outside", arguments->outside, "label of samples in no region; 0 if not given");
    command->add_flag("--quiet", arguments->quiet, "no summary");
    command->callback([arguments, &action] { action = [arguments] { return voxelise_command(*arguments); }; });
}

}  // namespace regionmesh::cli
