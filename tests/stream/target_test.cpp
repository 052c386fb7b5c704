#include "stream/target.h"

#include <gtest/gtest.h>

namespace regionmesh {
namespace {

TEST(Target, of_the_faces_read_so_far_is_their_part) {
    const Target target{.faces = 1000, .reduce = {}, .total = 5000};
    EXPECT_EQ(target.so_far(0), 0u);
    EXPECT_EQ(target.so_far(2500), 500u);
    EXPECT_EQ(target.so_far(5000), 1000u);
}

TEST(Target, of_many_faces_does_not_overflow) {
    constexpr std::uint64_t kTotal = 20'000'000'000, kTarget = 1'000'000'000;
    const Target target{.faces = kTarget, .reduce = {}, .total = kTotal};
    for (const std::uint64_t part : {1u, 2u, 3u, 4u})
        EXPECT_NEAR(static_cast<double>(target.so_far(kTotal / 4 * part)), kTarget / 4.0 * part, 1);
}

}  // namespace
}  // namespace regionmesh
