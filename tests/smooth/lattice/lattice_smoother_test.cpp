#include "smooth/lattice/lattice_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/hash.h"
#include "regionmesh/error.h"
#include "support/cone_chunks.h"
#include "support/crossings.h"
#include "support/digest.h"
#include "support/lattice_simplices.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

LatticeFrame frame_of(const test::ArrayVolume& volume) {
    return {volume.info().lattice.origin, volume.info().lattice.spacing};
}

ChunkOrder order_of(const test::ArrayVolume& volume) {
    return {.axis = 2, .thickness = volume.info().lattice.spacing.z, .frame = frame_of(volume)};
}

/// The chunks, smoothed one after the other.
std::vector<Chunk> streamed(const std::vector<Chunk>& chunks, const ChunkOrder& order, std::uint32_t threads = 1) {
    LatticeSmoother smoother({.filter = SmoothFilter::kLattice, .threads = threads}, order);
    std::vector<Chunk> result;
    Chunk done;
    for (std::uint32_t n = 0; n < chunks.size(); ++n) {
        const double next_low = order.frame.origin.z + (n + 1) * order.thickness;
        EXPECT_TRUE(smoother.add(chunks[n], n + 1 == chunks.size(), next_low));
        EXPECT_LE(n + 1 - result.size(), smoother.most_chunks());
        while (smoother.next(done)) result.push_back(done);
    }
    return result;
}

Mesh smoothed(const test::ArrayVolume& volume, std::uint32_t threads = 1) {
    return test::mesh_of(streamed(test::cone_chunks(volume), order_of(volume), threads));
}

std::vector<Vec3> positions_of(const Mesh& mesh) {
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) positions.push_back(mesh.position(VertexId{v}));
    return positions;
}

using Distance = std::function<double(Vec3)>;

test::ArrayVolume sampled(test::Size size, Vec3 spacing, const Distance& distance) {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x)
                labels.push_back(distance({x * spacing.x, y * spacing.y, z * spacing.z}) < 0);
    test::ArrayVolume volume(size, std::move(labels));
    volume.lattice().spacing = spacing;
    return volume;
}

struct Deviation {
    double rms = 0, degrees = 0;  // area-weighted; inside the box only
};

/// Requires a distance of gradient 1. Faces that are farther away than `farthest` are of other surfaces.
Deviation error_of(const Mesh& mesh, const Distance& distance, double low, double high, double farthest = HUGE_VAL) {
    Deviation error;
    double areas = 0;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const auto p = mesh.corners(FaceId{f});
        const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
        bool is_inside = true;
        for (int axis = 0; axis < 3; ++axis) is_inside &= middle[axis] > low && middle[axis] < high;
        if (!is_inside || is_exterior(mesh[FaceId{f}].labels[1]) || std::abs(distance(middle)) > farthest) continue;
        const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
        const double area = length(normal), far = distance(middle);
        Vec3 slope;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 step;
            step[axis] = 1e-5;
            slope[axis] = (distance(middle + step) - distance(middle - step)) / 2e-5;
        }
        const double cosine = std::min(1.0, std::abs(dot(normal, slope)) / (area * length(slope)));
        error.degrees += area * std::acos(cosine) * 180 / std::acos(-1.0);
        error.rms += area * far * far;
        areas += area;
    }
    return {std::sqrt(error.rms / areas), error.degrees / areas};
}

TEST(LatticeFilter, makes_round_what_is_round) {
    const Distance ball = [](Vec3 p) { return length(p - Vec3{15.3, 15.7, 16.1}) - 11.2; };
    auto fine = sampled({32, 32, 32}, {1, 1, 1}, ball), coarse = sampled({32, 32, 8}, {1, 1, 5}, ball);
    const Deviation at_1 = error_of(smoothed(fine), ball, 0.5, 31);
    EXPECT_LT(at_1.degrees, 2);
    EXPECT_LT(at_1.rms, 0.06);
    const Deviation at_5 = error_of(smoothed(coarse), ball, 0.5, 31);
    EXPECT_LT(at_5.degrees, 9);
    EXPECT_LT(at_5.rms, 0.35);
}

/// The rim of a cap, which lies in the last section that meets a region, must not draw the cap onto this section.
TEST(LatticeFilter, keeps_caps_off_the_last_section) {
    const Distance torus = [](Vec3 p) { return std::hypot(std::hypot(p.x - 19.4, p.y - 19.1) - 12, p.z - 13.6) - 4; };
    const Distance ball = [](Vec3 p) { return length(p - Vec3{15.4, 15.4, 16.4}) - 6; };
    auto ring = sampled({39, 39, 10}, {1, 1, 3}, torus), far = sampled({32, 32, 7}, {1, 1, 5}, ball);
    const Deviation of_ring = error_of(smoothed(ring), torus, 0.5, 38),
                    of_ball = error_of(smoothed(far), ball, 0.5, 31);
    EXPECT_LT(of_ring.degrees, 13);
    EXPECT_LT(of_ring.rms, 0.6);
    EXPECT_LT(of_ball.degrees, 16);
    EXPECT_LT(of_ball.rms, 0.6);
}

TEST(LatticeFilter, makes_plane_what_is_plane) {
    for (Vec3 normal : {Vec3{.31, .17, .93}, Vec3{.1, .07, 1}, Vec3{.8, .55, .12}}) {
        normal = normal / length(normal);
        const Distance plane = [&](Vec3 p) { return dot(p - Vec3{15.3, 15.7, 16.1}, normal); };
        auto volume = sampled({32, 32, 32}, {1, 1, 1}, plane);
        const Deviation error = error_of(smoothed(volume), plane, 4, 27);
        EXPECT_LT(error.degrees, 0.6);
        EXPECT_LT(error.rms, 0.02);
    }
}

Distance cube(Vec3 centre, double half, const std::array<Vec3, 3>& axes) {
    return [=](Vec3 p) {
        double farthest = 0;
        for (const Vec3& axis : axes) farthest = std::max(farthest, std::abs(dot(p - centre, axis)));
        return farthest - half;
    };
}

/// Noise near a surface changes single samples, which no fit has to pass.
TEST(LatticeFilter, finds_the_surface_behind_stray_labels) {
    const Vec3 normal = Vec3{.31, .17, .93} / length(Vec3{.31, .17, .93});
    const Distance plane = [&](Vec3 p) { return dot(p - Vec3{23.3, 23.7, 23.1}, normal); };
    const Distance noisy = [&](Vec3 p) {
        const double d = plane(p);
        const auto sample = static_cast<std::uint32_t>(p.x + 48 * (p.y + 48 * p.z));
        return std::abs(d) < 1.5 && hash_unit(sample, 1) < 0.01 ? -d : d;
    };
    auto volume = sampled({48, 48, 48}, {1, 1, 1}, noisy);
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra}) {
        const Mesh mesh = test::run(volume, {.cells = cells, .decimate = false, .background = {}}).mesh;
        const Deviation error = error_of(mesh, plane, 4, 43);
        EXPECT_LT(error.degrees, 6);
    }
}

/// What lies beside an edge is no part of the surface on the other side of it.
TEST(LatticeFilter, leaves_the_faces_of_a_cube_plane) {
    const Vec3 centre{23.5, 23.5, 23.5};
    auto volume = sampled({48, 48, 48}, {1, 1, 1}, cube(centre, 16, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
    const Mesh mesh = test::run(volume, {.decimate = false, .background = {}}).mesh;
    int inner = 0;
    for (const Vec3& at : positions_of(mesh)) {
        const Vec3 d{std::abs(at.x - centre.x), std::abs(at.y - centre.y), std::abs(at.z - centre.z)};
        if (d.z > 17 || d.z < 15 || std::max(d.x, d.y) > 10) continue;
        EXPECT_NEAR(d.z, 16, 0.01) << "at " << at.x << ' ' << at.y;
        ++inner;
    }
    EXPECT_GT(inner, 500);
}

TEST(LatticeFilter, keeps_edges) {
    const Distance turned = cube({15.6, 15.6, 15.6}, 10.2,
                                 {{{2. / 3, 1. / 3, 2. / 3}, {-2. / 3, 2. / 3, 1. / 3}, {1. / 3, 2. / 3, -2. / 3}}});
    const Distance rod = [](Vec3 p) {
        return std::max(std::hypot(p.x - 15.3, p.y - 15.6) - 9.2, std::abs(p.z - 15.5) - 10);
    };
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra}) {
        const auto error = [&](const Distance& shape) {
            auto volume = sampled({32, 32, 32}, {1, 1, 1}, shape);
            return error_of(test::run(volume, {.cells = cells, .decimate = false, .background = {}}).mesh, shape, 0.5,
                            31);
        };
        EXPECT_LT(error(turned).degrees, 4.8);
        EXPECT_LT(error(rod).degrees, 5);
    }
}

/// Other surfaces between the same two regions that face the same way are no part of a plane.
TEST(LatticeFilter, makes_plane_what_is_plane_beside_other_sheets) {
    const auto expect_plane = [](const Distance& volume, const Distance& plane, double farthest) {
        const Mesh mesh =
            test::run(sampled({32, 32, 32}, {1, 1, 1}, volume), {.decimate = false, .background = {}}).mesh;
        const Deviation error = error_of(mesh, plane, 4, 27, farthest);
        EXPECT_LT(error.degrees, 0.4);
        EXPECT_LT(error.rms, 0.02);
    };
    for (Vec3 normal : {Vec3{.31, .17, .93}, Vec3{.08, .03, 1}}) {
        normal = normal / length(normal);
        const Distance plane = [&](Vec3 p) { return dot(p - Vec3{15.3, 15.7, 10.6}, normal); };
        for (const double upper : {9, 16}) {
            const Distance layers = [&](Vec3 p) {
                const double height = plane(p);
                return height > upper - 3 ? height - upper : height;
            };
            expect_plane(layers, plane, (upper - 3) / 2);
        }
        for (const double z : {5, 17}) {  // a sample of the other region below the plane, and one above it
            const Distance spotted = [&](Vec3 p) { return length(p - Vec3{15, 15, z}) < 0.5 ? -plane(p) : plane(p); };
            expect_plane(spotted, plane, 2);
        }
    }
}

/// The same simplex as before smoothing, and inside it.
void expect_inside(const std::vector<Vec3>& before, const std::vector<Vec3>& after, const LatticeFrame& frame,
                   double margin) {
    ASSERT_EQ(before.size(), after.size());
    for (std::uint32_t v = 0; v < before.size(); ++v) {
        const LatticeSimplex simplex = test::simplex_at(before[v], frame);
        // Offsets along the chain of steps: differences of them are the weights.
        const Vec3 at = after[v];
        std::array<double, 4> offset{1, 0, 0, 0};
        const SimplexKind& kind = kKinds[simplex.kind];
        for (int n = 1; n < kind.node_count; ++n) {
            const int fresh = kind.steps[n] & ~kind.steps[n - 1];
            for (int axis = 0; axis < 3; ++axis)
                if (fresh >> axis & 1)
                    offset[n] = (at[axis] - frame.origin[axis]) / frame.spacing[axis] - simplex.base[axis];
        }
        for (int n = 0; n < kind.node_count; ++n) {
            const double weight = offset[n] - (n + 1 < kind.node_count ? offset[n + 1] : 0);
            EXPECT_GE(weight, margin - 2e-6);
        }
    }
}

/// Fits near a side have samples on one side only; they must not be lost.
TEST(LatticeFilter, makes_plane_what_is_plane_up_to_the_sides_of_the_box) {
    const Vec3 normal = Vec3{0.3, 0.5, 0.8} / length(Vec3{0.3, 0.5, 0.8});
    const Distance plane = [&](Vec3 p) { return dot(p - Vec3{15.3, 15.7, 16.1}, normal); };
    const Mesh mesh = smoothed(sampled({32, 32, 32}, {1, 1, 1}, plane));
    const Deviation error = error_of(mesh, plane, -1, 32);
    EXPECT_LT(error.rms, 0.04);
    EXPECT_LT(error.degrees, 0.5);
}

TEST(LatticeFilter, keeps_vertices_in_their_simplices_and_the_model_sound) {
    const LatticeFrame frame{{-7.3, 100.1, 0.7}, {0.7, 1.3, 5.1}};
    test::ArrayVolume volumes[] = {test::noise_volume({7, 7, 7}, 2, 1), test::noise_volume({7, 7, 7}, 5, 2),
                                   test::grain_volume({14, 14, 14}, 12, 3)};
    for (test::ArrayVolume& volume : volumes) {
        volume.lattice().spacing = frame.spacing;
        volume.lattice().origin = frame.origin;
        const std::vector<Vec3> before = positions_of(test::mesh_of(test::cone_chunks(volume)));
        const Mesh mesh = smoothed(volume);
        test::expect_sound(check(mesh));
        EXPECT_TRUE(test::crossings_in(mesh).empty());
        expect_inside(before, positions_of(mesh), frame, 0.01);
    }
}

TEST(LatticeFilter, keeps_box_sides_plane_and_edges_straight) {
    auto volume = test::grain_volume({14, 14, 14}, 12, 3);
    const Mesh mesh = smoothed(volume);
    std::uint32_t on_sides = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        for (int side = 0; side < 6; ++side) {
            if (!(mesh[VertexId{v}].sides >> side & 1)) continue;
            EXPECT_EQ(mesh.position(VertexId{v})[side / 2], side % 2 ? 13.0 : 0.0);
            ++on_sides;
        }
    EXPECT_GT(on_sides, 500u);
}

TEST(LatticeFilter, does_not_depend_on_threads) {
    auto volume = test::grain_volume({14, 14, 14}, 12, 3);
    const std::uint64_t once = test::digest(smoothed(volume, 1));
    EXPECT_EQ(test::digest(smoothed(volume, 2)), once);
    EXPECT_EQ(test::digest(smoothed(volume, 5)), once);
}

TEST(LatticeFilter, is_in_a_stream_what_it_is_in_core) {
    for (const Vec3 spacing : {Vec3{1, 1, 1}, Vec3{1, 1, 4.7}, Vec3{3.1, 2, 1}}) {
        auto volume = test::grain_volume({12, 11, 120}, 50, 5);
        volume.lattice().spacing = spacing;
        const std::vector<Chunk> chunks = test::cone_chunks(volume);
        Chunk all = chunks[0];
        for (std::size_t n = 1; n < chunks.size(); ++n) all.append(chunks[n]);
        const ChunkOrder order = order_of(volume);
        EXPECT_LT(LatticeSmoother({.filter = SmoothFilter::kLattice}, order).most_chunks(), 120u);
        EXPECT_EQ(test::digest(test::mesh_of(streamed(chunks, order))),
                  test::digest(test::mesh_of(streamed({all}, order))));
    }
}

/// A thousand times farther apart along y than along z: coordinates in finest spacings are large.
TEST(LatticeFilter, smooths_a_box_far_from_the_origin_as_in_the_whole) {
    const auto volume =
        sampled({3, 700, 12}, {1, 1000, 1}, [](Vec3 p) { return p.z - 5.3 - 2 * std::sin(p.y / 40000); });
    const std::vector<Chunk> chunks = test::cone_chunks(volume);
    ChunkOrder order = order_of(volume);
    const std::vector<Vec3> before = positions_of(test::mesh_of(chunks)),
                            whole = positions_of(test::mesh_of(streamed(chunks, order)));
    order.wanted.low.y = 600e3;
    order.wanted.high.y = 650e3;
    const std::vector<Vec3> part = positions_of(test::mesh_of(streamed(chunks, order)));
    std::size_t moved = 0;
    for (std::size_t v = 0; v < whole.size(); ++v) {
        if (before[v].y < order.wanted.low.y || before[v].y > order.wanted.high.y) continue;
        EXPECT_EQ(part[v], whole[v]);
        moved += length(whole[v] - before[v]) > 0.1;
    }
    EXPECT_GT(moved, 50u);
}

TEST(LatticeFilter, refuses_samples_too_far_from_the_first) {
    auto volume = test::grain_volume({8, 8, 8}, 4, 3);
    volume.lattice().spacing = {1, 1.9, 1};
    std::vector<Chunk> chunks = test::cone_chunks(volume);
    for (Chunk& chunk : chunks)
        for (VertexSimplex& simplex : chunk.simplices) simplex.base[1] += 300000;
    EXPECT_THROW(streamed(chunks, order_of(volume)), Error);
}

}  // namespace
}  // namespace regionmesh
