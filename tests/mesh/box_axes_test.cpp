// Oblique models are changed in the axes of their box.
#include "regionmesh/box_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/improve.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/voxelise.h"
#include "support/in_single.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

constexpr test::Size kSize{14, 12, 13};
constexpr double kVolume = 13. * 11 * 12;

/// Turned about z, then about x. With one shear, as of a tilted gantry, the third axis leans toward the first; with two
/// the second one leans toward the third, so that no two sides are at right angles.
Lattice turned_lattice(int shears) {
    const double a = std::cos(0.3), b = std::sin(0.3), c = std::cos(1.1), d = std::sin(1.1);
    Lattice lattice{.size = kSize, .origin = {100, -20, 3}};
    lattice.direction = {a, -b, 0, c * b, c * a, -d, d * b, d * a, c};
    for (std::size_t row = 0; row < 9; row += 3) {
        double* const axes = &lattice.direction[row];
        if (shears > 0) axes[2] = 0.8 * axes[2] + 0.6 * axes[0];
        if (shears > 1) axes[1] = 0.8 * axes[1] + 0.6 * axes[2];
    }
    return lattice;
}

test::ArrayVolume turned_volume(int shears) {
    test::ArrayVolume volume = test::grain_volume(kSize, 5, 3);
    volume.lattice() = turned_lattice(shears);
    return volume;
}

Reconstruction model(CellKind cells, const std::vector<InputLabel>& background, int shears = 0) {
    return test::run(turned_volume(shears),
                     {.cells = cells, .smooth = {.passes = 0}, .decimate = false, .background = background});
}

/// The mesh as a file has it: with types of points, without sides, which are found again.
LabelledMesh from_file(const Reconstruction& made) {
    return import_arrays(export_arrays(made.mesh, made.labels, made.background));
}

std::vector<Label> dense(const LabelTable& labels, const std::vector<InputLabel>& background) {
    std::vector<Label> all;
    for (const InputLabel label : background) all.push_back(labels.find(label).value());
    return all;
}

std::vector<Vec3> positions(const Mesh& mesh) {
    std::vector<Vec3> all;
    test::for_vertices(mesh, [&](VertexId v) { all.push_back(mesh.position(v)); });
    return all;
}

double volume_of(const CheckReport& report) {
    double sum = 0;
    for (const RegionReport& region : report.regions) sum += region.volume;
    return sum;
}

/// Vertices on the sides lie on the planes of the lattice, the others inside.
void expect_in_box(const Mesh& mesh, int shears) {
    const IntoAxes into(turned_lattice(shears));
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
                     int shears) {
    Reconstruction made = model(cells, background, shears);
    LabelledMesh file = from_file(made);
    Mesh& mesh = is_read ? file.mesh : made.mesh;
    const std::uint32_t faces = mesh.face_count();
    const BoxAxes axes(mesh);
    EXPECT_TRUE(axes.is_oblique());
    EXPECT_NEAR(axes.volume_factor(), std::pow(0.8, shears), 1e-9);
    if (is_smoothed)
        smooth(mesh, {.filter = SmoothFilter::kTaubin, .passes = 10});
    else
        simplify(mesh, {.target_faces = faces / 10});
    EXPECT_LE(mesh.face_count(), is_smoothed ? faces : faces / 2);
    axes.restore(mesh);
    expect_in_box(mesh, shears);
    const CheckReport report = checked(mesh, dense(is_read ? file.labels : made.labels, background));
    if (background.empty()) {
        EXPECT_NEAR(volume_of(report), kVolume * std::pow(0.8, shears), 1e-9);
    }
}

TEST(BoxAxes, oblique_models_keep_their_box_when_they_are_simplified_or_smoothed) {
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra})
        for (const std::vector<InputLabel>& background : {std::vector<InputLabel>{}, std::vector<InputLabel>{0}})
            for (const bool is_smoothed : {false, true})
                for (const bool is_read : {false, true})
                    for (const int shears : {0, 1, 2}) expect_box_kept(cells, background, is_smoothed, is_read, shears);
}

TEST(BoxAxes, models_that_were_not_turned_are_refused_where_sides_would_be_lost) {
    Reconstruction made = model(CellKind::kCompact, {});
    const std::vector<Vec3> before = positions(made.mesh);
    const auto expect_refused = [](auto&& change) {
        try {
            change();
            ADD_FAILURE() << "not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kUsage);
            EXPECT_NE(std::string(error.what()).find("with BoxAxes"), std::string::npos) << error.what();
        }
    };
    expect_refused([&] { simplify(made.mesh, {.target_faces = 1}); });
    expect_refused([&] { improve(made.mesh, {}); });
    expect_refused([&] { smooth(made.mesh, {.filter = SmoothFilter::kTaubin}); });
    EXPECT_EQ(positions(made.mesh), before);
    Reconstruction straight = test::run(test::grain_volume(kSize, 5, 3));
    expect_refused([&] { simplify(straight.mesh, {.promises = {.samples = turned_lattice(0)}}); });
}

TEST(BoxAxes, what_is_read_gets_its_sides_and_keeps_its_position_until_it_moves) {
    for (const int shears : {0, 1, 2}) {
        const Reconstruction made = model(CellKind::kCompact, {0}, shears);
        LabelledMesh file = from_file(made);
        const MeshArrays before = export_arrays(made.mesh, made.labels, made.background);
        for (const bool is_turned : {false, true}) {
            if (is_turned) BoxAxes(file.mesh).restore(file.mesh);
            const MeshArrays after = export_arrays(file.mesh, file.labels, dense(file.labels, {0}));
            EXPECT_EQ(after.points, before.points);
            EXPECT_EQ(after.faces, before.faces);
            EXPECT_EQ(after.node_types, before.node_types);
        }
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

/// The lattice turned by quarters, mirrored, oblique and sheared.
std::vector<Lattice> turned_lattices() {
    std::vector<Lattice> lattices;
    for (const std::array<double, 9>& direction : {std::array<double, 9>{0, 1, 0, 1, 0, 0, 0, 0, 1},
                                                   {0, 0, 1, 1, 0, 0, 0, 1, 0},
                                                   {-1, 0, 0, 0, -1, 0, 0, 0, 1},
                                                   {0, 0, -1, 0, 1, 0, 1, 0, 0},
                                                   {1, 0, 0, 0, 1, 0, 0, 0, 1}})
        lattices.push_back(
            {.size = kSize, .spacing = {1, 1.2, 2.1}, .origin = {100.1, -20, 3}, .direction = direction});
    for (const int shears : {0, 1, 2}) lattices.push_back(turned_lattice(shears));
    return lattices;
}

TEST(BoxAxes, samples_of_any_lattice_are_kept) {
    for (const Lattice& lattice : turned_lattices())
        for (const std::vector<InputLabel>& background : {std::vector<InputLabel>{}, std::vector<InputLabel>{0}}) {
            test::ArrayVolume volume = test::grain_volume(kSize, 5, 3);
            volume.lattice() = lattice;
            Reconstruction made = test::run(volume, {.decimate = false, .background = background});
            const std::uint32_t faces = made.mesh.face_count();
            {
                const BoxAxes axes(made.mesh, lattice);
                ASSERT_TRUE(axes.samples());
                EXPECT_EQ(axes.is_oblique(), !lattice.is_axis_aligned());
                const SimplifyResult done =
                    simplify(made.mesh, {.target_faces = faces / 20, .promises = {.samples = axes.samples()}});
                EXPECT_GT(done.verdicts[static_cast<int>(Verdict::kSamples)], 0u);
                axes.restore(made.mesh);
            }
            EXPECT_LT(made.mesh.face_count(), faces / 2);
            checked(made.mesh, made.background);
            volume.rewind();
            EXPECT_EQ(compare_samples(made.mesh, made.labels, made.background, volume).wrong, 0u);
        }
}

TEST(BoxAxes, sides_are_those_of_the_axes_in_space_that_they_are_nearest_to) {
    for (const Lattice& lattice : turned_lattices()) {
        if (lattice.direction == turned_lattice(1).direction) break;  // sheared: normals are not along edges
        test::ArrayVolume volume = test::grain_volume(kSize, 5, 3);
        volume.lattice() = lattice;
        const Reconstruction made = test::run(volume);
        std::array<int, 6> faces{};
        test::for_faces(made.mesh, [&](FaceId f) {
            const auto [a, b, c] = made.mesh[f].vertices;
            const Label outer = made.mesh[f].labels[1];
            if (!is_exterior(outer)) return;
            const int side = side_of(outer);
            ++faces[static_cast<std::size_t>(side)];
            EXPECT_TRUE(made.mesh[a].sides & made.mesh[b].sides & made.mesh[c].sides & 1 << side);
            const auto p = made.mesh.corners(f);
            const Vec3 outward = cross(p[1] - p[0], p[2] - p[0]);
            const double along = side % 2 ? outward[side / 2] : -outward[side / 2];
            EXPECT_GT(along, 0.85 * length(outward)) << side;
        });
        for (const int count : faces) EXPECT_GT(count, 0);
    }
}

TEST(BoxAxes, parts_with_a_background_are_no_nested_bodies_when_they_are_read) {
    test::ArrayVolume volume = test::noise_volume(kSize, 3, 7);  // many parts, most of them on the hull
    volume.lattice() = turned_lattice(0);
    const Reconstruction made = test::run(volume, {.decimate = false, .background = {0}});
    const LabelledMesh file = from_file(made);
    checked(file.mesh, dense(file.labels, {0}));
}

TEST(BoxAxes, sides_stay_where_they_are_though_axes_of_few_digits_are_not_quite_square) {
    Lattice lattice = turned_lattice(0);
    for (double& entry : lattice.direction) entry = std::round(entry * 1e6) / 1e6;
    test::ArrayVolume volume = turned_volume(0);
    volume.lattice() = lattice;
    Reconstruction made = test::run(std::move(volume), {.smooth = {.passes = 0}, .decimate = false, .background = {}});
    const BoxAxes axes(made.mesh);
    ASSERT_TRUE(axes.is_oblique());
    simplify(made.mesh, {.target_faces = made.mesh.face_count() / 10});
    axes.restore(made.mesh);
    const IntoAxes into(lattice);
    test::for_faces(made.mesh, [&](FaceId f) {
        if (!is_exterior(made.mesh[f].labels[1])) return;
        for (const Vec3 p : made.mesh.corners(f)) {
            double nearest = 1;
            for (int axis = 0; axis < 3; ++axis)
                nearest = std::min({nearest, std::abs(into(p)[axis]), std::abs(into(p)[axis] - kSize[axis] + 1.)});
            EXPECT_LT(nearest, 1e-11);
        }
    });
}

TEST(BoxAxes, a_lattice_beside_the_mesh_turns_nothing) {
    Reconstruction made = model(CellKind::kCompact, {});
    const std::vector<Vec3> before = positions(made.mesh);
    Lattice other = turned_lattice(0);
    other.origin.x += 1;
    const BoxAxes axes(made.mesh, other);
    EXPECT_FALSE(axes.samples() || axes.is_oblique());
    EXPECT_EQ(positions(made.mesh), before);
}

TEST(BoxAxes, boxes_of_single_precision_are_found) {
    for (const int shears : {0, 1, 2}) {
        Reconstruction made = model(CellKind::kCompact, {}, shears);
        test::for_vertices(made.mesh, [&](VertexId v) {
            Vec3& p = made.mesh[v].position;
            for (int axis = 0; axis < 3; ++axis) p[axis] = test::in_single(p[axis]);
        });
        const BoxAxes axes(made.mesh);
        EXPECT_TRUE(axes.is_oblique());
    }
}

TEST(BoxAxes, slabs_of_single_precision_are_not_sheared) {
    // Background above and below: no face lies on the sides of the third axis, but slivers beside it have any normal.
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        constexpr test::Size kSlab{70, 50, 12};
        test::ArrayVolume volume = test::grain_volume(kSlab, 12, seed);
        std::vector<InputLabel> labels = volume.labels();
        const std::size_t section = kSlab[0] * kSlab[1];
        for (std::size_t n = 0; n < labels.size(); ++n) {
            const std::size_t x = n % kSlab[0], y = n / kSlab[0] % kSlab[1], z = n / section;
            const double low = 2 + std::sin(0.3 * double(x + seed)),
                         high = 9 + std::cos(0.2 * double(y) + 0.1 * double(x));
            labels[n] = double(z) < low || double(z) > high ? 0 : labels[n] + 1;
        }
        test::ArrayVolume slab(kSlab, labels);
        slab.lattice() = turned_lattice(0);
        slab.lattice().size = kSlab;
        slab.lattice().origin = {-283, 512, 77};
        Reconstruction made = test::run(std::move(slab), {.decimate = false, .background = {0}});
        test::for_vertices(made.mesh, [&](VertexId v) {
            Vec3& p = made.mesh[v].position;
            for (int axis = 0; axis < 3; ++axis) p[axis] = test::in_single(p[axis]);
        });
        LabelledMesh file = from_file(made);
        const BoxAxes axes(file.mesh);
        EXPECT_NEAR(axes.volume_factor(), 1, 1e-4) << "seed " << seed;
    }
}

/// Its three largest normals lie in one plane, and are those of no box.
Mesh hexagonal_bar() {
    std::vector<Vec3> positions;
    std::vector<test::ShapeFace> faces;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        faces.push_back({{a, b, c}, 0, exterior(0)});
    };
    for (std::uint32_t n = 0; n < 6; ++n) {
        for (const double height : {0., 30.})
            positions.push_back(
                {100 + 5 * std::cos(std::numbers::pi / 3 * n), height, -20 + 5 * std::sin(std::numbers::pi / 3 * n)});
        const std::uint32_t low = 2 * n, high = low + 1, next_low = (low + 2) % 12, next_high = next_low + 1;
        add(low, high, next_low);
        add(next_low, high, next_high);
        if (n == 0 || n == 5) continue;
        add(0, low, next_low);
        add(1, next_high, high);
    }
    return test::shape(positions, faces);
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
    Mesh bar = hexagonal_bar();
    BoxAxes(bar).restore(bar);
    EXPECT_EQ(positions(bar), positions(hexagonal_bar()));
    Mesh empty;
    EXPECT_FALSE(BoxAxes(empty).is_oblique());
}

}  // namespace
}  // namespace regionmesh
