#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class Contours : public TemporaryFolder {
protected:
    /// Rows of a square of side 2 * `half` round the origin.
    static std::string square(const std::string& label, int contour, double z, double half) {
        std::string rows;
        for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            rows += label + "," + std::to_string(contour) + "," + std::to_string(x * half) + "," +
                    std::to_string(y * half) + "," + std::to_string(z) + "\n";
        return rows;
    }
    std::filesystem::path put(const std::string& name, const std::string& text) {
        put_text(path(name), text);
        return path(name);
    }
    static ReadOptions pitched(double pitch) {
        ReadOptions options;
        options.pitch = pitch;
        return options;
    }
    /// Area of the label in a section.
    static double area(const Volume& volume, std::uint32_t section, InputLabel label) {
        const auto& size = volume.info.lattice.size;
        const std::size_t count = std::size_t{size[0]} * size[1];
        const auto first = volume.labels.begin() + static_cast<std::ptrdiff_t>(section * count);
        return static_cast<double>(std::count(first, first + static_cast<std::ptrdiff_t>(count), label)) *
               volume.info.lattice.spacing.x * volume.info.lattice.spacing.y;
    }
};

const std::string kContourTitles = "label,contour,x,y,z\n";

TEST_F(Contours, of_a_table_are_a_volume_with_an_empty_margin) {
    const auto file = put("a.csv", kContourTitles + square("box", 0, 0, 5) + square("box", 1, 3, 5));
    EXPECT_EQ(kind_of_input({file.string()}), kVolumeInput);
    const Volume volume = read_volume({file}, pitched(0.5));
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{22, 22, 4}));
    EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.5, 0.5, 3}));
    EXPECT_EQ(volume.info.lattice.origin, (Vec3{-5.25, -5.25, -3}));
    EXPECT_EQ(volume.info.names, (LabelNames{{1, "box"}}));
    for (const std::uint32_t section : {0u, 3u}) EXPECT_EQ(area(volume, section, 1), 0);
    for (const std::uint32_t section : {1u, 2u}) EXPECT_EQ(area(volume, section, 1), 100);
    const auto& size = volume.info.lattice.size;
    for (std::uint32_t y = 0; y < size[1]; ++y) EXPECT_EQ(volume.labels[(size[1] + y) * size[0]], 0);
}

TEST_F(Contours, within_one_another_are_holes_and_islands_and_a_keyhole_is_a_hole) {
    const auto rings =
        put("rings.csv", kContourTitles + square("7", 0, 0, 6) + square("7", 1, 0, 4) + square("7", 2, 0, 2));
    EXPECT_EQ(area(read_volume({rings}, pitched(0.25)), 1, 7), 144 - 64 + 16);
    // Out, along a channel into the hole, round it, and back.
    const auto keyhole = put("keyhole.json", R"({"unit": "mm", "regions": [{"label": 7, "contours": [{"z": 0, "points":
        [[-6, 0], [-6, -6], [6, -6], [6, 6], [-6, 6], [-6, 0], [-4, 0], [-4, 4], [4, 4], [4, -4], [-4, -4], [-4, 0]]
        }]}]})");
    const Volume volume = read_volume({keyhole}, pitched(0.25));
    EXPECT_EQ(area(volume, 1, 7), 144 - 64);
    EXPECT_EQ(volume.info.metres, 1e-3);
}

TEST_F(Contours, of_a_circle_have_its_area_at_the_pitch_they_choose) {
    std::string points;
    for (int n = 0; n < 360; ++n)
        points += (n == 0 ? "[" : ",[") + std::to_string(50 * std::cos(n * std::numbers::pi / 180)) + "," +
                  std::to_string(50 * std::sin(n * std::numbers::pi / 180)) + ",1]";
    const auto file = put("disc.json", "{\"regions\":[{\"name\":\"disc\",\"contours\":[[" + points + "]]}]}");
    const Volume volume = read_volume({file});
    EXPECT_NEAR(volume.info.lattice.spacing.x, 50 * std::numbers::pi / 180, 1e-3);
    EXPECT_NEAR(area(volume, 1, 1), std::numbers::pi * 2500, 0.005 * std::numbers::pi * 2500);
}

TEST_F(Contours, sections_at_other_distances_are_those_nearest_and_a_warning_says_so) {
    const auto file =
        put("far.csv", kContourTitles + square("1", 0, 0, 2) + square("1", 0, 1, 4) + square("1", 0, 4, 6));
    const Volume volume = read_volume({file}, pitched(0.5));
    EXPECT_EQ(volume.info.lattice.size[2], 7u);
    EXPECT_EQ(volume.info.lattice.spacing.z, 1);
    EXPECT_THAT(volume.info.warning, HasSubstr("1 to 3 apart"));
    const std::array<double, 5> halves{2, 4, 4, 6, 6};
    for (std::uint32_t section = 1; section < 6; ++section)
        EXPECT_EQ(area(volume, section, 1), 4 * halves[section - 1] * halves[section - 1]);
}

TEST_F(Contours, that_overlap_are_counted_and_follow_priority) {
    const auto file = put("both.csv", kContourTitles + square("tumour", 0, 0, 2) + square("liver", 0, 0, 5));
    const Volume last = read_volume({file}, pitched(0.5));
    EXPECT_EQ(area(last, 1, 1), 0);
    EXPECT_EQ(last.info.overlaps->samples, (decltype(Overlaps::samples){{{1, 2}, 64}}));
    ReadOptions options = pitched(0.5);
    options.priority = {"tumour"};
    EXPECT_EQ(area(read_volume({file}, options), 1, 1), 16);
}

TEST_F(Contours, that_are_damaged_are_refused_with_their_place) {
    EXPECT_THAT(refusal({put("x.csv", kContourTitles + "a,0,1,2,3\na,0,b,2,3\n")}),
                HasSubstr("x.csv: row 3: x is 'b'; a number is needed"));
    EXPECT_THAT(refusal({put("two.csv", kContourTitles + "a,0,1,2,3\na,0,1,3,3\n")}), HasSubstr("holds no contour"));
    EXPECT_THAT(refusal({put("line.csv", kContourTitles + "a,0,1,2,3\na,0,1,2,3\na,0,1,2,3\n")}),
                HasSubstr("enclose no area"));
    EXPECT_THAT(refusal({put("a.json", "{}")}), HasSubstr("is JSON, but no contours"));
    EXPECT_THAT(refusal({put("b.json", "{\"regions\": [{}]}")}), HasSubstr("contours"));
    EXPECT_THAT(refusal({put("c.json", "{\"regions\": [{\"contours\": [[[0,0,0],[1,0,0],[1,1,2]]]}]}")}),
                HasSubstr("region 1: contour 0: z is 0 and 2"));
    EXPECT_THAT(refusal({put("d.json", "{\"regions\": [{\"contours\": [[[0,0],[1,0],[1,1]]]}]}")}),
                HasSubstr("a point has 2 numbers"));
    EXPECT_THAT(refusal({put("e.csv", kContourTitles + square("a", 0, 0, 1))}, spaced({1, 1, 1})),
                HasSubstr("give --pitch"));
    EXPECT_THAT(refusal({put("f.csv", kContourTitles + square("a", 0, 0, 1) + square("a", 0, 1e-3, 1) +
                                          square("a", 0, 500, 1))}),
                HasSubstr("would be more than 100,000"));
}

}  // namespace
}  // namespace regionmesh
