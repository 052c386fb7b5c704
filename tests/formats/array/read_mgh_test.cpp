#include <gmock/gmock.h>

#include <cstring>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class ReadMghTest : public TemporaryFolder {
protected:
    /// A file with one byte of its header changed.
    std::filesystem::path changed(std::size_t place, char byte) {
        std::string bytes = text_of(data("mgh/uint8.mgh"));
        bytes[place] = byte;
        put_text(path("a.mgh"), bytes);
        return path("a.mgh");
    }
    VolumeInfo info_of(const std::filesystem::path& file) { return open_sections({file})->info(); }
};

TEST_F(ReadMghTest, every_type_comes_back_label_for_label) {
    for (const auto& file : files_in("mgh")) expect_as_named(file, "mgh");
}

TEST_F(ReadMghTest, raw_files_sweep_along_every_axis_and_gzipped_ones_along_z) {
    EXPECT_THAT(info_of(data("mgh/uint16.mgh")).can_sweep, ElementsAre(true, true, true));
    EXPECT_THAT(info_of(data("mgh/turned_uint16.mgz")).can_sweep, ElementsAre(false, false, true));
}

TEST_F(ReadMghTest, places_in_space_are_those_of_the_header) {
    const VolumeInfo placed = info_of(data("mgh/turned_int32.mgz"));
    EXPECT_EQ(placed.space, Space::kRas);
    EXPECT_EQ(placed.metres, 1e-3);
    expect_in_space(placed, {10, -20, 30}, {-0.5, 0, 0, 0, 0, 2, 0, -0.75, 0});
    // Without a place FreeSurfer takes coronal sections of 1 mm around 0: 5 x 4 x 3 samples.
    expect_in_space(info_of(data("mgh/uint8.mgh")), {2.5, -1.5, 2}, {-1, 0, 0, 0, 0, 1, 0, -1, 0});
    expect_in_space(open_sections({data("mgh/uint8.mgh")}, spaced({2, 4, 6}))->info(), {5, -9, 8},
                    {-2, 0, 0, 0, 0, 6, 0, -4, 0});
}

TEST_F(ReadMghTest, table_beside_the_file_names_labels) {
    put_text(path("a.txt"), "3 three\n");
    EXPECT_THAT(info_of(changed(283, 0)).names, ElementsAre(Pair(3, "three")));
}

TEST_F(ReadMghTest, bad_files_are_refused_and_say_why) {
    EXPECT_EQ(read_volume({data("mgh/bad/float32.mgz")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({data("mgh/bad/frames.mgz")}), HasSubstr("holds 2 volumes (frames)"));
    EXPECT_THAT(refusal({changed(3, 2)}), HasSubstr("not an MGH file"));
    EXPECT_THAT(refusal({changed(23, 77)}), HasSubstr("of a type that is not read (type 77)"));
    EXPECT_THAT(refusal({changed(4, '\xFF')}), HasSubstr("the header is damaged"));
    EXPECT_THAT(refusal({changed(7, 0)}), HasSubstr("empty volume"));
    EXPECT_THAT(refusal({changed(7, 6)}), HasSubstr("truncated"));
    EXPECT_THAT(refusal({changed(29, 1)}), HasSubstr("map to space")) << "all directions are 0";
    put_text(path("short.mgz"), text_of(data("mgh/uint8.mgh")).substr(0, 100));
    EXPECT_THAT(refusal({path("short.mgz")}), HasSubstr("not an MGH file"));
    put_text(path("cut.mgz"), text_of(data("mgh/turned_uint8.mgz")).substr(0, 40));
    EXPECT_THAT(refusal({path("cut.mgz")}), HasSubstr("cut.mgz"));
}

}  // namespace
}  // namespace regionmesh
