// Layers interpolated between drill holes, against surfaces that are known everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "boreholes/kriging.h"
#include "boreholes/terrain.h"
#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "regionmesh/read_layers.h"
#include "support/random.h"

namespace regionmesh {
namespace {

using formats::HeightSample;
using formats::Kriging;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNear = 1e-6;

/// Bases of two units on a ground at 100: folded, 20 m and more apart, with dips of many beds' thickness.
double upper(double x, double y) { return 60 + 12 * std::sin(x / 150) + 0.02 * y; }
double lower(double x, double y) { return 30 + 12 * std::sin(x / 150) - 0.01 * y; }

class Layers : public TemporaryFolder {
protected:
    std::unique_ptr<SectionReader> open(const std::string& rows, const LayerOptions& options = {}) {
        put_text(path("holes.csv"), "hole,x,y,surface,from,to,unit\n" + rows);
        return open_layers(path("holes.csv"), {}, options, &summary_);
    }
    std::string failure_of(const std::string& rows, const LayerOptions& options = {},
                           ErrorCode code = ErrorCode::kInput) {
        try {
            open(rows, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
            return error.what();
        }
        return "nothing thrown";
    }

    static std::string row(double x, double y, double from, double to, const std::string& unit) {
        const std::string place = std::to_string(x) + "," + std::to_string(y);
        return "at " + std::to_string(x) + "," + place + ",100," + std::to_string(from) + "," + std::to_string(to) +
               "," + unit + "\n";
    }

    /// Holes of 100 m through sand, clay and rock.
    static std::vector<HeightSample> places(int count) {
        std::vector<HeightSample> found;
        test::Random random(5);
        for (int n = 0; n < count; ++n) found.push_back({random.between(0, 1000), random.between(0, 1000), 0});
        return found;
    }
    static std::string folded(const std::vector<HeightSample>& places) {
        std::string rows;
        for (const auto& [x, y, z] : places) {
            const double a = 100 - upper(x, y), b = 100 - lower(x, y);
            rows += row(x, y, 0, a, "sand") + row(x, y, a, b, "clay") + row(x, y, b, 100, "rock");
        }
        return rows;
    }

    /// All labels, x fastest.
    static std::vector<InputLabel> labels_of(SectionReader& reader) {
        std::vector<InputLabel> labels, section(std::size_t{reader.section_width()} * reader.section_height());
        while (reader.next(section)) labels.insert(labels.end(), section.begin(), section.end());
        return labels;
    }

    /// The height of the base of `label` in the columns of the lattice: the lowest sample of it or a smaller label.
    struct Column {
        double x, y, base;
    };
    static std::vector<Column> bases(SectionReader& reader, InputLabel label) {
        const Lattice lattice = reader.info().lattice;
        EXPECT_EQ(reader.info().sweep, kSweepZ);
        const std::vector<InputLabel> labels = labels_of(reader);
        std::vector<Column> columns;
        const std::size_t width = lattice.size[0], area = width * lattice.size[1];
        for (std::size_t n = 0; n < area; ++n) {
            std::size_t k = 0;
            while (k < lattice.size[2] && labels[k * area + n] > label) ++k;
            columns.push_back({lattice.origin.x + static_cast<double>(n % width) * lattice.spacing.x,
                               lattice.origin.y + static_cast<double>(n / width) * lattice.spacing.y,
                               lattice.origin.z + (static_cast<double>(k) - 0.5) * lattice.spacing.z});
        }
        return columns;
    }

    LayerSummary summary_;
};

const LayerOptions kFine{
    .spacing = Vec3{20, 20, 0.25}, .box = {{{0, 1000}, {0, 1000}, {0, 101}}}, .sweep = SweepChoice::kZ};

TEST(KrigingSurface, goes_through_its_samples_and_stays_a_plane_of_one_height) {
    std::vector<HeightSample> samples;
    test::Random random(3);
    for (int n = 0; n < 60; ++n) samples.push_back({random.between(0, 9), random.between(0, 9), random.between(0, 9)});
    const Kriging surface(samples, kNear);
    for (const auto& [x, y, z] : samples) EXPECT_NEAR(surface.at(x, y), z, 1e-9);
    for (HeightSample& sample : samples) sample.z = 7;
    EXPECT_NEAR(Kriging(samples, kNear).at(4.5, 100), 7, 1e-9);
    EXPECT_NEAR(Kriging({{1, 2, 3}}, kNear).at(50, 60), 3, 1e-12);
    EXPECT_NEAR(Kriging({{1, 2, 3}, {1, 2, 5}, {4, 2, 8}}, kNear).at(1, 2), 4, 1e-9)
        << "mean of two heights at one place";
}

TEST_F(Layers, holes_side_by_side_do_not_tilt_the_base) {
    std::string rows;
    for (const double x : {0, 1000})
        for (const double y : {0, 1000}) rows += row(x, y, 0, 20, "sand") + row(x, y, 20, 100, "clay");
    rows += row(500, 500, 0, 20, "sand") + row(500, 500, 20, 100, "clay");
    rows += row(500.1, 500, 0, 21, "sand") + row(500.1, 500, 21, 100, "clay");
    for (const auto& [x, y, base] : bases(*open(rows, kFine), 1)) EXPECT_NEAR(base, 79.75, 0.6) << x << ' ' << y;
}

TEST_F(Layers, one_hole_far_off_does_not_merge_the_others) {
    std::string rows = row(200000, 0, 0, 20, "sand") + row(200000, 0, 20, 100, "clay");
    std::vector<HeightSample> holes;
    for (int n = 0; n < 100; ++n) holes.push_back({100.0 * (n % 10), 100.0 * (n / 10), 60.0 + n % 7});
    for (const auto& [x, y, z] : holes) rows += row(x, y, 0, 100 - z, "sand") + row(x, y, 100 - z, 100, "clay");
    for (const auto& [x, y, base] : bases(*open(rows, kFine), 1))
        for (const auto& hole : holes)
            if (hole.x == x && hole.y == y) {
                EXPECT_NEAR(base, hole.z, 0.13) << x << ' ' << y;
            }
}

TEST_F(Layers, units_may_lie_where_nothing_was_logged) {
    std::string rows;
    for (const double x : {0, 1000})
        for (const double y : {0, 1000})
            rows += row(x, y, 0, 20, "sand") + row(x, y, 20, 50, "clay") + row(x, y, 50, 100, "rock");
    const auto at_middle = [&](const std::string& more, InputLabel label) {
        for (const auto& [x, y, base] : bases(*open(rows + more, kFine), label))
            if (x == 500 && y == 500) return base;
        return std::nan("");
    };
    const std::string gap = row(500, 500, 0, 10, "sand") + row(500, 500, 60, 100, "rock");
    EXPECT_NEAR(at_middle(gap, 1), 80, 0.3) << "as between the other holes";
    EXPECT_NEAR(at_middle(gap, 2), 50, 0.3);
    const std::string narrow = row(500, 500, 0, 10, "sand") + row(500, 500, 30, 100, "rock");
    EXPECT_NEAR(at_middle(narrow, 1), 80, 0.3);
    EXPECT_GE(at_middle(narrow, 2), 69.8) << "rock was logged from there on";
    const std::string missing = row(500, 500, 0, 30, "sand") + row(500, 500, 30, 100, "rock");
    EXPECT_NEAR(at_middle(missing, 1), 70, 0.3);
    EXPECT_NEAR(at_middle(missing, 2), 70, 0.3) << "no clay here";
}

TEST_F(Layers, holes_that_lead_upwards_are_refused) {
    put_text(path("holes.csv"), "hole,from,to,unit\nA,0,10,clay\nA,10,20,sand\nB,0,10,sand\nB,10,20,clay\n");
    put_text(path("collars.csv"), "hole,x,y,z\nA,0,0,0\nB,50,0,20\n");
    put_text(path("surveys.csv"), "hole,depth,azimuth,inclination\nA,0,0,170\nB,0,0,10\n");
    TetrahedraOptions options;
    options.collars = path("collars.csv"), options.surveys = path("surveys.csv");
    try {
        open_layers(path("holes.csv"), options, {});
        FAIL() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("row 2: hole 'A' leads upwards, from 0 to 19.69"));
    }
}

TEST_F(Layers, bases_between_holes_are_near_the_known_surfaces_where_the_nearest_hole_is_far_off) {
    const auto holes = places(60);
    const auto reader = open(folded(holes), kFine);
    EXPECT_THAT(summary_.units, ElementsAre("sand", "clay", "rock"));
    EXPECT_EQ(summary_.ordered_share, 1);
    for (const auto& [label, truth] : {std::pair(1, &upper), std::pair(2, &lower)}) {
        double squares = 0, stairs = 0;
        reader->rewind();
        const auto columns = bases(*reader, label);
        for (const auto& [x, y, base] : columns) {
            squares += std::pow(base - truth(x, y), 2);
            const auto nearest =
                std::min_element(holes.begin(), holes.end(), [x = x, y = y](const auto& a, const auto& b) {
                    return std::hypot(a.x - x, a.y - y) < std::hypot(b.x - x, b.y - y);
                });
            stairs += std::pow(truth(nearest->x, nearest->y) - truth(x, y), 2);
        }
        EXPECT_LT(std::sqrt(squares / static_cast<double>(columns.size())), 1.5) << "metres";
        EXPECT_LT(squares, stairs / 4) << "half the distance of the nearest hole";
    }
}

TEST_F(Layers, contacts_at_the_holes_are_those_that_were_logged) {
    std::vector<HeightSample> holes;
    for (const double x : {100.0, 500.0, 900.0})
        for (const double y : {100.0, 440.0, 800.0}) holes.push_back({x, y, 0});
    const auto reader = open(folded(holes), kFine);
    for (const auto& [x, y, base] : bases(*reader, 2))
        for (const auto& hole : holes)
            if (hole.x == x && hole.y == y) {
                EXPECT_NEAR(base, lower(x, y), 0.126) << x << " " << y;
            }
}

TEST_F(Layers, units_that_would_be_air_or_one_another_are_refused) {
    EXPECT_THAT(failure_of(row(0, 0, 0, 5, "1") + row(0, 0, 5, 9, "0") + row(90, 9, 0, 5, "1")),
                HasSubstr("unit 0 has the number 0, which stands for the air"));
}

TEST_F(Layers, places_beyond_what_can_be_squared_are_refused_whatever_the_box) {
    const LayerOptions options{.spacing = Vec3{10, 10, 10}, .box = {{{0, 100}, {0, 100}, {50, 100}}}};
    EXPECT_THAT(failure_of(row(0, 0, 0, 5, "a") + row(1e200, 0, 0, 5, "b") + row(90, 9, 0, 5, "a"), options),
                HasSubstr("coordinates along x"));
}

TEST_F(Layers, units_pinch_out_in_order) {
    std::string rows;
    for (int n = 0; n < 6; ++n) {  // clay is 20 m thick in the west, and missing in the east
        const double x = 200.0 * n;
        rows += row(x, 0, 0, 30, "sand") + (n < 3 ? row(x, 0, 30, 50, "clay") : "") +
                row(x, 0, n < 3 ? 50 : 30, 100, "rock") + row(x, 300, 0, 30, "sand") +
                (n < 3 ? row(x, 300, 30, 50, "clay") : "") + row(x, 300, n < 3 ? 50 : 30, 100, "rock");
    }
    const auto reader =
        open(rows, {.spacing = Vec3{20, 20, 1}, .box = {{{0, 1000}, {0, 300}, {0, 101}}}, .sweep = SweepChoice::kZ});
    const Lattice lattice = reader->info().lattice;
    const auto labels = labels_of(*reader);
    const std::size_t area = std::size_t{lattice.size[0]} * lattice.size[1];
    for (std::size_t n = 0; n < area; ++n) {
        std::size_t clay = 0;
        for (std::size_t k = 1; k < lattice.size[2]; ++k) EXPECT_LE(labels[k * area + n], labels[(k - 1) * area + n]);
        for (std::size_t k = 0; k < lattice.size[2]; ++k) clay += labels[k * area + n] == 2;
        const double x = 20.0 * static_cast<double>(n % lattice.size[0]);
        if (x <= 400) {
            EXPECT_GE(clay, 15u) << x;
        }
        if (x >= 600) {
            EXPECT_LE(clay, 5u) << x;
        }
        if (x > 460 && x < 540) {
            EXPECT_TRUE(clay > 2 && clay < 18) << "a wedge, at " << x;
        }
    }
}

TEST_F(Layers, holes_that_end_or_begin_inside_a_unit_bound_its_base) {
    const std::string through = row(0, 0, 0, 10, "sand") + row(0, 0, 10, 90, "clay") + row(0, 0, 90, 100, "rock") +
                                row(1000, 0, 0, 10, "sand") + row(1000, 0, 10, 90, "clay") +
                                row(1000, 0, 90, 100, "rock") + row(0, 1000, 0, 10, "sand") +
                                row(0, 1000, 10, 90, "clay") + row(0, 1000, 90, 100, "rock");
    const auto base_at_middle = [&](const std::string& more, InputLabel label) {
        const auto reader = open(through + more, kFine);
        for (const auto& [x, y, base] : bases(*reader, label))
            if (x == 500 && y == 500) return base;
        return std::nan("");
    };
    EXPECT_NEAR(base_at_middle("", 1), 90, 0.2);
    EXPECT_NEAR(base_at_middle(row(500, 500, 0, 5, "sand"), 1), 90, 0.2) << "ends above the base";
    EXPECT_LE(base_at_middle(row(500, 500, 0, 40, "sand"), 1), 60.2) << "ends below it";
    EXPECT_NEAR(base_at_middle(row(500, 500, 0, 5, "clay"), 1), 100, 0.2) << "sand is missing here";
    EXPECT_NEAR(base_at_middle(row(500, 500, 20, 30, "clay"), 1), 90, 0.2) << "not logged above";
    EXPECT_GE(base_at_middle(row(500, 500, 4, 30, "clay"), 1), 95.8) << "sand has ended where the log begins";
    EXPECT_GE(base_at_middle(row(500, 500, 0, 4, "") + row(500, 500, 4, 30, "clay"), 1), 95.8) << "row without a unit";
}

TEST_F(Layers, the_order_is_found_or_given) {
    const std::string rows = row(0, 0, 0, 10, "b") + row(0, 0, 10, 20, "a") + row(0, 0, 20, 30, "c") +
                             row(9, 0, 0, 10, "b") + row(9, 0, 10, 20, "c") + row(9, 9, 0, 10, "a") +
                             row(9, 9, 10, 20, "c");
    EXPECT_EQ(open(rows)->info().names, (LabelNames{{1, "b"}, {2, "a"}, {3, "c"}}));
    EXPECT_THAT(summary_.units, ElementsAre("b", "a", "c"));
    EXPECT_THAT(open(rows, {.units = "a,auto"})->info().warning, HasSubstr("only 86 % of the logged length"));
    EXPECT_THAT(summary_.units, ElementsAre("a", "b", "c"));
    EXPECT_LT(summary_.ordered_share, 1);
    open(rows, {.units = "auto,-c"});
    EXPECT_THAT(summary_.units, ElementsAre("b", "a"));
    EXPECT_EQ(summary_.ordered_share, 1);
    EXPECT_EQ(open(rows, {.units = "auto,-c"})->info().warning, "");
    EXPECT_THAT(failure_of(rows, {.units = "auto,chalk"}),
                HasSubstr("no interval has the unit 'chalk'; units are a, b, c"));
    EXPECT_THAT(failure_of(rows, {.units = "a,a"}, ErrorCode::kUsage), HasSubstr("'a' twice"));
    EXPECT_THAT(failure_of(rows, {.units = "auto,auto"}, ErrorCode::kUsage), HasSubstr("'auto' twice"));
    EXPECT_THAT(failure_of(rows, {.units = "a"}), HasSubstr("fewer than two units"));
    EXPECT_THAT(failure_of(rows, {.units = "b,a"}), HasSubstr("does not name the unit 'c'"));
    EXPECT_THAT(failure_of(rows, {.units = "c,a,b"}), HasSubstr("% of the logged length is in the order"));
}

TEST_F(Layers, units_may_have_commas) {
    const std::string rows =
        row(0, 0, 0, 10, "\"sand, fine, red\"") + row(0, 0, 10, 20, "sand") + row(9, 9, 0, 10, "\"clay, grey\"");
    open(rows, {.units = "clay, grey , sand, fine, red,sand"});
    EXPECT_THAT(summary_.units, ElementsAre("clay, grey", "sand, fine, red", "sand"));
    open(rows, {.units = "sand,-clay, grey,auto"});
    EXPECT_THAT(summary_.units, ElementsAre("sand", "sand, fine, red"));
    EXPECT_THAT(failure_of(rows, {.units = "auto,clay"}), HasSubstr("no interval has the unit 'clay'"));
}

TEST_F(Layers, numbers_stay_labels) {
    const auto reader = open(row(0, 0, 0, 10, "7") + row(0, 0, 10, 20, "3") + row(9, 9, 0, 10, "7"));
    EXPECT_THAT(labels_of(*reader), Each(testing::AnyOf(0, 3, 7)));
    EXPECT_TRUE(reader->info().names.empty());
}

TEST_F(Layers, the_model_fills_a_box_round_the_holes_below_the_ground) {
    const auto reader = open(folded(places(30)));
    const Lattice lattice = reader->info().lattice;
    EXPECT_LT(lattice.origin.x, 10);
    EXPECT_GT(lattice.origin.x + lattice.spacing.x * (lattice.size[0] - 1), 990);
    EXPECT_EQ(lattice.origin.z, 0);
    const auto labels = labels_of(*reader);
    const std::size_t area = std::size_t{lattice.size[0]} * lattice.size[1];
    for (std::size_t n = 0; n < labels.size(); n += 97) {
        const double z = static_cast<double>(n / area) * lattice.spacing.z;
        if (reader->info().sweep == kSweepZ) {
            EXPECT_EQ(labels[n] == 0, z > 100) << z;
        }
    }
}

TEST_F(Layers, heights_count_in_memory_and_evaluations_in_work) {
    const std::string rows = folded(places(20));
    LayerOptions options{.spacing = Vec3{0.1, 0.1, 1}, .memory = 200'000'000};
    EXPECT_THAT(failure_of(rows, options), HasSubstr("columns of 3 surfaces take"));
    EXPECT_THAT(failure_of(rows, options), HasSubstr("more than --memory 200 MB; give a larger --spacing"));
    options = {.spacing = Vec3{10, 10, 1}, .max_work = 100'000};
    EXPECT_THAT(failure_of(rows, options), HasSubstr("more than --max-work 100000; give a larger --spacing"));
    options.max_work = 10'000'000;
    EXPECT_GE(open(rows, options)->info().held_bytes, 3 * 8 * 100 * 100u);
}

TEST_F(Layers, threads_change_nothing) {
    const std::string rows = folded(places(400));
    LayerOptions one = kFine, four = kFine;
    one.threads = 1, four.threads = 4;
    one.spacing = four.spacing = Vec3{50, 50, 0.5};
    const auto alone = open(rows, one), together = open(rows, four);
    EXPECT_EQ(labels_of(*alone), labels_of(*together));
}

TEST_F(Layers, a_bound_where_another_hole_has_the_contact_does_not_move_it) {
    std::string rows;
    for (const double x : {0, 500, 1000})
        for (const double y : {0, 500, 1000}) rows += row(x, y, 0, 50, "sand") + row(x, y, 50, 100, "clay");
    rows += "short,500.0005,500,100,0,80,sand\n";  // beside a hole with clay below 50: at most 80 contradicts 50
    const auto columns = bases(*open(rows, kFine), 1);
    for (const auto& [x, y, base] : columns)
        if (x == 500 && y == 500) {
            EXPECT_NEAR(base, 50, 0.3);
        }
}

TEST_F(Layers, of_two_bounds_at_one_place_the_tighter_holds) {
    std::string rows;
    for (const double x : {0, 1000})
        for (const double y : {0, 1000}) rows += row(x, y, 0, 50, "sand") + row(x, y, 50, 100, "clay");
    rows += "a,500.0005,500,100,0,60,sand\nb,500,500,100,0,80,sand\n";
    const auto columns = bases(*open(rows, kFine), 1);
    for (const auto& [x, y, base] : columns)
        if (x == 500 && y == 500) {
            EXPECT_NEAR(base, 20, 0.3) << "below the end of the deeper hole, at 20";
        }
}

TEST_F(Layers, the_terrain_is_the_top) {
    put_text(path("ground.asc"),
             "NCOLS 2\nNROWS 2\nXLLCORNER -500\nYLLCORNER -500\nCELLSIZE 1000\nNODATA_VALUE -1\n"
             "100 140\n100 140\n");
    LayerOptions options{
        .spacing = Vec3{50, 50, 1}, .box = {{{0, 1000}, {0, 1000}, {0, 150}}}, .sweep = SweepChoice::kZ};
    options.terrain = path("ground.asc");
    const auto reader = open(folded(places(20)), options);
    for (const auto& [x, y, top] : bases(*reader, 0)) EXPECT_NEAR(top, 100 + 40 * x / 1000, 1) << x;
}

TEST_F(Layers, the_unit_is_that_of_the_titles) {
    const auto metres = [&](const std::string& titles) {
        put_text(path("holes.csv"), titles + row(0, 0, 0, 10, "sand") + row(0, 0, 10, 30, "clay") +
                                        row(90, 50, 0, 20, "sand") + row(90, 50, 20, 30, "clay"));
        return coordinates_of(open_layers(path("holes.csv"), {}, {})->info()).metres;
    };
    EXPECT_EQ(metres("hole,x,y,surface,from,to,unit\n"), std::nullopt);
    EXPECT_EQ(metres("hole,x_ft,y_ft,surface_ft,from_ft,to_ft,unit\n"), 0.3048);
    put_text(path("intervals.csv"), "hole,from,to,unit\nA,0,10,sand\nA,10,30,clay\nB,0,20,sand\nB,20,30,clay\n");
    put_text(path("collars.csv"), "hole,x,y,z (ft)\nA,0,0,100\nB,90,50,100\n");
    const auto reader = open_layers(path("intervals.csv"), {.collars = path("collars.csv")}, {});
    EXPECT_EQ(reader->info().metres, 0.3048) << "of collars";
}

TEST_F(Layers, an_open_top_lies_above_the_highest_ground) {
    put_text(path("ground.asc"),
             "ncols 3\nnrows 3\nxllcorner -500\nyllcorner -500\ncellsize 1000\n"
             "100 100 100\n100 180.3 100\n100 100 100\n");
    for (const double step : {0.7, 1.0, 3.0}) {
        LayerOptions options{
            .spacing = Vec3{50, 50, step}, .box = {{{0, 2000}, {0, 2000}, {20}}}, .sweep = SweepChoice::kZ};
        options.terrain = path("ground.asc");
        const auto reader = open(folded(places(20)), options);
        const Lattice& lattice = reader->info().lattice;
        EXPECT_EQ(lattice.origin.z, 20);
        EXPECT_GT(lattice.origin.z + (lattice.size[2] - 1) * lattice.spacing.z, 180.3);
        std::vector<InputLabel> labels = labels_of(*reader);
        EXPECT_EQ(std::count(labels.end() - lattice.size[0] * lattice.size[1], labels.end(), 0),
                  lattice.size[0] * lattice.size[1])
            << "air";
    }
}

TEST_F(Layers, the_model_ends_at_the_box) {
    const auto lattice_of = [&](const std::array<LengthRange, 3>& box) {
        return open(folded(places(20)), {.spacing = Vec3{10, 10, 1}, .box = box})->info().lattice;
    };
    const Lattice both = lattice_of({{{0, 94}, {3, 103}, {0, 50.4}}});
    const Box extent = both.extent();
    EXPECT_NEAR(length(extent.low - Vec3{0, 3, 0}), 0, 1e-9);
    EXPECT_NEAR(length(extent.high - Vec3{94, 103, 50.4}), 0, 1e-9);
    EXPECT_EQ(both.spacing.y, 10);
    LengthRange to_94;
    to_94.high = 94;
    const Lattice high = lattice_of({{to_94, {0, 100}, {0, 50}}});
    EXPECT_NEAR(high.extent().high.x, 94, 1e-9);
    EXPECT_EQ(high.spacing.x, 10);
}

class TerrainFile : public TemporaryFolder {
protected:
    formats::Terrain read(const std::string& text) {
        put_text(path("t.asc"), text);
        return formats::Terrain(path("t.asc"));
    }
    std::string failure_of(const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(TerrainFile, heights_lie_between_the_centres_of_cells) {
    const auto terrain =
        read("ncols 3\r\nnrows 2\r\nxllcenter 10\r\nyllcenter 20\r\ncellsize 2\r\n1 2 3\r\n5 6 -9999\r\n");
    EXPECT_EQ(*terrain.at(10, 20), 5);
    EXPECT_EQ(*terrain.at(12, 22), 2);
    EXPECT_EQ(*terrain.at(11, 21), 3.5);
    EXPECT_FALSE(terrain.at(13.5, 21)) << "next to a cell without height";
}

TEST_F(TerrainFile, heights_reach_to_the_edge_of_the_cells) {
    const auto terrain = read("\xEF\xBB\xBFncols 2\nnrows 2\nxllcorner 9\nyllcorner 19\ncellsize 2\n1 2\n5 6\n");
    EXPECT_EQ(*terrain.at(9, 21), 3) << "as between the centres of the first column";
    EXPECT_EQ(*terrain.at(11, 23), 1.5);
    EXPECT_EQ(*terrain.at(13, 19), 6);
    EXPECT_FALSE(terrain.at(8.9, 21));
    EXPECT_FALSE(terrain.at(11, 23.1));
}

TEST_F(TerrainFile, not_a_number_is_no_height) {
    const std::string head = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
    const auto terrain = read(head + "NODATA_value nan\nnan 2\n3 4\n");
    EXPECT_FALSE(terrain.at(0, 1));
    EXPECT_EQ(*terrain.at(1, 1), 2);
    EXPECT_FALSE(read(head + "NaN 2\n3 4\n").at(0, 1)) << "NaN, where another number stands for none";
    EXPECT_THAT(failure_of("ncols nan\n"), HasSubstr("'ncols' has no number"));
}

TEST_F(TerrainFile, one_larger_than_memory_is_refused_before_its_heights_are_read) {
    std::string text = "ncols 1000\nnrows 1000\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int n = 0; n < 1000 * 1000; ++n) text += "1 ";
    put_text(path("t.asc"), text + "no height\n");
    try {
        formats::Terrain(path("t.asc"), 1 << 20);
        FAIL() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("1000000 heights take 8 MB, more than --memory has left"));
    }
}

TEST_F(TerrainFile, damaged_files_are_refused) {
    const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    EXPECT_THAT(failure_of(head + "1 2\n3 4\n"), HasSubstr("nothing thrown"));
    EXPECT_THAT(failure_of(head + "1 2\n3\n"), HasSubstr("is it cut off"));
    EXPECT_THAT(failure_of(head + "1 2\n3 4 5\n"), HasSubstr("more than 4"));
    EXPECT_THAT(failure_of(head + "1 2\n3 x\n"), HasSubstr("row 2, column 2: 'x' is no height"));
    EXPECT_THAT(failure_of(head + "inf 2\n3 4\n"), HasSubstr("row 1, column 1: 'inf' is no height"));
    EXPECT_THAT(failure_of(head + "NODATA_valu -1\n1 2\n3 4\n"), HasSubstr("'NODATA_valu' is no height"));
    EXPECT_THAT(failure_of("ncols 2\nnrows 2\n1 2 3 4\n"), HasSubstr("no cellsize"));
    EXPECT_THAT(failure_of("ncols 2\nnrows many\n"), HasSubstr("'nrows' has no number"));
    EXPECT_THAT(failure_of("ncols 1\nnrows 2\ncellsize 1\n1 2\n"), HasSubstr("ncols is 1"));
    EXPECT_THAT(failure_of("ncols 900000\nnrows 900000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n"),
                HasSubstr("fewer than"));
    EXPECT_THAT(failure_of(""), HasSubstr("no ncols"));
}

}  // namespace
}  // namespace regionmesh
