#include "base/packed_numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace regionmesh {
namespace {

TEST(PackedNumbers, come_back_in_their_order) {
    std::vector<std::uint64_t> numbers{0, 1, 127, 128, 16383, 16384, ~0u, std::uint64_t{1} << 63, ~std::uint64_t{0}};
    for (std::uint64_t n = 1; n < std::uint64_t{1} << 62; n *= 3) numbers.push_back(n);
    PackedBytes bytes;
    for (const std::uint64_t number : numbers) put_number(bytes, number);
    const std::uint8_t* from = bytes.data();
    for (const std::uint64_t number : numbers) EXPECT_EQ(take_number(from), number);
    EXPECT_EQ(from, bytes.data() + bytes.size());
}

TEST(PackedNumbers, small_ones_take_one_byte) {
    for (std::int64_t number = -64; number < 64; ++number) {
        PackedBytes bytes;
        put_number(bytes, folded(number));
        EXPECT_EQ(bytes.size(), 1u) << number;
    }
}

TEST(PackedNumbers, folding_keeps_the_sign) {
    using Limits = std::numeric_limits<std::int64_t>;
    for (const std::int64_t number :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{-77}, Limits::max(), Limits::min()})
        EXPECT_EQ(unfolded(folded(number)), number);
    EXPECT_EQ(folded(-1), 1u);
    EXPECT_EQ(folded(1), 2u);
}

}  // namespace
}  // namespace regionmesh
