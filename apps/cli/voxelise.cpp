#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "printable.h"

namespace regionmesh::cli {

int run_voxelise(const Settings& given) {
    const std::string& path = given.models.front();
    require_writable(given.output, given.writing);
    MeshFile file = read_model(path, given.surface);
    const Settings settings = settings_for(given, file);
    const VolumeInfo info =
        open_sections({settings.sections.begin(), settings.sections.end()}, settings.volume)->info();
    const Lattice& lattice = info.lattice;
    VoxeliseOptions options{.lattice = lattice};
    for (const InputLabel label : settings.reconstruct.background)
        options.background.push_back(file.labels.dense(label));
    Voxeliser voxeliser(file.mesh, options);
    const auto writer = create_volume(settings.output, lattice, info.type, settings.writing);
    std::vector<Label> section(std::size_t{lattice.size[0]} * lattice.size[1]);
    std::vector<InputLabel> written(section.size());
    while (voxeliser.next(section)) {
        for (std::size_t n = 0; n < section.size(); ++n)
            written[n] = is_exterior(section[n]) ? settings.outside : file.labels.input(section[n]);
        writer->write(written);
    }
    if (voxeliser.contradictions() != 0)
        throw Error(ErrorCode::kInput,
                    fmt::format("{}: the surface is not closed: it contradicts itself at {} samples; regionmesh check "
                                "lists the places",
                                path, voxeliser.contradictions()));
    writer->commit();
    if (!settings.quiet)
        fmt::print("{}: {} x {} x {} samples\n", printable(settings.output), lattice.size[0], lattice.size[1],
                   lattice.size[2]);
    return kGood;
}

}  // namespace regionmesh::cli
