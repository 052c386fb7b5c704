#include "regionmesh/select_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "regionmesh/array_sections.h"
#include "regionmesh/error.h"
#include "regionmesh/reconstruct.h"
#include "support/digest.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using test::ArrayVolume;
using test::TextVolume;
using testing::ElementsAre;
using testing::HasSubstr;

/// The sections as text: rows apart by blanks, sections by slashes.
std::string text_of(SectionReader& reader) {
    std::string text;
    std::vector<InputLabel> section(std::size_t{reader.section_width()} * reader.section_height());
    while (reader.next(section)) {
        if (!text.empty()) text += " / ";
        for (std::size_t n = 0; n < section.size(); ++n) {
            if (n > 0 && n % reader.section_width() == 0) text += ' ';
            text += section[n] < 0 ? '-' : static_cast<char>('0' + section[n]);
        }
    }
    return text;
}

std::unique_ptr<SectionReader> selected(ArrayVolume volume, const Selection& selection) {
    return select_sections(std::make_unique<ArrayVolume>(std::move(volume)), selection);
}

/// The text of the selection; read twice, it must be the same.
std::string result_of(ArrayVolume volume, const Selection& selection) {
    const auto reader = selected(std::move(volume), selection);
    const std::string text = text_of(*reader);
    reader->rewind();
    EXPECT_EQ(text_of(*reader), text);
    return text;
}

std::string refusal_of(ArrayVolume volume, const Selection& selection) {
    try {
        selected(std::move(volume), selection);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "accepted";
}

/// One section.
TextVolume rows(const TextVolume::Section& section) { return TextVolume(std::vector<TextVolume::Section>{section}); }

TextVolume digits() { return TextVolume({{"123", "456"}, {"789", "012"}, {"345", "678"}}); }

TEST(SelectSections, nothing_chosen_is_the_reader_itself) {
    auto reader = std::make_unique<ArrayVolume>(digits());
    const SectionReader* address = reader.get();
    EXPECT_EQ(select_sections(std::move(reader), {}).get(), address);
}

TEST(SelectSections, roi_keeps_the_samples_and_their_places) {
    ArrayVolume volume = digits().spaced({1, 2, 4});
    volume.lattice().origin = {10, 20, 30};
    volume.lattice().direction = {0, -1, 0, 1, 0, 0, 0, 0, 1};  // x of the file is y of the model
    const Selection selection{.roi = {{{1, 3}, {0, 0}, {1, 2}}}};
    EXPECT_EQ(result_of(volume, selection), "89 12");
    const Lattice lattice = selected(volume, selection)->info().lattice;
    EXPECT_THAT(lattice.size, ElementsAre(2, 2, 1));
    EXPECT_EQ(lattice.origin, (Vec3{10, 21, 34}));
    EXPECT_EQ(lattice.spacing, (Vec3{1, 2, 4}));
}

TEST(SelectSections, roi_is_the_same_along_every_sweep) {
    for (const Sweep sweep : {kSweepX, kSweepY, kSweepZ}) {
        ArrayVolume volume = digits().swept(sweep);
        const auto reader = selected(volume, {.roi = {{{1, 3}, {0, 1}, {1, 3}}}});
        std::vector<InputLabel> section(std::size_t{reader->section_width()} * reader->section_height());
        std::vector<InputLabel> all;
        while (reader->next(section)) all.insert(all.end(), section.begin(), section.end());
        std::sort(all.begin(), all.end());
        EXPECT_THAT(all, ElementsAre(4, 5, 8, 9));
    }
}

TEST(SelectSections, box_keeps_the_samples_inside) {
    ArrayVolume volume = digits().spaced({1, 2, 4});
    volume.lattice().origin = {10, 20, 30};
    EXPECT_EQ(result_of(volume, {.box = {{{10.5, 12}, {}, {31, 34}}}}), "89 12");
    volume.lattice().direction = {0, 1, 0, -1, 0, 0, 0, 0, 1};  // x of the file is -y of the model
    EXPECT_EQ(result_of(volume, {.box = {{{}, {18, 19}, {30, 30}}}}), "23 56");
    EXPECT_THAT(refusal_of(volume, {.box = {{{}, {}, {50, 60}}}}), HasSubstr("along z the samples lie from 30"));
    EXPECT_THAT(refusal_of(volume, {.box = {{{}, {18.2, 18.4}, {}}}}), HasSubstr("--box holds no sample"));
}

TEST(SelectSections, box_of_an_oblique_volume_is_enclosed) {
    ArrayVolume volume({9, 9, 9}, std::vector<InputLabel>(9 * 9 * 9, 1));
    const auto kept = [&](const std::array<double, 9>& direction, const std::array<LengthRange, 3>& box) {
        volume.lattice().direction = direction;
        return selected(volume, {.box = box})->info().lattice.size;
    };
    const std::array<LengthRange, 3> box{{{2.5, 5.5}, {2.5, 5.5}, {2.5, 5.5}}};
    EXPECT_THAT(kept({0, 1, 0, 1, 0, 0, 0, 0, 1}, box), ElementsAre(3, 3, 3)) << "3 to 5, inside";
    // Turned about z by atan(3/4): 0.8 x + 0.6 y is 3.5 to 7.7, 0.8 y - 0.6 x is -1.3 to 2.9, and z 2.5 to 5.5.
    EXPECT_THAT(kept({0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}, box), ElementsAre(6, 4, 5)) << "3 to 8, 0 to 3, 2 to 6";
}

TEST(SelectSections, box_follows_the_axes_of_a_sheared_volume) {
    ArrayVolume volume = digits();
    volume.lattice().direction = {1, 0.6, 0, 0, 0.8, 0, 0, 0, 1};  // rows of samples along x, 0.8 apart
    EXPECT_EQ(result_of(volume, {.box = {{{}, {0.8, 0.8}, {0, 0}}}}), "456");
}

TEST(SelectSections, ranges_outside_the_volume_are_refused) {
    EXPECT_THAT(refusal_of(digits(), {.roi = {{{0, 4}, {}, {}}}}),
                HasSubstr("--roi 0:4 along x is not within the 3 samples; give a part of 0:3"));
    EXPECT_THAT(refusal_of(digits(), {.roi = {{{}, {2, 0}, {}}}}), HasSubstr("--roi 2:2 along y"));
}

TEST(SelectSections, labels_are_merged_then_chosen) {
    const Selection selection{
        .merge = {{1, 5}, {2, 5}}, .names = {{5, "joined"}}, .labels = {{5, 6}, {8, 8}}, .rest = 0};
    EXPECT_EQ(result_of(digits(), selection), "550 056 / 080 055 / 005 608");
    EXPECT_EQ(selected(digits(), selection)->info().names.at(5), "joined");
}

TEST(SelectSections, ranges_of_unsigned_labels_go_beyond_signed_ones) {
    const InputLabel large = static_cast<InputLabel>(std::uint64_t{1} << 63);
    const std::vector<std::uint64_t> samples{1, std::uint64_t{1} << 63, 7, 8};
    const auto reader = select_sections(open_array(label_array(samples.data(), {4, 1, 1}), {.sweep = SweepChoice::kZ}),
                                        {.labels = {{8, large}}, .rest = 2});
    std::vector<InputLabel> section(4);
    ASSERT_TRUE(reader->next(section));
    EXPECT_THAT(section, ElementsAre(2, large, 2, 8));
}

TEST(SelectSections, downsampling_takes_the_most_frequent_label) {
    // The blocks: 1 has most; a tie of 2 and 3; a tie with the background; a tie of 3 and 4 at the high side.
    const TextVolume volume = rows({"11233", "10234", "00554", "20557"});
    const Selection selection{.downsample = {2, 2, 1}};
    const auto reader = selected(volume, selection);
    EXPECT_THAT(reader->info().lattice.size, ElementsAre(3, 2, 1));
    EXPECT_EQ(reader->info().lattice.spacing, (Vec3{2, 2, 1}));
    EXPECT_EQ(reader->info().lattice.origin, (Vec3{0.5, 0.5, 0}));
    EXPECT_EQ(text_of(*reader), "123 054");
    EXPECT_EQ(result_of(rows({"00", "11"}), {.downsample = {2, 2, 1}}), "1");
    EXPECT_EQ(result_of(TextVolume({{"0"}, {"3"}, {"3"}, {"2"}, {"1"}}), {.downsample = {1, 1, 3}}), "3 / 1");
}

TEST(SelectSections, small_regions_join_the_longest_interface) {
    // 5 touches 1 along two samples and 2 along one; the single 3 has equally much of 1 and 2.
    EXPECT_EQ(result_of(rows({"1111", "1522", "1222"}), {.min_region = 2}), "1111 1122 1222");
    EXPECT_EQ(result_of(rows({"11322", "11322"}), {.min_region = 3}), "11122 11122");
    EXPECT_EQ(result_of(rows({"132", "132"}), {.min_region = 2}), "132 132");
    // Areas count: along z the faces between samples are four times as large.
    ArrayVolume volume = TextVolume({{"111", "131", "111"}, {"222", "222", "222"}}).spaced({8, 8, 1});
    EXPECT_EQ(result_of(volume, {.min_region = 2}), "111 121 111 / 222 222 222");
    EXPECT_EQ(result_of(volume.spaced({1, 1, 1}), {.min_region = 2}), "111 111 111 / 222 222 222");
}

TEST(SelectSections, small_neighbours_grow_together) {
    // 3 has more interface with 4 than with 1; the two samples of each make a region that is large enough.
    EXPECT_EQ(result_of(rows({"33111", "44111", "11111"}), {.min_region = 3}), "44111 44111 11111");
    EXPECT_EQ(result_of(rows({"33111", "44111", "11111"}), {.min_region = 5}), "11111 11111 11111");
    EXPECT_EQ(result_of(rows({"0000", "0120", "0120", "0000"}), {.min_region = 3}), "0000 0000 0000 0000");
    // A volume of one small region has no neighbour to join.
    EXPECT_EQ(result_of(rows({"33"}), {.min_region = 9}), "33");
}

TEST(SelectSections, of_several_labels_the_smallest_wins_by_its_sign) {
    // -1 has the bits of the largest unsigned label.
    const auto volume = [] { return ArrayVolume({5, 1, 1}, {-1, -1, 7, 3, 3}); };
    const Selection small{.min_region = 2}, blocks{.downsample = {4, 1, 1}};
    EXPECT_EQ(result_of(volume(), small), "---33");
    EXPECT_EQ(result_of(volume().unsigned_labels(), small), "--333");
    const auto tie = [] { return ArrayVolume({4, 1, 1}, {-1, -1, 3, 3}); };
    EXPECT_EQ(result_of(tie(), blocks), "-");
    EXPECT_EQ(result_of(tie().unsigned_labels(), blocks), "3");
}

TEST(SelectSections, samples_are_connected_as_in_the_mesh) {
    // Kuhn's tetrahedra have the diagonal from low to high, not the other.
    EXPECT_EQ(result_of(rows({"2220", "2122", "2212", "2222"}), {.min_region = 2}), "2222 2122 2212 2222");
    EXPECT_EQ(result_of(rows({"2222", "2212", "2122", "2222"}), {.min_region = 2}), "2222 2222 2222 2222");
}

/// The regions of the result, each with fewest samples, counted by brute force.
std::uint64_t smallest_region(SectionReader& reader) {
    const std::uint32_t width = reader.section_width(), height = reader.section_height(),
                        depth = reader.section_count();
    std::vector<InputLabel> all(std::size_t{width} * height * depth);
    for (std::uint32_t s = 0; s < depth; ++s)
        reader.next(std::span(all).subspan(std::size_t{s} * width * height, std::size_t{width} * height));
    std::vector<bool> seen(all.size());
    std::uint64_t smallest = all.size();
    for (std::size_t start = 0; start < all.size(); ++start) {
        if (seen[start]) continue;
        std::vector<std::size_t> open{start};
        seen[start] = true;
        std::uint64_t count = 0;
        while (!open.empty()) {
            const std::size_t n = open.back();
            open.pop_back();
            ++count;
            const std::int64_t x = n % width, y = n / width % height, z = n / width / height;
            for (int step = 1; step < 8; ++step)
                for (const int sign : {-1, 1}) {
                    const std::int64_t i = x + sign * (step & 1), j = y + sign * (step >> 1 & 1),
                                       k = z + sign * (step >> 2);
                    if (i < 0 || j < 0 || k < 0 || i >= width || j >= height || k >= depth) continue;
                    const std::size_t other = (static_cast<std::size_t>(k) * height + j) * width + i;
                    if (seen[other] || all[other] != all[n]) continue;
                    seen[other] = true;
                    open.push_back(other);
                }
        }
        smallest = std::min(smallest, count);
    }
    return smallest;
}

TEST(SelectSections, no_small_region_is_left_in_noise) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE(seed);
        const ArrayVolume noise = test::noise_volume({9, 8, 7}, 4, seed);
        EXPECT_EQ(smallest_region(*selected(noise, {})), 1u);
        EXPECT_GE(smallest_region(*selected(noise, {.min_region = 5})), 5u);
        ArrayVolume swept = noise;
        EXPECT_GE(smallest_region(*selected(swept.swept(kSweepX), {.min_region = 5})), 5u);
    }
}

TEST(SelectSections, small_regions_need_a_volume_that_rewinds) {
    ArrayVolume volume = digits();
    EXPECT_THAT(refusal_of(volume.once(), {.min_region = 2}), HasSubstr("leave out --min-region"));
}

TEST(SelectSections, a_selection_is_reconstructed_like_the_volume_it_gives) {
    const ArrayVolume grains = test::grain_volume({20, 18, 16}, 6, 7, 1);
    const auto chosen = selected(grains, {.roi = {{{4, 16}, {3, 15}, {2, 14}}}, .labels = {{1, 3}}, .rest = 0});
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 2; z < 14; ++z)
        for (std::uint32_t y = 3; y < 15; ++y)
            for (std::uint32_t x = 4; x < 16; ++x) labels.push_back(grains.at(x, y, z) <= 3 ? grains.at(x, y, z) : 0);
    ArrayVolume same({12, 12, 12}, labels);
    same.lattice().origin = {4, 3, 2};
    const Reconstruction a = reconstruct(*chosen, {.reduce = 0.5}), b = reconstruct(same, {.reduce = 0.5});
    EXPECT_EQ(a.report.check.violation_count(), 0u);
    EXPECT_GT(a.report.final_faces, 0u);
    EXPECT_EQ(a.report.final_faces, b.report.final_faces);
    EXPECT_EQ(test::digest(a.mesh), test::digest(b.mesh));
}

TEST(SelectSections, refuses_ranges_that_no_volume_has) {
    const auto refused = [](const Selection& selection) {
        EXPECT_THROW(selected(test::solid_volume({4, 4, 4}), selection), Error);
    };
    refused({.downsample = {1, 0, 1}});
    refused({.box = {LengthRange{0, std::nan("")}, {}, {}}});
    refused({.labels = {{5, 2}}});
}

}  // namespace
}  // namespace regionmesh
