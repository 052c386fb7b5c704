// Sections in, a model of a tenth of the faces out: reconstruct VOLUME MODEL
#include <regionmesh/formats.h>
#include <regionmesh/regionmesh.h>

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: reconstruct VOLUME MODEL.vtp\n");
        return 2;
    }
    try {
        const auto reader = regionmesh::open_sections({argv[1]});
        const auto made = regionmesh::reconstruct(*reader, {.reduce = 0.9});
        regionmesh::write_mesh(made.mesh, made.labels, argv[2],
                               {.background = made.background,
                                .names = reader->info().names,
                                .coordinates = coordinates_of(reader->info())});
        for (const auto& region : made.report.check.regions)
            std::printf("region %s: volume %g, area %g\n", made.labels.text(made.labels.input(region.label)).c_str(),
                        region.volume, region.area);
        return made.report.check.violation_count() == 0 ? 0 : 3;
    } catch (const regionmesh::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
