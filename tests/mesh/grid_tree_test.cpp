#include "mesh/grid_tree.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "support/random.h"

namespace regionmesh {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

GridTree tree_over(const std::vector<Box>& boxes, std::uint32_t threads = 1) {
    Box extent;
    for (const Box& box : boxes) extent.join(box);
    GridTree tree;
    tree.build(static_cast<std::uint32_t>(boxes.size()), extent, threads, [&](std::uint32_t n) { return boxes[n]; });
    return tree;
}

Pairs pairs_in(const GridTree& tree) {
    Pairs pairs;
    for (std::uint32_t part = 0; part < tree.part_count(); ++part) {
        tree.visit_pairs(part, part + 1, [&](const GridTree::PartPairs& some) {
            for (const GridTree::Pair pair : some.pairs) {
                const std::uint32_t m = some.first_m + pair.m(), n = some.first_n + pair.n();
                EXPECT_LT(m, n);
                EXPECT_EQ(m / 512, part) << "in the part of another place";
                EXPECT_TRUE(pairs.insert({m, n}).second) << "visited twice";
            }
        });
    }
    return pairs;
}

bool do_meet(const Box& a, const Box& b, double margin) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(a.low[axis] <= b.high[axis] + margin && a.high[axis] >= b.low[axis] - margin)) return false;
    return !a.is_empty() && !b.is_empty();
}

/// Boxes of a size in the unit cube, some of them empty, along x as a spatial order would have them, or as they come.
std::vector<Box> random_boxes(std::uint32_t count, double size, bool sorted, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<Box> boxes;
    for (std::uint32_t n = 0; n < count; ++n) {
        Box box;
        if (random.below(10) > 0) {
            box.add({sorted ? (n + 0.5) / count : random.unit(), random.unit(), random.unit()});
            box.add(box.low + size * Vec3{random.unit(), random.unit(), random.unit()});
        }
        boxes.push_back(box);
    }
    return boxes;
}

TEST(GridTree, pairs_are_all_boxes_that_meet) {
    std::uint64_t seed = 0;
    for (std::uint32_t count : {0, 1, 2, 7, 8, 9, 63, 64, 65, 511, 512, 513, 1500}) {
        for (double size : {0.02, 0.2, 2.0}) {
            SCOPED_TRACE(testing::Message() << count << " boxes, size " << size << ", seed " << seed);
            const std::vector<Box> boxes = random_boxes(count, size, seed % 2 == 0, seed);
            ++seed;
            const Pairs pairs = pairs_in(tree_over(boxes));
            for (std::uint32_t m = 0; m < count; ++m) {
                for (std::uint32_t n = m + 1; n < count; ++n) {
                    const bool found = pairs.contains({m, n});
                    const bool must = do_meet(boxes[m], boxes[n], 0), may = do_meet(boxes[m], boxes[n], 1e-3);
                    ASSERT_TRUE(found ? may : !must) << m << " and " << n;
                }
            }
        }
    }
}

TEST(GridTree, is_the_same_on_several_threads) {
    const std::vector<Box> boxes = random_boxes(40000, 0.02, true, 5);
    const GridTree one = tree_over(boxes, 1), many = tree_over(boxes, 3);
    ASSERT_EQ(one.part_count(), many.part_count());
    for (std::uint32_t part = 0; part < one.part_count(); part += 7) {
        std::vector<std::uint64_t> a, b;
        const auto to = [](std::vector<std::uint64_t>& list) {
            return [&list](const GridTree::PartPairs& some) {
                for (const GridTree::Pair pair : some.pairs)
                    list.push_back(std::uint64_t{some.first_m + pair.m()} << 32 | (some.first_n + pair.n()));
            };
        };
        one.visit_pairs(part, part + 1, to(a));
        many.visit_pairs(part, part + 1, to(b));
        EXPECT_EQ(a, b);
    }
}

TEST(GridTree, knows_a_spatial_order) {
    std::vector<Box> row;
    for (std::uint32_t n = 0; n < 20000; ++n) {
        Box box;
        box.add({n * 1.0, 0, 0});
        box.add({n + 1.0, 1, 1});
        row.push_back(box);
    }
    EXPECT_TRUE(tree_over(row).is_spatial());
    std::vector<Box> shuffled = row;
    test::Random random(1);
    for (std::uint32_t n = 1; n < shuffled.size(); ++n) std::swap(shuffled[n], shuffled[random.below(n + 1)]);
    EXPECT_FALSE(tree_over(shuffled).is_spatial());
    // In order but for the last three digits.
    std::vector<Box> mixed = row;
    for (std::uint32_t n = 1; n < mixed.size(); ++n)
        if (n % 512 != 0) std::swap(mixed[n], mixed[n / 512 * 512 + random.below(n % 512 + 1)]);
    EXPECT_FALSE(tree_over(mixed).is_spatial());
}

}  // namespace
}  // namespace regionmesh
