// Some labels of a volume at half the resolution, without specks: select VOLUME MODEL FIRST LAST
#include <regionmesh/formats.h>
#include <regionmesh/regionmesh.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: select VOLUME MODEL.vtp FIRST_LABEL LAST_LABEL\n");
        return 2;
    }
    try {
        const regionmesh::Selection selection{
            .labels = {{std::atoll(argv[3]), std::atoll(argv[4])}}, .downsample = {2, 2, 2}, .min_region = 2};
        const auto reader = regionmesh::open_sections({argv[1]}, {.select = selection});
        const auto made = regionmesh::reconstruct(*reader, {.reduce = 0.5});
        regionmesh::write_mesh(made.mesh, made.labels, argv[2],
                               {.background = made.background, .names = reader->info().names});
        std::printf("%llu faces\n", static_cast<unsigned long long>(made.report.final_faces));
        return made.report.check.violation_count() == 0 ? 0 : 3;
    } catch (const regionmesh::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
