#include "blocks/cut.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

PieceVertex at(Vec3 position, float bound = 0) { return {.position = position, .error_bound = bound}; }

/// A fan of six faces round vertex 0, whose rim is 1 to 6.
Piece fan() {
    Piece piece{{}, {at({0, 0, 0}, 0.5)}, {}, {}};
    for (std::uint32_t n = 0; n < 6; ++n) {
        piece.vertices.push_back(at({std::cos(n * 1.0471975512), std::sin(n * 1.0471975512), 0}, 0.25));
        piece.faces.push_back({{0, n + 1, (n + 1) % 6 + 1}, {1, 2}});
    }
    return piece;
}

TEST(Cut, collapses_of_a_log_are_made_in_their_order) {
    Piece piece = fan();
    piece.log = {{.position = {0.5, 0, 0},
                  .goes = 0,
                  .stays = 1,
                  .goes_bound = 0.125f,
                  .stays_bound = 0.0625f,
                  .level = 1,
                  .faces = 2},
                 {.position = {0.25, 1, 0},
                  .goes = 1,
                  .stays = 3,
                  .goes_bound = 0.2f,
                  .stays_bound = 0.1f,
                  .level = 2,
                  .faces = 2}};
    Piece none = piece, one = piece, both = piece;
    make_collapses(none, 0);
    EXPECT_EQ(none.faces.size(), 6u);
    EXPECT_EQ(none.vertices[0].position, Vec3{});
    EXPECT_EQ(none.vertices[0].error_bound, 0.125f);
    EXPECT_EQ(none.vertices[1].error_bound, 0.0625f) << "what it had before the first of its collapses";
    EXPECT_EQ(none.vertices[2].error_bound, 0.25f);
    make_collapses(one, 1);
    EXPECT_EQ(one.faces.size(), 4u);
    ASSERT_EQ(one.vertices.size(), 6u);
    EXPECT_EQ(one.vertices[0].position, (Vec3{0.5, 0, 0})) << "vertices are numbered anew";
    EXPECT_EQ(one.vertices[0].error_bound, 0.2f);
    make_collapses(both, 2);
    EXPECT_EQ(both.faces.size(), 2u);
    ASSERT_EQ(both.vertices.size(), 5u);
    EXPECT_EQ(both.vertices[1].position, (Vec3{0.25, 1, 0}));
    for (const Piece& made : {none, one, both}) {
        EXPECT_TRUE(made.log.empty());
        for (const PieceFace& face : made.faces)
            for (const std::uint32_t v : face.vertices) EXPECT_LT(v, made.vertices.size());
    }
}

/// A piece in a file, whose collapses remove so many faces each.
std::filesystem::path with_levels(const std::filesystem::path& path, const std::vector<double>& levels,
                                  std::uint32_t faces = 2) {
    Piece piece = fan();
    for (const double level : levels) piece.log.push_back({.goes = 0, .stays = 1, .level = level, .faces = faces});
    write_piece(piece, path, {.sync = false});
    return path;
}

using CutOfFiles = TemporaryFolder;

TEST_F(CutOfFiles, the_lowest_levels_of_all_logs_lead_to_the_target) {
    const std::vector<std::filesystem::path> pieces{with_levels(path("a"), {1, 1.0001, 3, 3}),
                                                    with_levels(path("b"), {}),
                                                    with_levels(path("c"), {0, 1.00005, 2.9, 3, 1e9})};
    using Made = std::vector<std::uint64_t>;
    EXPECT_EQ(cut(pieces, 18, 18), (Made{0, 0, 0}));
    EXPECT_EQ(cut(pieces, 18, 19), (Made{0, 0, 0}));
    EXPECT_EQ(cut(pieces, 18, 17), (Made{0, 0, 1})) << "the last may leave one less";
    EXPECT_EQ(cut(pieces, 18, 14), (Made{1, 0, 1}));
    EXPECT_EQ(cut(pieces, 18, 12), (Made{1, 0, 2})) << "levels that are nearly the same";
    EXPECT_EQ(cut(pieces, 18, 10), (Made{2, 0, 2}));
    EXPECT_EQ(cut(pieces, 18, 4), (Made{4, 0, 3})) << "of the same level the first piece";
    EXPECT_EQ(cut(pieces, 18, 0), (Made{4, 0, 5}));
    EXPECT_EQ(cut(pieces, 30, 3), (Made{4, 0, 5})) << "all of them are not enough";
}

TEST_F(CutOfFiles, the_last_collapse_leaves_the_least_below_the_target) {
    const std::vector<std::filesystem::path> pieces{with_levels(path("a"), {1, 1.0001}, 3),
                                                    with_levels(path("b"), {1.0002, 1.0002}),
                                                    with_levels(path("c"), {2}, 1)};
    using Made = std::vector<std::uint64_t>;
    EXPECT_EQ(cut(pieces, 20, 18), (Made{0, 1, 0}));
    EXPECT_EQ(cut(pieces, 20, 19), (Made{0, 1, 0})) << "the level of c is far higher";
    EXPECT_EQ(cut(pieces, 20, 17), (Made{1, 0, 0}));
    EXPECT_EQ(cut(pieces, 20, 16), (Made{1, 1, 0})) << "one less, as with two of b";
    EXPECT_EQ(cut(pieces, 20, 12), (Made{2, 1, 0}));
}

}  // namespace
}  // namespace regionmesh
