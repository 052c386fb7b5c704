#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "formats/temporary_folder.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

class LabelColoursFile : public TemporaryFolder {
protected:
    LabelColours colours_of(const std::string& text) {
        std::ofstream(path("table")) << text;
        return read_label_colours(path("table"));
    }
};

TEST_F(LabelColoursFile, of_freesurfer_and_slicer) {
    EXPECT_THAT(
        colours_of("#No. Label Name:  R G B A\n0   Unknown  0 0 0 0\n2 Left-Cerebral-White-Matter  245 245 240 0\n"
                   "3  Cortex left 205 62 78 0\n"),
        ElementsAre(Pair(0, 0x000000u), Pair(2, 0xF5F5F0u), Pair(3, 0xCD3E4Eu)));
}

TEST_F(LabelColoursFile, of_itk_snap) {
    EXPECT_THAT(
        colours_of("# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n"
                   "    7   255    128    0        1  1  1    \"Label 1 2 3\"\n"),
        ElementsAre(Pair(0, 0x000000u), Pair(7, 0xFF8000u)));
}

TEST_F(LabelColoursFile, of_tables_with_a_header) {
    EXPECT_THAT(colours_of("index\tname\tcolor\tmapping\n1\tGray Matter\t#FF5733\t1\n2\tWhite Matter\t\t2\n"),
                ElementsAre(Pair(1, 0xFF5733u)))
        << "BIDS";
    EXPECT_THAT(colours_of("label,name,r,g,b\n-4,\"a, b\",1,2,3\n5,c,256,0,0\n"), ElementsAre(Pair(-4, 0x010203u)));
}

TEST_F(LabelColoursFile, of_columns_under_any_of_their_names) {
    EXPECT_THAT(colours_of("LabelValue,Name,Color_R,Color_G,Color_B,Color_A\n1,liver,221,130,101,255\n"),
                ElementsAre(Pair(1, 0xDD8265u)))
        << "3D Slicer";
    EXPECT_THAT(colours_of("blue;red;id;green\n3;1;7;2\n"), ElementsAre(Pair(7, 0x010203u))) << "in any order";
    EXPECT_THAT(colours_of("1\tname\n2\tother\n"), IsEmpty());
    for (const std::string header : {"label,value,color", "structure,num,color"})
        EXPECT_THAT(colours_of(header + "\nliver,3,#ff0000\n"), ElementsAre(Pair(3, 0xFF0000u))) << header;
}

TEST_F(LabelColoursFile, rows_that_are_damaged_have_none) {
    EXPECT_THAT(colours_of("label,name,color\n1,a,#12345\n2,b,#12345G\n3,c,red\n4\n,,\n5,\"d,#000001\n6,e,#000001\n"
                           "99999999999999999999,f,#000001\n6,e,#000002\n"),
                ElementsAre(Pair(6, 0x000001u)));
    EXPECT_THAT(colours_of("label,r,g,b\n1,-1,0,0\n2,0,0\n3,1e2,0,0\n4,0x1,0,0\n5,1,2,3\n"),
                ElementsAre(Pair(5, 0x010203u)));
    EXPECT_THAT(colours_of("0 bg 0 0 0 0\n1 a 300 0 0 255\n2 b 1 2 3 255\n"),
                ElementsAre(Pair(0, 0u), Pair(2, 0x010203u)));
    EXPECT_THAT(colours_of("0 0 0 0 0 0 0 \"x\"\n1 300 0 0 1 1 1 \"a\"\n2 1 2 3 1 1 1 \"b\"\n"),
                ElementsAre(Pair(0, 0u), Pair(2, 0x010203u)));
    EXPECT_THAT(colours_of(std::string("label,color\n1,\0#000001\n", 23)), IsEmpty());
    EXPECT_THAT(colours_of(std::string(100000, '"')), IsEmpty());
    EXPECT_THAT(colours_of(std::string(100000, ',')), IsEmpty());
}

TEST_F(LabelColoursFile, numbers_of_another_kind_are_no_colours) {
    EXPECT_THAT(colours_of("1 Precentral_L 10 20 30 40\n2 Precentral_R -10 20 30 40\n"), IsEmpty()) << "places";
    EXPECT_THAT(colours_of("1 a 10 20 30 40\n2 b 10 20 30.5 40\n"), IsEmpty());
    EXPECT_THAT(colours_of("index,name,x,y,z,volume\n1,liver,10,20,30,40\n"), IsEmpty());
}

TEST_F(LabelColoursFile, rows_of_more_than_1000_fields_are_no_colours) {
    const std::string row = "label,color\n1,#000001";
    EXPECT_THAT(colours_of(row + std::string(998, ',') + "\n"), ElementsAre(Pair(1, 1u)));
    EXPECT_THAT(colours_of(row + std::string(999, ',') + "\n"), IsEmpty());
    EXPECT_THAT(colours_of("label,color" + std::string(999, ',') + "x\n1,#000001\n"), IsEmpty());
}

TEST_F(LabelColoursFile, a_table_that_is_not_there_is_an_error) { EXPECT_ANY_THROW(read_label_colours(path("none"))); }

TEST_F(LabelColoursFile, tables_without_colours_have_none) {
    EXPECT_THAT(colours_of("1 Precentral_L 2001\n2 Precentral_R 2002\n"), IsEmpty());
    EXPECT_THAT(colours_of("label,name\n1,a\n2,b\n"), IsEmpty());
    EXPECT_THAT(colours_of(""), IsEmpty());
    EXPECT_THAT(colours_of("<atlas><data><label index=\"0\">a</label></data></atlas>"), IsEmpty());
}

}  // namespace
}  // namespace regionmesh
