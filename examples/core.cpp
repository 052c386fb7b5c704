// Arrays in, arrays out, no file: reconstructs two regions in a box, simplifies the mesh further, and checks it.
#include <regionmesh/regionmesh.h>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
    // A volume of 24 x 20 x 16 samples, x fastest: a ball of label 7 in label -2.
    const regionmesh::ArraySize size{24, 20, 16};
    std::vector<std::int16_t> samples;
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x) {
                const int dx = x - 11, dy = y - 9, dz = z - 7;
                samples.push_back(dx * dx + dy * dy + dz * dz < 36 ? 7 : -2);
            }
    try {
        const auto reader =
            regionmesh::open_array(regionmesh::label_array(samples.data(), size), {.spacing = {1, 1, 1.5}});
        const auto made = regionmesh::reconstruct(*reader, {.reduce = 0.5, .background = {}});
        const regionmesh::MeshArrays arrays = regionmesh::export_arrays(made.mesh, made.labels);

        // Any labelled triangles can come in this way.
        regionmesh::LabelledMesh other = regionmesh::import_arrays(arrays);
        const auto target = static_cast<std::uint32_t>(arrays.faces.size() / 2);
        regionmesh::simplify(other.mesh, {.target_faces = target});
        const regionmesh::MeshArrays fewer = regionmesh::export_arrays(other.mesh, other.labels);
        const regionmesh::CheckReport report = regionmesh::check(other.mesh);
        std::printf("%zu faces, then %zu; %llu violations\n", arrays.faces.size(), fewer.faces.size(),
                    static_cast<unsigned long long>(report.violation_count()));
        for (const regionmesh::RegionReport& region : report.regions)
            std::printf("region %s: volume %g, area %g\n", other.labels.text(other.labels.input(region.label)).c_str(),
                        region.volume, region.area);
        const bool is_good = made.report.check.violation_count() == 0 && report.violation_count() == 0 &&
                             report.regions.size() == 2 && fewer.faces.size() <= target && !fewer.faces.empty();
        return is_good ? 0 : 3;
    } catch (const regionmesh::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
