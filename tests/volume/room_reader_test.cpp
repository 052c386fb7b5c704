#include "volume/room_reader.h"

#include <gtest/gtest.h>

#include "support/runs.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

std::vector<InputLabel> cleaned(test::ArrayVolume volume, double room, std::uint32_t threads = 1) {
    RoomReader reader(volume, room, threads);
    std::vector<InputLabel> all, section(std::size_t{reader.section_width()} * reader.section_height());
    while (reader.next(section)) all.insert(all.end(), section.begin(), section.end());
    std::uint64_t changed = 0;
    for (std::size_t n = 0; n < all.size(); ++n) changed += all[n] != volume.labels()[n];
    EXPECT_EQ(reader.changed(), changed);
    return all;
}

/// A half space below z = 5 with a bump of one sample, and a hole far below.
test::ArrayVolume half_space() {
    std::vector<InputLabel> labels;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x) labels.push_back(z < 5 || (z == 5 && y == 4 && x == 4));
    labels[81 + 4 * 9 + 4] = 7;
    return {{9, 9, 12}, std::move(labels)};
}

TEST(RoomReader, takes_away_what_stands_out_and_keeps_what_is_plane) {
    const test::ArrayVolume volume = half_space();
    const std::vector<InputLabel> clean = cleaned(volume, 1);
    for (int z = 0; z < 12; ++z)
        for (int n = 0; n < 81; ++n) EXPECT_EQ(clean[81 * z + n], z < 5 ? 1 : 0) << z << " " << n;
}

TEST(RoomReader, changes_no_sample_beyond_the_room) {
    // A sheet four samples thick in noise: its middle layers lie 1.5 from its sides.
    test::ArrayVolume noise = test::noise_volume({10, 10, 14}, 2, 3);
    std::vector<InputLabel> labels(noise.labels().begin(), noise.labels().end());
    for (int n = 5 * 100; n < 9 * 100; ++n) labels[n] = 5;
    const std::vector<InputLabel> clean = cleaned({{10, 10, 14}, labels}, 1.4);
    for (int n = 6 * 100; n < 8 * 100; ++n) EXPECT_EQ(clean[n], 5);
}

TEST(RoomReader, measures_lengths_in_the_finest_spacing) {
    test::ArrayVolume volume = half_space();
    volume.lattice().spacing = {1, 1, 5};  // the next section lies 2.5 beyond the boundary
    EXPECT_EQ(cleaned(volume, 1)[5 * 81 + 4 * 9 + 4], 0) << "its neighbours in the section outweigh it";
    EXPECT_EQ(cleaned(volume, 1)[4 * 81 + 4 * 9 + 4], 1);
}

/// A sheet of one sample between two regions of equal weight goes to the smaller label; -1 has the bits of the largest.
TEST(RoomReader, gives_ties_to_the_smaller_label) {
    std::vector<InputLabel> labels;
    for (const InputLabel label : {-1, -1, 5, 2, 2}) labels.insert(labels.end(), 49, label);
    test::ArrayVolume volume({7, 7, 5}, labels);
    EXPECT_EQ(cleaned(volume, 2)[2 * 49 + 3 * 7 + 3], -1);
    EXPECT_EQ(cleaned(volume.unsigned_labels(), 2)[2 * 49 + 3 * 7 + 3], 2);
}

TEST(RoomReader, does_not_depend_on_threads_or_on_rewinding) {
    test::ArrayVolume volume = test::noise_volume({12, 11, 10}, 4, 3);
    const std::vector<InputLabel> once = cleaned(volume, 2);
    EXPECT_EQ(cleaned(volume, 2, 3), once);
    RoomReader reader(volume, 2, 2);
    std::vector<InputLabel> section(12 * 11);
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(reader.next(section));
    reader.rewind();
    ASSERT_TRUE(reader.next(section));
    EXPECT_TRUE(std::equal(section.begin(), section.end(), once.begin()));
}

TEST(Room, gives_a_sound_model_of_the_cleaned_labels) {
    test::ArrayVolume volume = test::noise_volume({10, 10, 10}, 3, 4);
    ReconstructOptions options{.reduce = 0.5, .background = {}};
    options.room = 1;
    const Reconstruction made = test::run(volume, options);
    test::expect_sound(made.report.check);
    EXPECT_GT(made.report.samples_in_room, 0u);
    EXPECT_EQ(made.report.samples.value().wrong, 0u);
}

}  // namespace
}  // namespace regionmesh
