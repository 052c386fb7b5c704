#include "regionmesh/array_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

constexpr ArraySize kSize{4, 3, 2};

/// Sample (x, y, z) is 100 x + 10 y + z.
InputLabel label_at(std::uint32_t x, std::uint32_t y, std::uint32_t z) { return 100 * x + 10 * y + z; }

std::vector<std::vector<InputLabel>> sections_of(SectionReader& reader) {
    std::vector<std::vector<InputLabel>> sections;
    std::vector<InputLabel> section(std::size_t{reader.section_width()} * reader.section_height());
    while (reader.next(section)) sections.push_back(section);
    return sections;
}

/// Fails unless the reader gives label_at() everywhere, along its sweep.
void expect_labels(SectionReader& reader) {
    const auto& axes = reader.info().sweep.axes;
    const auto sections = sections_of(reader);
    ASSERT_EQ(sections.size(), kSize[axes[2]]);
    ArraySize at{};
    for (at[axes[2]] = 0; at[axes[2]] < kSize[axes[2]]; ++at[axes[2]]) {
        std::size_t n = 0;
        for (at[axes[1]] = 0; at[axes[1]] < kSize[axes[1]]; ++at[axes[1]])
            for (at[axes[0]] = 0; at[axes[0]] < kSize[axes[0]]; ++at[axes[0]])
                EXPECT_EQ(sections[at[axes[2]]][n++], label_at(at[0], at[1], at[2]));
    }
}

TEST(ArraySections, refuse_room_for_another_section) {
    const std::vector<std::uint8_t> samples(24);
    const auto reader = open_array(label_array(samples.data(), kSize), {.sweep = SweepChoice::kZ});
    std::vector<InputLabel> section(11);
    EXPECT_THROW(reader->next(section), Error);
}

template <class T>
class ArraySectionsOf : public testing::Test {};
using SampleTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                   std::int64_t, std::uint64_t>;
TYPED_TEST_SUITE(ArraySectionsOf, SampleTypes);

TYPED_TEST(ArraySectionsOf, give_extreme_labels_bit_for_bit) {
    constexpr TypeParam kLow = std::numeric_limits<TypeParam>::min(), kHigh = std::numeric_limits<TypeParam>::max();
    const std::vector<TypeParam> samples{kLow, kHigh, 0, 1, 2, 3, 4, 5};
    const auto reader = open_array(label_array(samples.data(), {2, 2, 2}), {.sweep = SweepChoice::kZ});
    EXPECT_EQ(reader->info().type, sample_type_of<TypeParam>());
    EXPECT_THAT(sections_of(*reader),
                ElementsAre(ElementsAre(static_cast<InputLabel>(kLow), static_cast<InputLabel>(kHigh), 0, 1),
                            ElementsAre(2, 3, 4, 5)));
    EXPECT_EQ(table_for(reader->info()).is_unsigned(), (std::is_same_v<TypeParam, std::uint64_t>));
}

TEST(ArraySections, sweep_along_every_axis) {
    std::vector<std::int16_t> samples;
    for (std::uint32_t z = 0; z < kSize[2]; ++z)
        for (std::uint32_t y = 0; y < kSize[1]; ++y)
            for (std::uint32_t x = 0; x < kSize[0]; ++x)
                samples.push_back(static_cast<std::int16_t>(label_at(x, y, z)));
    for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ, SweepChoice::kAuto}) {
        const auto reader = open_array(label_array(samples.data(), kSize), {.sweep = sweep});
        expect_labels(*reader);
        reader->rewind();
        expect_labels(*reader);
    }
    EXPECT_EQ(open_array(label_array(samples.data(), kSize))->info().sweep, kSweepX) << "2 x 3 is the smallest section";
}

TEST(ArraySections, follow_strides_of_other_orders_and_gaps) {
    // z fastest, every second sample used.
    std::vector<std::int32_t> gaps(2 * 4 * 3 * 2, -1);
    const auto place = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return 2 * ((x * 3 + y) * 2 + z); };
    for (std::uint32_t x = 0; x < 4; ++x)
        for (std::uint32_t y = 0; y < 3; ++y)
            for (std::uint32_t z = 0; z < 2; ++z) gaps[place(x, y, z)] = static_cast<std::int32_t>(label_at(x, y, z));
    for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ})
        expect_labels(*open_array(label_array(gaps.data(), kSize, {48, 16, 8}), {.sweep = sweep}));
}

TEST(ArraySections, follow_negative_and_zero_strides) {
    const std::vector<std::uint8_t> samples{1, 2, 3, 4};
    const LabelArray backwards = label_array(samples.data() + 3, {4, 1, 2}, {-1, 1, 0});
    const auto reader = open_array(backwards, {.sweep = SweepChoice::kZ});
    EXPECT_THAT(sections_of(*reader), ElementsAre(ElementsAre(4, 3, 2, 1), ElementsAre(4, 3, 2, 1)));
}

TEST(ArraySections, need_no_alignment) {
    const std::vector<std::uint8_t> bytes{0xEE, 0x01, 0x02, 0x03, 0x04};
    const LabelArray array{bytes.data() + 1, SampleType::kU16, {2, 1, 1}, {2, 4, 4}};
    const auto reader = open_array(array, {.sweep = SweepChoice::kZ});
    std::uint16_t first;
    std::memcpy(&first, bytes.data() + 1, 2);
    EXPECT_EQ(sections_of(*reader)[0][0], first);
}

TEST(ArraySections, see_the_memory_of_the_caller) {
    std::vector<std::uint8_t> samples(8, 1);
    const auto reader = open_array(label_array(samples.data(), {2, 2, 2}));
    samples[0] = 7;
    EXPECT_EQ(sections_of(*reader)[0][0], 7) << "the array is not copied";
}

TEST(ArraySections, reconstruct_like_any_volume) {
    test::ArrayVolume volume = test::grain_volume({9, 8, 7}, 5, 3);
    const std::array<double, 9> turned{0, -1, 0, 1, 0, 0, 0, 0, 1};
    volume.spaced({1, 2, 3});
    volume.lattice().origin = {5, 6, 7};
    volume.lattice().direction = turned;
    const auto reader = open_array(label_array(volume.labels().data(), volume.size()), {.spacing = {1, 2, 3},
                                                                                        .origin = {5, 6, 7},
                                                                                        .direction = turned,
                                                                                        .sweep = SweepChoice::kZ,
                                                                                        .names = {{1, "one"}},
                                                                                        .name = "grains"});
    EXPECT_EQ(reader->info().names.at(1), "one");
    EXPECT_EQ(reader->info().source, "grains");
    const Reconstruction made = reconstruct(*reader, test::reduced(0.5)), same = test::run(volume, test::reduced(0.5));
    test::expect_sound(made.report.check);
    ASSERT_EQ(made.mesh.vertex_count(), same.mesh.vertex_count());
    for (std::uint32_t v = 0; v < made.mesh.vertex_end(); ++v)
        EXPECT_EQ(made.mesh.position(VertexId{v}), same.mesh.position(VertexId{v}));
}

std::string refusal(const LabelArray& array, const ArrayOptions& options = {}) {
    try {
        open_array(array, options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "not refused";
}

TEST(ArraySections, refuse_arrays_that_cannot_be_read) {
    const std::vector<std::uint8_t> samples(8, 1);
    const LabelArray good = label_array(samples.data(), {2, 2, 2});
    EXPECT_THAT(refusal(label_array(samples.data(), {2, 0, 2})), HasSubstr("size is 2 x 0 x 2"));
    EXPECT_THAT(refusal({nullptr, SampleType::kU8, {2, 2, 2}, {1, 2, 4}}), HasSubstr("no data"));
    EXPECT_THAT(refusal({samples.data(), SampleType::kU1, {2, 2, 2}, {1, 2, 4}}), HasSubstr("single bits"));
    EXPECT_THAT(refusal(good, {.spacing = {1, 0, 1}, .name = "ct"}), HasSubstr("ct: the spacing along y is 0"));
    EXPECT_THAT(refusal(good, {.origin = {1, 0, HUGE_VAL}}), HasSubstr("origin"));
    EXPECT_THAT(refusal(good, {.direction = {NAN}}), HasSubstr("direction"));
    for (const double metres : {0.0, -1.0, 1e-300, double{NAN}})
        EXPECT_THAT(refusal(good, {.metres = metres}), HasSubstr("metres are out of range")) << metres;
    EXPECT_THAT(refusal(good, {.direction = {10, 0, 0, 0, 1, 0, 0, 0, 1}}), HasSubstr("not of length 1"));
    EXPECT_EQ(refusal(good, {.direction = {0.6, 0.800001, 0, -0.8, 0.6, 0, 0, 0, 1}}), "not refused");
}

}  // namespace
}  // namespace regionmesh
