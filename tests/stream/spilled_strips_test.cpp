#include "stream/spilled_strips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "stream/merger.h"
#include "support/digest.h"
#include "support/meshes.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kPerStrip = 40;  // tetrahedra

/// Strips of so many tetrahedra each, put aside.
void spill(SpilledStrips& strips, test::ArrayMesh mesh, std::uint32_t per_strip = kPerStrip) {
    LabelTable labels;
    RankedTetrahedra ranked = rank_tetrahedra(mesh, labels, {.sweep = kSweepZ});
    TetrahedronMesher mesher(ranked.points, mesh, {});
    test::mesh_in_strips(ranked, mesher, per_strip, [&] {
        strips.add(mesher.strip(), 0);
        for (const FinalizedVertex& end : mesher.finalized()) strips.add_finalized(end);
    });
    strips.finish(mesher.hull_is_box());
}

std::vector<StripRange> one_by_one(const SpilledStrips& strips) {
    std::vector<StripRange> ranges;
    for (std::uint32_t s = 0; s < strips.strip_count(); ++s) ranges.push_back({s, s + 1});
    return ranges;
}

std::vector<Chunk> read_all(SpilledStrips& strips, const std::vector<StripRange>& ranges) {
    std::vector<Chunk> chunks;
    strips.rewind();
    for (StripRange range : ranges) strips.read(range, chunks.emplace_back());
    return chunks;
}

Mesh merged(const std::vector<Chunk>& chunks) {
    Merger merger;
    for (const Chunk& chunk : chunks) merger.add(chunk);
    EXPECT_EQ(merger.active_count(), 0u) << "no vertex is active at the end";
    Mesh mesh = merger.take_mesh();
    release_all(mesh);
    return mesh;
}

/// The chunks in which each vertex has faces, by vertices in the order in which they come; fails where a chunk breaks
/// what Chunk promises.
std::vector<std::set<std::size_t>> chunks_of_vertices(const std::vector<Chunk>& chunks) {
    std::vector<std::set<std::size_t>> chunks_of;
    std::vector<std::size_t> finalized_in, active, made_in;
    for (std::size_t b = 0; b < chunks.size(); ++b) {
        const Chunk& chunk = chunks[b];
        EXPECT_EQ(chunk.carried, active.size());
        std::vector<std::size_t> local = active;  // through numbers
        for (std::size_t n = 0; n < chunk.vertices.size(); ++n) {
            local.push_back(chunks_of.size());
            chunks_of.emplace_back();
            finalized_in.push_back(b);
            made_in.push_back(b);
        }
        for (std::size_t v : active) finalized_in[v] = b;
        for (const ChunkFace& face : chunk.faces)
            for (std::uint32_t v : face.vertices) {
                if (v >= local.size()) {
                    ADD_FAILURE() << "a face of a vertex that is not there";
                    return chunks_of;
                }
                chunks_of[local[v]].insert(b);
            }
        active.clear();
        EXPECT_EQ(std::set(chunk.active.begin(), chunk.active.end()).size(), chunk.active.size()) << "active once";
        for (std::uint32_t v : chunk.active) active.push_back(local.at(v));
    }
    EXPECT_TRUE(active.empty());
    for (std::size_t v = 0; v < chunks_of.size(); ++v) {
        if (chunks_of[v].empty()) {
            ADD_FAILURE() << "vertex " << v << " has no faces";
            continue;
        }
        EXPECT_EQ(*chunks_of[v].rbegin(), finalized_in[v]) << "finalized with the last of its faces";
        EXPECT_EQ(*chunks_of[v].begin(), made_in[v]);
    }
    return chunks_of;
}

std::vector<test::ArrayMesh> meshes() {
    return {test::bent_mesh({6, 5, 9}, 6, 1), test::mesh_of(test::noise_volume({5, 4, 8}, 3, 2)),
            test::cell_mesh_of(test::noise_volume({5, 4, 8}, 3, 3)),
            test::cell_mesh_of(test::grain_volume({5, 6, 8}, 4, 4))};
}

TEST(SpilledStrips, chunks_finalize_each_vertex_with_the_last_of_its_faces) {
    for (const test::ArrayMesh& mesh : meshes())
        for (std::uint32_t per_strip : {1u, 7u, kPerStrip, 100000u}) {
            SCOPED_TRACE(std::to_string(per_strip) + " tetrahedra a strip");
            SpilledStrips strips(0);
            spill(strips, mesh, per_strip);
            chunks_of_vertices(read_all(strips, one_by_one(strips)));
            chunks_of_vertices(read_all(strips, strips.strips_for_smoothing()));
        }
}

TEST(SpilledStrips, any_cut_into_chunks_gives_the_same_surface_and_so_after_rewinding) {
    for (const test::ArrayMesh& mesh : meshes()) {
        SpilledStrips strips(0);
        spill(strips, mesh);
        const Mesh whole = merged(read_all(strips, {{0, strips.strip_count()}}));
        EXPECT_EQ(whole.face_count(), strips.face_count());
        for (const std::vector<StripRange>& ranges :
             {one_by_one(strips), strips.strips_for_smoothing(), one_by_one(strips)}) {
            const Mesh mesh = merged(read_all(strips, ranges));
            EXPECT_EQ(test::surface_digest(mesh), test::surface_digest(whole));
            EXPECT_EQ(mesh.vertex_count(), whole.vertex_count());
        }
        SpilledStrips fewer(0);
        spill(fewer, mesh, 100000);
        EXPECT_EQ(fewer.strip_count(), 1u);
        EXPECT_EQ(test::surface_digest(merged(read_all(fewer, {{0, 1}}))), test::surface_digest(whole));
    }
}

TEST(SpilledStrips, no_vertex_has_faces_in_more_than_two_layers) {
    for (const test::ArrayMesh& mesh : meshes())
        for (std::uint32_t per_strip : {1u, 7u, kPerStrip}) {
            SpilledStrips strips(0);
            spill(strips, mesh, per_strip);
            const std::vector<StripRange> layers = strips.strips_for_smoothing();
            std::uint32_t next = 0;
            for (StripRange layer : layers) {
                EXPECT_EQ(layer.first, next);
                EXPECT_GT(layer.end, layer.first);
                next = layer.end;
            }
            EXPECT_EQ(next, strips.strip_count());
            for (const std::set<std::size_t>& chunks : chunks_of_vertices(read_all(strips, layers)))
                EXPECT_LE(*chunks.rbegin() - *chunks.begin(), 1u);
            if (per_strip == 1) {
                EXPECT_GT(layers.size(), 3u) << "more than what the test is about";
            }
        }
}

/// By hand: faces of one vertex each time, which is all that matters here.
MeshedStrip strip_of(std::uint32_t first, std::uint32_t count, const std::vector<std::uint32_t>& of) {
    MeshedStrip strip{.first_vertex = first, .vertices = std::vector<ChunkVertex>(count), .faces = {}};
    for (std::uint32_t v : of) strip.faces.push_back({{v, v, v}, {0, 1}});
    return strip;
}

TEST(SpilledStrips, layers_are_as_thin_as_the_reach_of_vertices_allows) {
    SpilledStrips strips(0);
    const FinalizedVertex end{.vertex = 0, .last_strip = 0, .is_on_hull = false, .is_shared = true};
    const auto ends = [&](std::uint32_t vertex, std::uint32_t last) {
        FinalizedVertex made = end;
        made.vertex = vertex;
        made.last_strip = last;
        strips.add_finalized(made);
    };
    strips.add(strip_of(0, 2, {0, 1}), 1);
    strips.add(strip_of(2, 0, {1}), 7);
    strips.add(strip_of(2, 1, {1, 2}), 3);
    strips.add(strip_of(3, 0, {0, 2}), 2);
    strips.add(strip_of(3, 1, {3}), 4);
    ends(1, 2);
    ends(0, 3);
    ends(2, 3);
    strips.finish(true);
    const auto layers = strips.strips_for_smoothing();
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].end, 1u);
    EXPECT_EQ(layers[1].end, 4u);
    EXPECT_EQ(layers[2].end, 5u);
    EXPECT_EQ(strips.faces_of(layers[1]), 5u);
    EXPECT_EQ(strips.face_count(), 8u);
    EXPECT_EQ(strips.top_of(layers[1]), 7);
    EXPECT_EQ(strips.top_of({4, 4}), -HUGE_VAL);
}

TEST(SpilledStrips, strips_without_faces_give_chunks_without_faces) {
    SpilledStrips strips(0);
    strips.add(strip_of(0, 0, {}), 0);
    strips.add(strip_of(0, 1, {0}), 0);
    strips.add(strip_of(1, 0, {}), 0);
    strips.finish(true);
    const std::vector<Chunk> chunks = read_all(strips, one_by_one(strips));
    EXPECT_THAT(std::vector({chunks[0].faces.size(), chunks[1].faces.size(), chunks[2].faces.size()}),
                testing::ElementsAre(0, 1, 0));
    SpilledStrips none(0);
    none.finish(true);
    EXPECT_TRUE(none.strips_for_smoothing().empty());
    EXPECT_EQ(none.face_count(), 0u);
}

TEST(SpilledStrips, sides_are_those_of_a_box_or_else_the_hull) {
    SpilledStrips box(0), bent(0);
    for (SpilledStrips* strips : {&box, &bent}) {
        MeshedStrip strip = strip_of(0, 3, {0, 1, 2});
        for (ChunkVertex& vertex : strip.vertices) vertex.sides = 1 << 2;
        for (int n = 0; n < 2; ++n) strip.faces[n].labels[1] = exterior(n ? kHull : 2);
        strips->add(strip, 0);
        strips->add_finalized({.vertex = 0, .last_strip = 0, .is_on_hull = true, .is_shared = false});
        strips->add_finalized(
            {.vertex = 2, .last_strip = 0, .is_on_hull = false, .is_shared = false, .is_pinned = true});
        strips->finish(strips == &box);
    }
    const auto of_box = read_all(box, {{0, 1}})[0].vertices, of_hull = read_all(bent, {{0, 1}})[0].vertices;
    EXPECT_EQ(of_box[0].sides, 1 << 2);
    EXPECT_EQ(of_box[1].sides, 1 << 2);
    EXPECT_EQ(of_box[2].sides, 1 << 2 | kPinned);
    EXPECT_EQ(of_hull[0].sides, kOnHull);
    EXPECT_EQ(of_hull[1].sides, 0);
    EXPECT_EQ(of_hull[2].sides, kPinned);
    const auto faces = read_all(bent, {{0, 1}})[0].faces;
    EXPECT_EQ(faces[0].labels[1], exterior(kHull));
    EXPECT_EQ(faces[1].labels[1], exterior(kHull));
    EXPECT_EQ(faces[2].labels[1], 1u);
    EXPECT_EQ(read_all(box, {{0, 1}})[0].faces[0].labels[1], exterior(2));
}

}  // namespace
}  // namespace regionmesh
