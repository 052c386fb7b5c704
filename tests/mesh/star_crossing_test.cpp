#include "mesh/star_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/crossings.h"
#include "support/random.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using test::shape;
using test::ShapeFace;

/// A vertex at the origin and faces round it, in the making; vertex 0 is the one in the middle until `finish`.
struct Star {
    std::vector<Vec3> at{Vec3{}};
    std::vector<ShapeFace> faces;

    std::uint32_t add(Vec3 p) {
        at.push_back(p);
        return static_cast<std::uint32_t>(at.size()) - 1;
    }
    void page(std::uint32_t a, std::uint32_t b, Label first = 0, Label second = 1) {
        faces.push_back({{0, a, b}, first, second});
    }
    /// Vertices and faces in another order: the one in the middle may be any.
    Mesh finish(test::Random& random) const {
        std::vector<std::uint32_t> place(at.size());
        for (std::uint32_t n = 0; n < place.size(); ++n) place[n] = n;
        for (std::uint32_t n = 1; n < place.size(); ++n) std::swap(place[n], place[random.below(n + 1)]);
        std::vector<Vec3> positions(at.size());
        for (std::uint32_t n = 0; n < place.size(); ++n) positions[place[n]] = at[n];
        std::vector<ShapeFace> shuffled = faces;
        for (std::uint32_t n = 1; n < shuffled.size(); ++n) std::swap(shuffled[n], shuffled[random.below(n + 1)]);
        for (ShapeFace& face : shuffled) {
            for (std::uint32_t& v : face.v) v = place[v];
            std::rotate(face.v.begin(), face.v.begin() + random.below(3), face.v.end());
        }
        return shape(positions, shuffled);
    }
};

/// A disk of one interface that goes round so many times, or not quite, up and down.
Star random_disk(test::Random& random, double rounds, double height) {
    Star star;
    const std::uint32_t count = 3 + random.below(6);
    const bool closed = random.below(3) > 0;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t n = 0; n < count + !closed; ++n) {
        const double angle = 2 * std::numbers::pi * rounds * (n + random.between(-0.4, 0.4)) / count;
        ring.push_back(
            star.add(random.between(0.5, 2) * Vec3{std::cos(angle), std::sin(angle), height * random.between(-1, 1)}));
    }
    for (std::uint32_t n = 0; n < count; ++n) star.page(ring[n], ring[(n + 1) % ring.size()]);
    return star;
}

/// From one neighbour to another over some between; region `first` is on the right of who goes there.
void add_pages(Star& star, test::Random& random, std::uint32_t from, std::uint32_t to, Vec3 over, double noise,
               Label first, Label second) {
    const std::uint32_t between = random.below(3);
    std::uint32_t last = from;
    for (std::uint32_t n = 1; n <= between; ++n) {
        const double share = n / (between + 1.0);
        const std::uint32_t next =
            star.add((1 - share) * star.at[from] + share * star.at[to] + over + noise * random.point(1));
        star.page(last, next, first, second);
        last = next;
    }
    star.page(last, to, first, second);
}

/// Three interfaces on a line through the vertex.
Star random_book(test::Random& random, double noise) {
    Star star;
    const std::uint32_t up = star.add(Vec3{0, 0, 1} + noise * random.point(1)),
                        down = star.add(Vec3{0, 0, -1} + noise * random.point(1));
    for (Label page = 0; page < 3; ++page) {
        const double angle = page * 2.1;
        const std::uint32_t middle = star.add(Vec3{std::cos(angle), std::sin(angle), 0} + noise * random.point(1));
        add_pages(star, random, up, middle, {}, noise, page, (page + 1) % 3);
        add_pages(star, random, middle, down, {}, noise, page, (page + 1) % 3);
    }
    return star;
}

/// Four lines, six interfaces, four regions: region n lies opposite line n.
Star random_quadruple_point(test::Random& random, double noise) {
    Star star;
    const Vec3 ways[4]{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    std::uint32_t line[4];
    for (int n = 0; n < 4; ++n) line[n] = star.add(ways[n] + noise * random.point(1));
    constexpr int kPages[6][4]{{0, 1, 3, 2}, {1, 2, 3, 0}, {0, 2, 1, 3}, {0, 3, 2, 1}, {1, 3, 0, 2}, {2, 3, 1, 0}};
    for (const auto& [from, to, first, second] : kPages)
        add_pages(star, random, line[from], line[to], 0.3 * (ways[from] + ways[to]), noise, static_cast<Label>(first),
                  static_cast<Label>(second));
    return star;
}

/// Any neighbours, any labels.
Star random_pages(test::Random& random, std::uint32_t labels) {
    Star star;
    const std::uint32_t neighbours = 3 + random.below(6);
    for (std::uint32_t n = 0; n < neighbours; ++n) star.add(random.point(1));
    for (std::uint32_t n = 2 + random.below(8); n > 0; --n)
        star.page(1 + random.below(neighbours), 1 + random.below(neighbours), random.below(labels),
                  random.below(labels));
    return star;
}

Star random_star(test::Random& random) {
    const double noise = random.below(2) ? 0.2 : 0.8;
    switch (random.below(6)) {
        case 0:
            return random_disk(random, 1, noise);
        case 1:
            return random_disk(random, random.below(2) ? 2 : 1.1, noise);
        case 2:
            return random_book(random, noise);
        case 3:
            return random_quadruple_point(random, noise);
        case 4:
            return random_pages(random, 2);
        default:
            return random_pages(random, 5);
    }
}

TEST(StarCrossing, says_what_all_pairs_say) {
    std::size_t crossing = 0, free = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        ++(test::expect_all_crossings_found(random_star(random).finish(random)) > 0 ? crossing : free);
    }
    EXPECT_GT(crossing, 500u);
    EXPECT_GT(free, 500u);
}

/// Neighbours that lie in a plane of others, on an edge, on a line beyond another, or as near as can be.
void move_to_where_rounding_tells(Star& star, test::Random& random) {
    const auto some = [&] { return star.at[1 + random.below(static_cast<std::uint32_t>(star.at.size()) - 1)]; };
    Vec3& p = star.at[1 + random.below(static_cast<std::uint32_t>(star.at.size()) - 1)];
    switch (random.below(4)) {
        case 0:
            p = 2.0 * some();
            break;
        case 1:
            p = random.unit() * some() + random.unit() * some();
            break;
        case 2:
            p = 0.5 * some() + 0.5 * some();
            break;
        default:
            p = some();
            break;
    }
    double& number = p[static_cast<int>(random.below(3))];
    const std::uint32_t step = random.below(3);
    if (step > 0) number = std::nextafter(number, step == 1 ? 9 : -9);
}

TEST(StarCrossing, says_what_all_pairs_say_where_stars_nearly_pass) {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        Star star = random_star(random);
        for (std::uint32_t n = 1 + random.below(2); n > 0; --n) move_to_where_rounding_tells(star, random);
        test::expect_all_crossings_found(star.finish(random));
    }
}

TEST(StarCrossing, says_what_all_pairs_say_on_a_lattice) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        Star star = random_star(random);
        const int reach = 1 + static_cast<int>(random.below(2));
        for (std::size_t n = 1; n < star.at.size(); ++n) {
            if (random.below(2)) star.at[n] = random.lattice_point(reach);
            for (int axis = 0; axis < 3; ++axis) star.at[n][axis] = std::round(2 * star.at[n][axis]) / 2;
        }
        test::expect_all_crossings_found(star.finish(random));
    }
}

TEST(StarCrossing, says_what_all_pairs_say_of_any_size_anywhere) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        Star star = random_star(random);
        constexpr double kScales[]{1e-65, 1e-59, 1e-20, 1e20, 1e59, 1e65};
        const double scale = kScales[random.below(6)];
        const Vec3 away = random.below(2) ? 1e6 * random.point(1) : Vec3{};
        for (Vec3& p : star.at) p = scale * (p + away);
        test::expect_all_crossings_found(star.finish(random));
    }
}

/// A flat disk in order round the origin: the last neighbour may come to the first one, which lies along x.
Mesh flat_fan(Vec3 last) {
    return shape({{}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, last},
                 {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 5}}});
}

TEST(StarCrossing, sees_the_last_bit_of_an_open_fan) {
    const double bit = std::nextafter(0, 1);
    EXPECT_EQ(test::expect_all_crossings_found(flat_fan({2, -bit, 0})), 0u);
    EXPECT_EQ(test::expect_all_crossings_found(flat_fan({2, 0, 0})), 1u) << "comes to the first ray";
    EXPECT_EQ(test::expect_all_crossings_found(flat_fan({2, bit, 0})), 1u) << "and beyond";
    EXPECT_EQ(test::expect_all_crossings_found(flat_fan({2, 0, bit})), 0u) << "passes above";
}

TEST(StarCrossing, finds_a_disk_that_goes_round_twice) {
    Star star;
    for (std::uint32_t n = 0; n < 8; ++n)
        star.add({std::cos(n * std::numbers::pi / 2), std::sin(n * std::numbers::pi / 2), n % 2 * 0.1});
    for (std::uint32_t n = 0; n < 8; ++n) star.page(1 + n, 1 + (n + 1) % 8);
    test::Random random(1);
    EXPECT_GT(test::expect_all_crossings_found(star.finish(random)), 0u);
}

TEST(StarCrossing, finds_a_page_folded_back_by_a_bit) {
    // A square pyramid seen from its top, with one neighbour almost in the plane through the top and two others.
    for (double off : {-1e-3, -1e-15, 0.0, 1e-15, 1e-3}) {
        const Mesh mesh = shape({{0, 0, 1}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0.5 + off, 0, 0.5}},
                                {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 5}}, {{0, 5, 1}}});
        EXPECT_EQ(test::expect_all_crossings_found(mesh), 0u) << off;
        // The neighbour beyond the page that follows.
        const Mesh folded = shape({{0, 0, 1}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {off, 1, 0}},
                                  {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 5}}, {{0, 5, 1}}});
        EXPECT_GT(test::expect_all_crossings_found(folded), 0u) << off;
    }
}

TEST(StarCrossing, finds_neighbours_at_one_place) {
    const Mesh mesh =
        shape({{}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0.5}, {1, 0, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}});
    EXPECT_EQ(test::expect_all_crossings_found(mesh), 1u);
}

TEST(StarCrossing, takes_a_face_with_a_vertex_twice) {
    Mesh mesh = flat_fan({1, -1, 0});
    mesh.add_face(VertexId{0}, VertexId{0}, VertexId{3}, 0, 1);
    mesh.add_face(VertexId{0}, VertexId{2}, VertexId{2}, 0, 1);
    EXPECT_EQ(test::expect_all_crossings_found(mesh), 0u);
}

}  // namespace
}  // namespace regionmesh
