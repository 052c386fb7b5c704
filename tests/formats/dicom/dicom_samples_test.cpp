#include "formats/dicom/dicom_samples.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

namespace regionmesh::formats {
namespace {

using testing::ElementsAre;

TEST(DicomSamples, the_first_sample_is_the_lowest_bit) {
    const std::vector<std::byte> packed{std::byte{0b10000001}, std::byte{0b1}};
    std::vector<InputLabel> section(10, 4);
    set_label(packed, 7, section);
    EXPECT_THAT(section, ElementsAre(7, 4, 4, 4, 4, 4, 4, 7, 7, 4));
}

TEST(DicomSamples, bits_beyond_the_section_are_not_written) {
    const std::vector<std::byte> packed(3, std::byte{0xFF});
    std::vector<InputLabel> held(24, 4);
    set_label(packed, 7, std::span(held).first(10));
    EXPECT_EQ(std::ranges::count(held, 7), 10);
}

TEST(DicomSamples, of_label_maps_are_unsigned) {
    const std::uint16_t words[]{3, 65535, 256, 0};
    std::vector<InputLabel> section(4);
    copy_labels(std::as_bytes(std::span(words)), 16, section);
    EXPECT_THAT(section, ElementsAre(3, 65535, 256, 0));
    const std::uint8_t bytes[]{3, 255, 1, 0};
    copy_labels(std::as_bytes(std::span(bytes)), 8, section);
    EXPECT_THAT(section, ElementsAre(3, 255, 1, 0));
}

}  // namespace
}  // namespace regionmesh::formats
