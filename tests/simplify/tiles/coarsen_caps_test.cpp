#include "simplify/tiles/coarsen_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "base/triangle.h"
#include "cells/label_census.h"
#include "cells/strip_mesher.h"
#include "stream/merger.h"
#include "support/runs.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

struct Coarsened {
    Mesh mesh;
    LabelOracle oracle;
    std::uint64_t removed = 0;
};

/// Chunks of so many strips, each coarsened before it is merged. Without options nothing is.
Coarsened coarsened(test::ArrayVolume volume, std::uint32_t chunk_strips, const CapOptions* options,
                    CellKind cells = CellKind::kCompact) {
    const Lattice lattice = volume.info().lattice;
    const Sweep sweep = volume.info().sweep;
    LabelTable labels;
    SectionWindow window(volume, labels);
    const StripOptions strips{.cells = cells};
    StripMesher mesher(lattice, sweep, strips);
    LabelCensus census(lattice, sweep, strips);
    Coarsened made;
    Merger merger;
    Chunk chunk;
    std::vector<ChunkVertex> carried;
    for (std::uint32_t strip = 1; window.advance(); ++strip) {
        census.add(window.low(), window.high(), window.is_last());
        Chunk next;
        mesher.mesh(window.low(), window.high(), next);
        chunk.append(next);
        if (strip % chunk_strips != 0 && !window.is_last()) continue;
        if (options) {
            CapOptions own = *options;
            own.lattice = lattice;
            made.removed += coarsen_caps(chunk, carried, own);
        }
        merger.add(chunk);
        carried = active_vertices(chunk, carried);
        chunk = {};
        chunk.carried = static_cast<std::uint32_t>(carried.size());
    }
    made.mesh = merger.take_mesh();
    made.oracle = census.oracle();
    return made;
}

void expect_sound(const Coarsened& made) {
    CheckOptions options;
    options.oracle = made.oracle;
    test::expect_sound(check(made.mesh, options));
}

/// The area of the faces of each pair of labels.
std::map<std::array<Label, 2>, double> areas(const Mesh& mesh) {
    std::map<std::array<Label, 2>, double> areas;
    test::for_faces(mesh, [&](FaceId f) {
        const auto [a, b, c] = mesh.corners(f);
        areas[mesh[f].labels] += 0.5 * length(area_vector(a, b, c));
    });
    return areas;
}

std::set<std::tuple<double, double, double>> places(const Mesh& mesh) {
    std::set<std::tuple<double, double, double>> places;
    test::for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = mesh.position(v);
        places.emplace(p.x, p.y, p.z);
    });
    return places;
}

TEST(CoarsenCaps, leaves_few_faces_of_a_solid_box_and_its_edges_as_they_are) {
    const CapOptions options{.min_quality = 0.2};
    const Coarsened before = coarsened(test::solid_volume({65, 65, 65}), 64, nullptr);
    const Coarsened after = coarsened(test::solid_volume({65, 65, 65}), 64, &options);
    EXPECT_EQ(before.mesh.face_count(), 6u * 64 * 64 * 2);
    EXPECT_EQ(most_cap_faces({.size = {65, 65, 65}}), before.mesh.face_count());
    EXPECT_EQ(after.mesh.face_count() + after.removed, before.mesh.face_count());
    EXPECT_LT(after.mesh.face_count(), before.mesh.face_count() / 5);
    expect_sound(after);
    std::uint32_t on_edges = 0;
    test::for_vertices(after.mesh, [&](VertexId v) {
        const SideSet sides = after.mesh[v].sides;
        on_edges += (sides & (sides - 1)) != 0;
    });
    EXPECT_EQ(on_edges, 12u * 63 + 8);
    test::for_faces(after.mesh, [&](FaceId f) {
        const auto [a, b, c] = after.mesh.corners(f);
        EXPECT_GT(face_quality(a, b, c), 0.23) << "halves and quarters of squares";
    });
}

TEST(CoarsenCaps, moves_nothing_and_keeps_what_the_labels_say) {
    const CapOptions options;
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra})
        for (const Sweep sweep : {kSweepX, kSweepY, kSweepZ})
            for (const std::uint32_t strips : {1u, 7u, 24u}) {
                test::ArrayVolume volume = test::grain_volume({37, 30, 26}, 7, strips);
                volume.swept(sweep).spaced({1, 1.25, 0.75});
                const Coarsened before = coarsened(volume, strips, nullptr, cells);
                const Coarsened after = coarsened(volume, strips, &options, cells);
                EXPECT_GT(after.removed, 0u);
                EXPECT_EQ(after.mesh.face_count() + after.removed, before.mesh.face_count());
                expect_sound(after);
                const auto areas_before = areas(before.mesh), areas_after = areas(after.mesh);
                ASSERT_EQ(areas_after.size(), areas_before.size());
                for (const auto& [labels, area] : areas_before) EXPECT_NEAR(areas_after.at(labels), area, 1e-9 * area);
                const auto kept = places(after.mesh), all = places(before.mesh);
                EXPECT_TRUE(std::includes(all.begin(), all.end(), kept.begin(), kept.end()));
            }
}

TEST(CoarsenCaps, changes_faces_between_region_and_exterior_only) {
    const CapOptions options;
    const auto inner = [](const Mesh& mesh) {
        std::uint32_t count = 0;
        test::for_faces(mesh, [&](FaceId f) { count += !is_exterior(mesh[f].labels[1]); });
        return count;
    };
    const test::ArrayVolume volume = test::grain_volume({30, 30, 30}, 5, 3);
    EXPECT_EQ(inner(coarsened(volume, 29, &options).mesh), inner(coarsened(volume, 29, nullptr).mesh));
}

TEST(CoarsenCaps, leaves_as_many_faces_as_asked_for) {
    const test::ArrayVolume volume = test::solid_volume({33, 33, 33});
    const std::uint64_t all = coarsened(volume, 32, nullptr).mesh.face_count();
    std::uint64_t last = 0;
    for (const double share : {0.1, 0.4, 0.7, 0.99}) {
        const CapOptions options{.least_faces = static_cast<std::uint64_t>(share * static_cast<double>(all))};
        const Coarsened after = coarsened(volume, 32, &options);
        EXPECT_GE(after.mesh.face_count(), options.least_faces);
        EXPECT_GE(after.mesh.face_count(), last);
        last = after.mesh.face_count();
        expect_sound(after);
    }
    EXPECT_EQ(last, all);
}

TEST(CoarsenCaps, leaves_sides_whose_squares_would_make_thin_faces) {
    const CapOptions options{.min_quality = 0.1};
    test::ArrayVolume volume = test::solid_volume({33, 33, 33});
    volume.spaced({1, 1, 6});
    const Coarsened after = coarsened(volume, 32, &options);
    expect_sound(after);
    std::array<std::uint32_t, 6> faces{};
    test::for_faces(after.mesh, [&](FaceId f) { ++faces[side_of(after.mesh[f].labels[1])]; });
    for (const int side : {0, 1, 2, 3}) EXPECT_EQ(faces[side], 2u * 32 * 32);
    for (const int side : {4, 5}) EXPECT_LT(faces[side], 2u * 32 * 32);
}

TEST(CoarsenCaps, does_not_depend_on_threads) {
    const test::ArrayVolume volume = test::grain_volume({40, 40, 40}, 4, 5);
    const CapOptions one{.threads = 1}, three{.threads = 3};
    const Coarsened a = coarsened(volume, 24, &one), b = coarsened(volume, 24, &three);
    ASSERT_EQ(a.mesh.face_end(), b.mesh.face_end());
    for (std::uint32_t f = 0; f < a.mesh.face_end(); ++f)
        EXPECT_EQ(a.mesh[FaceId{f}].vertices, b.mesh[FaceId{f}].vertices);
}

}  // namespace
}  // namespace regionmesh
