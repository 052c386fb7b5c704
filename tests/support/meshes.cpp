#include "support/meshes.h"

#include <algorithm>
#include <numeric>

#include "cells/kuhn.h"
#include "support/random.h"

namespace regionmesh::test {
namespace {

/// Samples along each axis as points, x fastest.
std::vector<Vec3> lattice_points(const ArrayVolume& volume) {
    const Lattice& lattice = volume.info().lattice;
    std::vector<Vec3> points;
    for (std::uint32_t z = 0; z < lattice.size[2]; ++z)
        for (std::uint32_t y = 0; y < lattice.size[1]; ++y)
            for (std::uint32_t x = 0; x < lattice.size[0]; ++x)
                points.push_back(lattice.origin +
                                 Vec3{x * lattice.spacing.x, y * lattice.spacing.y, z * lattice.spacing.z});
    return points;
}

/// Kuhn's chains follow the axes of the sweep, as the strips of sections do; these are those of the sweep along z.
std::vector<LabelledTetrahedron> lattice_tetrahedra(const ArrayVolume& volume) {
    const auto& size = volume.size();
    const auto point = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return (z * size[1] + y) * size[0] + x;
    };
    std::vector<LabelledTetrahedron> tetrahedra;
    for (std::uint32_t z = 0; z + 1 < size[2]; ++z)
        for (std::uint32_t y = 0; y + 1 < size[1]; ++y)
            for (std::uint32_t x = 0; x + 1 < size[0]; ++x)
                for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) {
                    LabelledTetrahedron made{{}, volume.at(x, y, z)};
                    for (int n = 0; n < 4; ++n) {
                        const Step step = kKinds[kind].steps[n];
                        made.corners[n] = point(x + (step & 1), y + (step >> 1 & 1), z + (step >> 2 & 1));
                    }
                    tetrahedra.push_back(made);
                }
    return tetrahedra;
}

}  // namespace

ArrayMesh::ArrayMesh(LabelledPoints points, std::vector<LabelledTetrahedron> tetrahedra)
    : info_{.source = "mesh", .format = "array", .has_cell_labels = points.labels.empty()},
      points_(std::move(points)),
      tetrahedra_(std::move(tetrahedra)) {}

std::size_t ArrayMesh::next(std::span<LabelledTetrahedron> tetrahedra) {
    const std::size_t count = std::min(tetrahedra.size(), tetrahedra_.size() - next_);
    std::copy_n(tetrahedra_.begin() + static_cast<std::ptrdiff_t>(next_), count, tetrahedra.begin());
    next_ += count;
    return count;
}

ArrayMesh ArrayMesh::shuffled(std::uint64_t seed) const {
    Random random(seed);
    const auto shuffle = [&](auto& items) {
        for (std::size_t n = items.size(); n > 1; --n) std::swap(items[n - 1], items[random.below(n)]);
    };
    std::vector<std::uint32_t> order(points_.positions.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0u);
    shuffle(order);
    LabelledPoints points;
    for (std::uint32_t n = 0; n < order.size(); ++n) {
        place[order[n]] = n;
        points.positions.push_back(points_.positions[order[n]]);
        if (!points_.labels.empty()) points.labels.push_back(points_.labels[order[n]]);
    }
    std::vector<LabelledTetrahedron> tetrahedra = tetrahedra_;
    for (LabelledTetrahedron& t : tetrahedra) {
        for (std::uint32_t& corner : t.corners) corner = place[corner];
        shuffle(t.corners);
    }
    shuffle(tetrahedra);
    return {std::move(points), std::move(tetrahedra)};
}

ArrayMesh& ArrayMesh::scaled(double scale_z) {
    for (Vec3& p : points_.positions) p.z *= scale_z;
    info_.scale_z = scale_z;
    return *this;
}

ArrayMesh mesh_of(const ArrayVolume& volume) {
    return {{lattice_points(volume), volume.labels()}, lattice_tetrahedra(volume)};
}

ArrayMesh cell_mesh_of(const ArrayVolume& volume) { return {{lattice_points(volume), {}}, lattice_tetrahedra(volume)}; }

ArrayMesh bent_mesh(Size size, std::uint32_t label_count, std::uint64_t seed) {
    const ArrayVolume volume = grain_volume(size, label_count, seed);
    Random random(seed + 1);
    std::vector<Vec3> points = lattice_points(volume);
    for (Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] += 0.24 * (random.unit() - 0.5);
    return {{std::move(points), volume.labels()}, lattice_tetrahedra(volume)};
}

ArrayMesh by_cells(const ArrayMesh& mesh) {
    std::vector<LabelledTetrahedron> tetrahedra = mesh.tetrahedra();
    for (LabelledTetrahedron& t : tetrahedra) t.label = mesh.points().labels[t.corners[0]];
    return {{mesh.points().positions, {}}, std::move(tetrahedra)};
}

ArrayMesh carved(const ArrayMesh& mesh, Size size, const KeepsCell& keeps) {
    std::vector<LabelledTetrahedron> kept;
    for (std::size_t n = 0; n < mesh.tetrahedra().size(); ++n) {
        const auto cell = static_cast<std::uint32_t>(n / 6), width = size[0] - 1, height = size[1] - 1;
        if (keeps(cell % width, cell / width % height, cell / width / height)) kept.push_back(mesh.tetrahedra()[n]);
    }
    return {mesh.points(), std::move(kept)};
}

}  // namespace regionmesh::test
