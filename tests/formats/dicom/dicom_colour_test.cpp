#include "formats/dicom/dicom_colour.h"

#include <gtest/gtest.h>

namespace regionmesh::formats {
namespace {

/// Values that DCMTK's IODCIELabUtil makes of these colours, as 3D Slicer writes them.
TEST(DicomColour, lab_values_of_other_writers_come_back_as_their_colours) {
    EXPECT_EQ(colour_of_lab({0, 32896, 32896}), 0x000000u);
    EXPECT_EQ(colour_of_lab({65535, 32896, 32896}), 0xFFFFFFu);
    EXPECT_EQ(colour_of_lab({34885, 53486, 50171}), 0xFF0000u);
    EXPECT_EQ(colour_of_lab({21170, 53249, 5174}), 0x0000FFu);
}

TEST(DicomColour, values_outside_srgb_are_clipped) {
    EXPECT_EQ(colour_of_lab({65535, 0, 0}) & 0xFF0000u, 0u) << "red is negative";
    EXPECT_EQ(colour_of_lab({65535, 65535, 65535}) >> 16, 0xFFu);
}

TEST(DicomColour, of_a_palette_are_rounded_to_8_bits) {
    EXPECT_EQ(colour_of_palette({0, 65535, 32767}), 0x00FF7Fu);
    EXPECT_EQ(colour_of_palette({257, 128, 129}), 0x010001u);
}

}  // namespace
}  // namespace regionmesh::formats
