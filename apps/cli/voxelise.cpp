#include <fmt/core.h>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "printable.h"
#include "regionmesh/blocks.h"

namespace regionmesh::cli {

int run_voxelise(const Settings& given) {
    const std::string& path = given.models.front();
    require_writable(given.output, given.writing);
    const bool is_folder = is_block_folder(path);
    if (is_folder) require_fit_of_folder(path, given.surface);
    MeshFile file = is_folder ? describe_block_folder(path) : read_mesh(path, given.surface);
    const Settings settings = settings_for(given, file);
    VolumeInfo info = open_volume(settings, settings.sections)->info();
    const Lattice& lattice = info.lattice;
    const std::optional<double>& metres = file.coordinates.metres;
    warn_of_units(path, metres, settings.sections.front(), info.metres);
    VoxeliseOptions options{.lattice = lattice};
    for (const InputLabel label : settings.reconstruct.background)
        options.background.push_back(file.labels.dense(label));
    const auto writer = create_volume(settings.output, lattice, {info.space, info.metres ? info.metres : metres},
                                      info.type, settings.writing, file.labels.is_unsigned());
    std::vector<InputLabel> written(std::size_t{lattice.size[0]} * lattice.size[1]);
    const auto write = [&](std::span<const Label> section) {
        for (std::size_t n = 0; n < section.size(); ++n)
            written[n] = is_exterior(section[n]) ? settings.outside : file.labels.input(section[n]);
        writer->write(written);
    };
    std::uint64_t contradictions = 0;
    if (is_folder && has_lattice_of(path, info)) {
        info.sweep = options.sweep;
        contradictions = voxelise_block_folder(path, info, options.background, write);
    } else {
        if (is_folder) file.mesh = read_block_folder(path).mesh;
        Voxeliser voxeliser(file.mesh, options);
        std::vector<Label> section(written.size());
        while (voxeliser.next(section)) write(section);
        contradictions = voxeliser.contradictions();
    }
    if (contradictions != 0)
        throw Error(
            ErrorCode::kInput,
            fmt::format("{}: the surface contradicts itself at {} samples: it is not closed, or its faces cross or are "
                        "turned over; regionmesh check lists the places",
                        path, contradictions));
    writer->commit();
    if (!settings.quiet)
        fmt::print("{}: {} x {} x {} samples\n", printable(settings.output), lattice.size[0], lattice.size[1],
                   lattice.size[2]);
    return kGood;
}

}  // namespace regionmesh::cli
