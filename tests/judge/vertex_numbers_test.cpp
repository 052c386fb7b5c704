#include "judge/verdict/vertex_numbers.h"

#include <gtest/gtest.h>

#include <map>

#include "support/random.h"

namespace regionmesh {
namespace {

TEST(VertexNumbers, are_those_of_a_map_whatever_was_there_before) {
    test::Random random(7);
    VertexNumbers numbers;
    std::vector<std::uint32_t> found;
    for (int round = 0; round < 200; ++round) {
        numbers.clear();
        EXPECT_EQ(numbers.size(), 0u);
        std::map<VertexId, std::uint32_t> expected;
        // Some near each other, some multiples of a power of two, which fall on the same places.
        const std::uint32_t step = round % 2 == 0 ? 1 : 1u << 23, kinds = round % 7 == 0 ? 500 : 20;
        for (int some = 0; some < 3; ++some) {
            std::vector<VertexId> vertices;
            for (int n = 0; n < 100; ++n) vertices.push_back(VertexId{random.below(kinds) * step});
            found.resize(vertices.size());
            numbers.add(vertices, found.data());
            for (std::size_t n = 0; n < vertices.size(); ++n) {
                const auto number = expected.try_emplace(vertices[n], static_cast<std::uint32_t>(expected.size()));
                EXPECT_EQ(found[n], number.first->second);
            }
        }
        EXPECT_EQ(numbers.size(), expected.size());
        for (const auto& [vertex, number] : expected) {
            EXPECT_EQ(numbers[number], vertex);
            EXPECT_EQ(numbers.of(vertex), number);
        }
    }
}

TEST(VertexNumbers, of_no_vertex_end_at_once) {
    VertexNumbers numbers;
    numbers.clear();
    numbers.add({}, nullptr);
    EXPECT_EQ(numbers.size(), 0u);
}

}  // namespace
}  // namespace regionmesh
