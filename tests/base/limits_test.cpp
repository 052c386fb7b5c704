#include "regionmesh/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "regionmesh/error.h"
#include "regionmesh/mesh.h"
#include "stream/budget.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

std::string refusal(std::uint64_t vertices, std::uint64_t faces) {
    try {
        require_mesh_size("m.ply", vertices, faces);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "not refused";
}

TEST(Limits, a_corner_of_the_last_face_fits_into_32_bits) {
    const std::uint64_t last = (kMostFaces - 1) * 4 + 2;
    EXPECT_LT(last, kNoCorner);
    EXPECT_EQ(static_cast<Corner>(last) >> 2, kMostFaces - 1);
    EXPECT_LE(kMostFaces, std::uint64_t{1} << 30);
}

TEST(Limits, the_last_vertex_is_not_the_id_of_none) { EXPECT_LE(kMostVertices - 1, index(kNoVertex) - 1); }

TEST(Limits, are_guarded_with_one_line) {
    EXPECT_EQ(refusal(kMostVertices, kMostFaces), "not refused");
    EXPECT_THAT(refusal(3, kMostFaces + 1), HasSubstr("m.ply: 1073741824 faces, more than 1073741823"));
    EXPECT_THAT(refusal(kMostVertices + 1, 1), HasSubstr("m.ply: 4294967296 vertices, more than 4294967295"));
}

TEST(Limits, a_mesh_makes_no_room_beyond_them) {
    Mesh mesh;
    EXPECT_THROW(mesh.reserve(0, kMostFaces + 1), Error);
    EXPECT_THROW(mesh.reserve(kMostVertices + 1, 0), Error);
    EXPECT_NO_THROW(mesh.reserve(10, 10));
}

TEST(Limits, a_budget_expects_no_more_faces_than_a_mesh_can_hold) {
    BudgetDemand demand;
    demand.strip_faces.assign(9, 100);
    demand.asked_budget = kMostFaces * 10;
    EXPECT_EQ(plan_budget(std::uint64_t{1} << 50, demand).face_budget(0), kMostFaces);
}

std::string refusal(const Lattice& lattice) {
    try {
        require_lattice("v.nrrd", lattice);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "not refused";
}

std::string lattice_refusal(Vec3 spacing, Vec3 origin = {}) {
    return refusal({.size = {5, 4, 3}, .spacing = spacing, .origin = origin});
}

TEST(Limits, of_spacing_hold_at_both_ends_and_refuse_no_number) {
    EXPECT_EQ(lattice_refusal({kLeastLength, kLeastLength, kLeastLength}), "not refused");
    EXPECT_EQ(lattice_refusal({kMostLength, kMostLength, kMostLength}), "not refused");
    for (const double bad : {0.0, -1.0, 1e-90, 1e160, 1e-13, 1e9, HUGE_VAL, std::nan("")})
        EXPECT_THAT(lattice_refusal({1, bad, 1}), HasSubstr("v.nrrd: the spacing along y is"));
}

TEST(Limits, of_origin_and_extent_follow_from_the_smallest_spacing) {
    EXPECT_EQ(lattice_refusal({1, 1, 1}, {0, 0, 1e12}), "not refused");
    for (const double bad : {1e13, -1e13, HUGE_VAL, std::nan("")})
        EXPECT_THAT(lattice_refusal({1, 1, 1}, {0, 0, bad}), HasSubstr("v.nrrd: the coordinates along z reach"));
    EXPECT_THAT(lattice_refusal({1e-6, 1e7, 1}), HasSubstr("the coordinates along y reach"));
}

TEST(Limits, directions_are_of_length_1) {
    Lattice lattice{.size = {5, 4, 3}};
    lattice.direction[4] = 1 + 1e-6;
    EXPECT_EQ(refusal(lattice), "not refused");
    for (const double bad : {5.0, 0.9, HUGE_VAL, std::nan("")}) {
        lattice.direction[4] = bad;
        EXPECT_THAT(refusal(lattice), HasSubstr("v.nrrd: the columns of direction are not of length 1"));
    }
}

TEST(Limits, a_sweep_is_one_of_three) {
    for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ}) EXPECT_NO_THROW(require_sweep("v.nrrd", sweep));
    for (const Sweep& sweep : {Sweep{{0, 0, 0}}, Sweep{{5, 7, 9}}, Sweep{{1, 0, 2}}})
        EXPECT_THROW(require_sweep("v.nrrd", sweep), Error);
}

TEST(Limits, of_models_refuse_what_is_too_large_or_too_small) {
    const auto refused = [](double size, double at) {
        Box box;
        box.add({at, 0, 0});
        box.add({at + size, 0, 0});
        try {
            require_extent("m.ply", box);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("not refused");
    };
    EXPECT_EQ(refused(1, 0), "not refused");
    EXPECT_THAT(refused(1e-40, 0), HasSubstr("m.ply: its size is 1e-40"));
    EXPECT_THAT(refused(1, 1e21), HasSubstr("m.ply: the coordinates along x reach 1e+21"));
    EXPECT_THAT(refused(std::nan(""), 0), HasSubstr("m.ply"));
}

}  // namespace
}  // namespace regionmesh
