#include "boreholes/hole_paths.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boreholes/point_table.h"
#include "formats/temporary_folder.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using formats::HolePath;
using testing::HasSubstr;

void expect_near(Vec3 a, Vec3 b, double error = 1e-9) {
    EXPECT_LT(length(a - b), error) << a.x << " " << a.y << " " << a.z;
}

TEST(HolePathAt, is_straight_along_one_direction) {
    const double s = std::sqrt(0.5);
    const HolePath path({10, 20, 30}, {{5, {s, 0, -s}}});
    expect_near(path.at(0), {10, 20, 30});
    expect_near(path.at(10), {10 + 10 * s, 20, 30 - 10 * s});
}

TEST(HolePathAt, follows_the_arc_of_a_circle_between_two_stations) {
    const double r = 100, quarter = std::numbers::pi / 2 * r;  // from straight down to level, to the north
    const HolePath path({0, 0, 0}, {{0, {0, 0, -1}}, {quarter, {0, 1, 0}}});
    for (const double angle : {0.0, 0.3, 0.9, 1.5})
        expect_near(path.at(angle * r), {0, r * (1 - std::cos(angle)), -r * std::sin(angle)});
    expect_near(path.at(quarter + 50), {0, r + 50, -r});
}

class InclinedHoles : public TemporaryFolder {
protected:
    InclinedHoles() {
        put_text(path("collars.csv"), "HOLEID,EAST,NORTH,ELEV\nA,100,200,50\nB,0,0,40\n");
        put_text(path("surveys.csv"), "HoleID,Depth,Azimuth,Dip\nA,0,90,-60\n");
        put_text(path("intervals.csv"), "hole_id,from,to,lith\nA,0,10,sand\nA,10,30,clay\nB,0,20,sand\n");
        options_.collars = path("collars.csv");
        options_.surveys = path("surveys.csv");
    }

    formats::PointTable read() const { return formats::read_point_table(path("intervals.csv"), options_); }

    std::string failure() const {
        try {
            read();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            return error.what();
        }
        return "nothing thrown";
    }

    TetrahedraOptions options_;
};

TEST_F(InclinedHoles, points_lie_on_the_path) {
    const auto table = read();
    ASSERT_EQ(table.points.positions.size(), 3u);
    expect_near(table.points.positions[0], {100 + 5 * 0.5, 200, 50 - 5 * std::sqrt(0.75)});
    expect_near(table.points.positions[1], {100 + 20 * 0.5, 200, 50 - 20 * std::sqrt(0.75)});
    expect_near(table.points.positions[2], {0, 0, 30});
}

TEST_F(InclinedHoles, inclinations_count_from_straight_down_and_dips_of_either_sign_lead_down) {
    const auto wanted = read().points.positions;
    for (const char* text : {"hole,depth,azi,inclination\nA,0,90,30\n", "hole,md,azimuth,dip\nA,0,90,60\n"}) {
        put_text(path("surveys.csv"), text);
        const auto found = read().points.positions;
        for (std::size_t n = 0; n < wanted.size(); ++n) expect_near(found[n], wanted[n]);
    }
}

TEST_F(InclinedHoles, level_stations_do_not_say_which_dips_lead_down) {
    put_text(path("collars.csv"), "hole,x,y,z\nA,100,200,50\nB,0,0,40\nC,0,50,40\n");
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,-60\nB,0,0,0\nC,0,0,0\n");
    for (const Vec3 p : read().points.positions) EXPECT_LE(p.z, 50);
}

TEST_F(InclinedHoles, tables_beside_intervals_are_as_strict) {
    put_text(path("collars.csv"), "hole,x,y,z\nA,100,5,200,50\nB,0,0,40\n");
    EXPECT_THAT(failure(), HasSubstr("collars.csv: row 2: has 5 fields where there are 4 columns"));
    put_text(path("collars.csv"), "hole,x,X [m],y,z\nA,100,100,200,50\nB,0,0,0,40\n");
    EXPECT_THAT(failure(), HasSubstr("row 1: columns 2 and 3, 'x' and 'X [m]', are both called x"));
    put_text(path("collars.csv"), "hole,x,y,z,Au (ppm),Au (g/t)\nA,100,200,50,1,1\nB,0,0,40,,\n");
    EXPECT_EQ(read().points.positions.size(), 3u) << "columns that are not looked for may have any titles";
    put_text(path("collars.csv"), "hole,x,y,z,remark\nA,100,200,,\nB,0,0,40,,\n");
    EXPECT_THAT(failure(), HasSubstr("row 2: column 'z': '' is no finite number"));
    put_text(path("collars.csv"), "hole,x,y,z\n,100,200,50\nB,0,0,40\n");
    EXPECT_THAT(failure(), HasSubstr("row 2: names no hole"));
}

TEST_F(InclinedHoles, points_within_an_interval_lie_on_the_arc) {
    const double r = 20, quarter = std::numbers::pi / 2 * r;  // from straight down to level, to the north
    put_text(path("surveys.csv"), fmt::format("hole,depth,azimuth,inclination\nB,0,0,0\nB,{},0,90\n", quarter));
    put_text(path("intervals.csv"), fmt::format("hole,from,to,lith\nB,0,{},sand\n", quarter));
    for (const double parts : {1, 8}) {
        options_.step = quarter / parts * 1.0001;
        const auto points = read().points.positions;
        ASSERT_EQ(points.size(), static_cast<std::size_t>(parts));
        for (std::size_t n = 0; n < points.size(); ++n) {
            const double angle = (static_cast<double>(n) + 0.5) / parts * std::numbers::pi / 2;
            expect_near(points[n], {0, r * (1 - std::cos(angle)), 40 - r * std::sin(angle)});
        }
    }
}

TEST_F(InclinedHoles, intervals_are_cut_at_stations) {
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,-90\nA,20,90,-60\n");
    EXPECT_EQ(read().points.positions.size(), 4u);
}

TEST_F(InclinedHoles, inclinations_are_0_to_180_and_dips_minus_90_to_90) {
    put_text(path("surveys.csv"), "hole,depth,azimuth,inclination\nA,0,90,170\n");
    EXPECT_GT(read().points.positions[1].z, 50) << "a hole that is drilled upwards";
    put_text(path("surveys.csv"), "hole,depth,azimuth,inclination\nA,0,90,-30\n");
    EXPECT_THAT(failure(), HasSubstr("row 2: an inclination of -30 degrees; it is 0 (straight down) to 180"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,inclination\nA,0,90,181\n");
    EXPECT_THAT(failure(), HasSubstr("an inclination of 181 degrees"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,91\n");
    EXPECT_THAT(failure(), HasSubstr("a dip of 91 degrees; it is -90 to 90"));
}

TEST_F(InclinedHoles, a_hole_that_turns_back_between_two_stations_is_refused) {
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,0\nA,20,270,0\n");
    EXPECT_THAT(failure(), HasSubstr("row 3: hole 'A' turns back, by 180 degrees, between depths 0 and 20"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,0\nA,10,180,0\nA,20,270,0\n");
    EXPECT_EQ(read().points.positions.size(), 4u);
}

TEST_F(InclinedHoles, repeated_intervals_of_many_stations_are_refused_before_they_take_memory) {
    constexpr int kCount = 5000;
    std::string intervals = "hole,from,to,lith\n", surveys = "hole,depth,azimuth,inclination\n";
    for (int n = 0; n < kCount; ++n) {
        intervals += "A,0,10000,sand\n";
        surveys += "A," + std::to_string(n) + ",90,0\n";
    }
    put_text(path("intervals.csv"), intervals);
    put_text(path("surveys.csv"), surveys);
    EXPECT_THAT(failure(), HasSubstr("intervals of hole 'A' overlap so often that stations cut them into more than"));
}

TEST_F(InclinedHoles, all_tables_have_one_unit_of_length) {
    put_text(path("intervals.csv"), "hole,from_ft,to_ft,lith\nA,0,10,sand\nB,0,20,sand\n");
    EXPECT_EQ(failure(), "nothing thrown") << "the others do not say";
    put_text(path("collars.csv"), "hole,x,y,z (m)\nA,100,200,50\nB,0,0,40\n");
    EXPECT_THAT(failure(),
                HasSubstr("collars.csv: row 1: column 'z (m)' is in another unit of length than 'from_ft' in "));
    put_text(path("collars.csv"), "hole,x,y,z (ft)\nA,100,200,50\nB,0,0,40\n");
    put_text(path("surveys.csv"), "hole,depth (m),azimuth,dip\nA,0,90,-60\n");
    EXPECT_THAT(failure(), HasSubstr("surveys.csv: row 1: column 'depth (m)' is in another unit"));
}

TEST_F(InclinedHoles, errors_name_what_is_missing) {
    put_text(path("collars.csv"), "hole,x,y,z\nA,100,200,50\n");
    EXPECT_THAT(failure(), HasSubstr("row 4: hole 'B' has no row in --collars"));
    put_text(path("collars.csv"), "hole,x,y,z\nA,1,2,5\nA,1,2,6\n");
    EXPECT_THAT(failure(), HasSubstr("row 3: hole 'A' has a collar in row 2, too"));
    put_text(path("collars.csv"), "hole,x,y\nA,1,2\n");
    EXPECT_THAT(failure(), HasSubstr("no column for the elevation"));
    put_text(path("collars.csv"), "hole,x,y,z\nA,100,200,50\nB,0,0,40\n");
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,-100\n");
    EXPECT_THAT(failure(), HasSubstr("a dip of -100 degrees"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nC,0,90,-50\n");
    EXPECT_THAT(failure(), HasSubstr("row 2: hole 'C' has a station but no collar"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,-50\nA,0,80,-50\n");
    EXPECT_THAT(failure(), HasSubstr("two stations at depth 0"));
    put_text(path("surveys.csv"), "hole,depth,azimuth,dip\nA,0,90,-50\n");
    put_text(path("intervals.csv"), "hole,from,to,lith\nA,10,5,sand\n");
    EXPECT_THAT(failure(), HasSubstr("row 2: the bottom has the smaller number"));
    put_text(path("intervals.csv"), "hole,from,to,lith\nA,0,10,sand\nA,5,12,clay\n");
    EXPECT_THAT(failure(), HasSubstr("overlap"));
}

}  // namespace
}  // namespace regionmesh
