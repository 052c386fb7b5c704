// A model that is written and read again is the model in memory, to the last bit.
#include <gtest/gtest.h>

#include <bit>

#include "formats/temporary_folder.h"
#include "regionmesh/compare.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/mesh_file.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

class ExactFiles : public TemporaryFolder {
protected:
    /// Compact cells, smoothed: positions that need all bits. The lattice has no simple numbers.
    static Reconstruction made(double reduce) {
        test::ArrayVolume volume = test::grain_volume({16, 15, 14}, 8, 3);
        volume.lattice().spacing = {0.3, 0.7, 1.1};
        volume.lattice().origin = {-91.3, 1e3 / 7, 5.1};
        Reconstruction result = test::run(volume, {.reduce = reduce, .background = {}});
        result.mesh.compact();
        return result;
    }
    MeshFile again(const Reconstruction& made, const std::string& extension) {
        write_mesh(made.mesh, made.labels, path("m" + extension));
        return read_mesh(path("m" + extension));
    }
};

std::array<std::uint64_t, 3> bits_of(Vec3 p) {
    return {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)};
}

std::array<double, 4> numbers_of(const DistanceStatistics& distance) {
    return {distance.rms, distance.mean, distance.max, distance.quantile_95};
}

TEST_F(ExactFiles, positions_and_measured_distances_are_those_in_memory) {
    const Reconstruction full = made(0), model = made(0.7);
    const CompareOptions options{.samples = 20000, .background = {}};
    const CompareReport expected = compare({full.mesh, full.labels}, {model.mesh, model.labels}, options);
    EXPECT_GT(expected.distance.both->rms, 0);
    for (const char* extension : {".vtp", ".vtu", ".ply", ".obj"}) {
        const MeshFile full_file = again(full, extension), file = again(model, extension);
        ASSERT_EQ(file.mesh.vertex_end(), model.mesh.vertex_end()) << extension;
        for (std::uint32_t v = 0; v < file.mesh.vertex_end(); ++v)
            ASSERT_EQ(bits_of(file.mesh.position(VertexId{v})), bits_of(model.mesh.position(VertexId{v})))
                << extension << " vertex " << v;
        EXPECT_EQ(file.mesh.face_count(), model.mesh.face_count());
        const CompareReport found = compare({full_file.mesh, full_file.labels}, {file.mesh, file.labels}, options);
        EXPECT_EQ(numbers_of(*found.distance.both), numbers_of(*expected.distance.both)) << extension;
        for (std::size_t n = 0; n < expected.regions.size(); ++n)
            EXPECT_EQ(numbers_of(*found.regions.at(n).distance.both), numbers_of(*expected.regions[n].distance.both))
                << extension;
    }
}

}  // namespace
}  // namespace regionmesh
