// Oblique models are changed in the axes of their box.
#include "regionmesh/box_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "regionmesh/check.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

constexpr test::Size kSize{14, 12, 13};
constexpr double kVolume = 13. * 11 * 12;

/// Turned about z, then about x. Sheared as by a tilted gantry, the third axis leans toward the first.
Lattice turned_lattice(bool is_sheared) {
    const double a = std::cos(0.3), b = std::sin(0.3), c = std::cos(1.1), d = std::sin(1.1);
    Lattice lattice{.size = kSize, .origin = {100, -20, 3}};
    lattice.direction = {a, -b, 0, c * b, c * a, -d, d * b, d * a, c};
    if (is_sheared)
        for (std::size_t row = 0; row < 9; row += 3)
            lattice.direction[row + 2] = 0.8 * lattice.direction[row + 2] + 0.6 * lattice.direction[row];
    return lattice;
}

test::ArrayVolume turned_volume(bool is_sheared) {
    test::ArrayVolume volume = test::grain_volume(kSize, 5, 3);
    volume.lattice() = turned_lattice(is_sheared);
    return volume;
}

Reconstruction model(CellKind cells, const std::vector<InputLabel>& background, bool is_sheared = false) {
    return test::run(turned_volume(is_sheared),
                     {.cells = cells, .smooth = {.passes = 0}, .decimate = false, .background = background});
}

/// The mesh as a file has it: with types of points, without sides.
LabelledMesh from_file(const Reconstruction& made) {
    return import_arrays(export_arrays(made.mesh, made.labels, made.background));
}

std::vector<Label> dense(const LabelTable& labels, const std::vector<InputLabel>& background) {
    std::vector<Label> all;
    for (const InputLabel label : background) all.push_back(labels.find(label).value());
    return all;
}

double volume_of(const CheckReport& report) {
    double sum = 0;
    for (const RegionReport& region : report.regions) sum += region.volume;
    return sum;
}

/// Vertices on the sides lie on the planes of the lattice, the others inside.
void expect_in_box(const Mesh& mesh, bool is_sheared) {
    const IntoAxes into(turned_lattice(is_sheared));
    test::for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = into(mesh.position(v));
        for (int axis = 0; axis < 3; ++axis) {
            const double high = kSize[static_cast<std::size_t>(axis)] - 1.0;
            EXPECT_GE(p[axis], -1e-12);
            EXPECT_LE(p[axis], high + 1e-12);
        }
    });
}

CheckReport checked(const Mesh& mesh, const std::vector<Label>& background) {
    CheckOptions options;
    options.background = background;
    CheckReport report = check(mesh, options);
    test::expect_sound(report);
    return report;
}

void expect_box_kept(CellKind cells, const std::vector<InputLabel>& background, bool is_smoothed, bool is_read,
                     bool is_sheared) {
    Reconstruction made = model(cells, background, is_sheared);
    LabelledMesh file = from_file(made);
    Mesh& mesh = is_read ? file.mesh : made.mesh;
    const std::uint32_t faces = mesh.face_count();
    const BoxAxes axes(mesh);
    EXPECT_TRUE(axes.is_oblique());
    if (is_smoothed)
        smooth(mesh, {.filter = SmoothFilter::kTaubin, .passes = 10});
    else
        simplify(mesh, {.target_faces = faces / 10});
    EXPECT_LE(mesh.face_count(), is_smoothed ? faces : faces / 2);
    axes.restore(mesh);
    expect_in_box(mesh, is_sheared);
    const CheckReport report = checked(mesh, dense(is_read ? file.labels : made.labels, background));
    if (background.empty()) {
        EXPECT_NEAR(volume_of(report), kVolume * (is_sheared ? 0.8 : 1), 1e-9);
    }
}

TEST(BoxAxes, oblique_models_keep_their_box_when_they_are_simplified_or_smoothed) {
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra})
        for (const std::vector<InputLabel>& background : {std::vector<InputLabel>{}, std::vector<InputLabel>{0}})
            for (const bool is_smoothed : {false, true})
                for (const bool is_read : {false, true})
                    for (const bool is_sheared : {false, true})
                        expect_box_kept(cells, background, is_smoothed, is_read, is_sheared);
}

TEST(BoxAxes, what_does_not_move_keeps_its_position_and_gets_its_sides) {
    for (const bool is_sheared : {false, true}) {
        const Reconstruction made = model(CellKind::kCompact, {0}, is_sheared);
        LabelledMesh file = from_file(made);
        const MeshArrays before = export_arrays(made.mesh, made.labels, made.background);
        const BoxAxes axes(file.mesh);
        axes.restore(file.mesh);
        const MeshArrays after = export_arrays(file.mesh, file.labels, dense(file.labels, {0}));
        EXPECT_EQ(after.points, before.points);
        EXPECT_EQ(after.faces, before.faces);
        EXPECT_EQ(after.node_types, before.node_types);
    }
}

TEST(BoxAxes, what_stays_when_others_go_keeps_its_position) {
    Reconstruction made = model(CellKind::kCompact, {});
    std::set<std::array<double, 3>> before;
    const auto key = [](Vec3 p) { return std::array{p.x, p.y, p.z}; };
    test::for_vertices(made.mesh, [&](VertexId v) { before.insert(key(made.mesh.position(v))); });
    const BoxAxes axes(made.mesh);
    simplify(made.mesh, {.target_faces = made.mesh.face_count() * 9 / 10});
    axes.restore(made.mesh);
    std::size_t same = 0;
    test::for_vertices(made.mesh, [&](VertexId v) { same += before.contains(key(made.mesh.position(v))); });
    EXPECT_GT(same, made.mesh.vertex_count() * 8 / 10);
}

TEST(BoxAxes, boxes_of_single_precision_are_found) {
    for (const bool is_sheared : {false, true}) {
        Reconstruction made = model(CellKind::kCompact, {}, is_sheared);
        test::for_vertices(made.mesh, [&](VertexId v) {
            Vec3& p = made.mesh[v].position;
            for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(p[axis]);
        });
        const BoxAxes axes(made.mesh);
        EXPECT_TRUE(axes.is_oblique());
    }
}

TEST(BoxAxes, other_models_are_left_alone) {
    test::ArrayVolume volume = test::grain_volume(kSize, 5, 3);
    Reconstruction straight = test::run(volume);
    const MeshArrays before = export_arrays(straight.mesh, straight.labels, {});
    EXPECT_FALSE(BoxAxes(straight.mesh).is_oblique());
    EXPECT_EQ(export_arrays(straight.mesh, straight.labels, {}).points, before.points);
    Mesh octahedron;
    test::add_octahedron(octahedron, {}, {1, 1, 1}, 0, exterior(0));
    EXPECT_FALSE(BoxAxes(octahedron).is_oblique());
    Mesh empty;
    EXPECT_FALSE(BoxAxes(empty).is_oblique());
}

}  // namespace
}  // namespace regionmesh
