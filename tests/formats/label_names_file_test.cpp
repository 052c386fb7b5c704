#include "regionmesh/label_names_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

class LabelNamesFile : public TemporaryFolder {
protected:
    LabelNames names_of(const std::string& text) {
        put_text(path("names.txt"), text);
        return read_label_names(path("names.txt"));
    }
    std::string failure_of(const std::string& text) {
        try {
            names_of(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            EXPECT_THAT(error.what(), HasSubstr("names.txt: "));
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(LabelNamesFile, tables_of_atlases_are_read) {
    // AAL and AICHA, as Debian's mricron-data has them: an index, a name, a code.
    EXPECT_THAT(names_of("1 Precentral_L 2001\r\n2 Precentral_R 2002\r\n\r\n"),
                ElementsAre(Pair(1, "Precentral_L"), Pair(2, "Precentral_R")));
    EXPECT_THAT(names_of("1 G_Frontal_Sup-1 2\n2 G_Frontal_Sup-2 3\n"),
                ElementsAre(Pair(1, "G_Frontal_Sup-1"), Pair(2, "G_Frontal_Sup-2")));
    // JHU: tabs, and the last line without an end.
    EXPECT_THAT(names_of("0\tUnclassified\r\n1\tMiddle_cerebellar_peduncle\r\n2\tTapetum of R"),
                ElementsAre(Pair(0, "Unclassified"), Pair(1, "Middle_cerebellar_peduncle"), Pair(2, "Tapetum of R")));
    EXPECT_THAT(names_of("#$Id: a colour table\n\n#No. Name  R G B A\n0   Unknown   0 0 0 0\n\n"
                         "2   Left-Cerebral-White-Matter  245 245 245 0\n 3  Cortex left 205 62 78 0\n"),
                ElementsAre(Pair(0, "Unknown"), Pair(2, "Left-Cerebral-White-Matter"), Pair(3, "Cortex left")));
    EXPECT_THAT(names_of("# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n"
                         "    1   255    0    0        1  1  1    \"Label 1\"\n"),
                ElementsAre(Pair(0, "Clear Label"), Pair(1, "Label 1")));
    EXPECT_THAT(names_of("1\t255\t0\t0\t1\t1\t1\t\"Label 1\"\n"), ElementsAre(Pair(1, "Label 1")));
}

TEST_F(LabelNamesFile, numbers_that_tell_names_apart_are_part_of_them) {
    EXPECT_THAT(names_of("1 Brodmann area 4\n2 Brodmann area 6\n"),
                ElementsAre(Pair(1, "Brodmann area 4"), Pair(2, "Brodmann area 6")));
}

TEST_F(LabelNamesFile, numbers_before_four_of_a_colour_are_part_of_names) {
    EXPECT_THAT(names_of("1 Area 44 255 0 0 0\n2 Brodmann 17 12 13 14 0\n"),
                ElementsAre(Pair(1, "Area 44"), Pair(2, "Brodmann 17")));
    EXPECT_THAT(names_of("1 a 44 2500 0 0 0\n2 b 17 12 13 14 0\n"), ElementsAre(Pair(1, "a"), Pair(2, "b")))
        << "no colours";
}

TEST_F(LabelNamesFile, rows_of_numbers_alone_are_left_out) {
    EXPECT_THAT(names_of("0 0 0 0 0 0 0 \"\"\n1 255 0 0 1 1 1 \"Label 1\"\n"), ElementsAre(Pair(1, "Label 1")));
    EXPECT_THAT(failure_of("1 a\n2\n"), HasSubstr("row 2: has no name"));
    EXPECT_THAT(failure_of("label,name\n1,a\n2,d\n4\n5,e\n"), HasSubstr("row 4: has no name"));
}

TEST_F(LabelNamesFile, names_in_quotes_may_have_line_ends) {
    EXPECT_THAT(names_of("label,name\n1,\"line one\nline two\"\n2,two\n"),
                ElementsAre(Pair(1, "line one line two"), Pair(2, "two")));
    EXPECT_THAT(names_of("1,5\" pipe\n2,\"a\nb\"\n3,x\n"),
                ElementsAre(Pair(1, "5\" pipe"), Pair(2, "a b"), Pair(3, "x")));
}

TEST_F(LabelNamesFile, commas_in_names_separate_no_columns) {
    EXPECT_THAT(names_of("1 Thalamus, left\n2 Thalamus, right\n"),
                ElementsAre(Pair(1, "Thalamus, left"), Pair(2, "Thalamus, right")));
}

TEST_F(LabelNamesFile, comma_separated_tables_are_read_with_and_without_a_header) {
    const auto expected = ElementsAre(Pair(-1, "shell, outer"), Pair(7, "a \"b\""));
    EXPECT_THAT(names_of("label,name\n-1,\"shell, outer\"\n7,\"a \"\"b\"\"\"\n"), expected);
    EXPECT_THAT(names_of("-1,\"shell, outer\"\n7,\"a \"\"b\"\"\"\n"), expected);
    EXPECT_THAT(names_of("\xEF\xBB\xBFName;Label Value;r\n\"shell, outer\";-1;5\na \"b\";7.0;6\n"), expected);
    EXPECT_THAT(names_of("index,label\n3,femur\n"), ElementsAre(Pair(3, "femur")));
    EXPECT_THAT(names_of(",label,volume,name\n0,3,7.5,femur\n1,5,2,hip bone\n"),
                ElementsAre(Pair(3, "femur"), Pair(5, "hip bone")));
    EXPECT_THAT(names_of("\tindex\tname\n0\t3\tfemur\n"), ElementsAre(Pair(3, "femur")));
    EXPECT_THAT(names_of("femur,3\nhip,5\n"), ElementsAre(Pair(3, "femur"), Pair(5, "hip")));
    EXPECT_THAT(names_of("label,name\n1,\n2,b\n"), ElementsAre(Pair(2, "b"))) << "an empty name is none";
    EXPECT_THAT(names_of("label,name\n1,12\n2,13\n"), ElementsAre(Pair(1, "12"), Pair(2, "13")));
}

TEST_F(LabelNamesFile, unsigned_labels_keep_their_bits) {
    EXPECT_THAT(names_of("18446744073709551615,a\n-9223372036854775808,b\n"),
                ElementsAre(Pair(std::numeric_limits<InputLabel>::min(), "b"), Pair(-1, "a")));
}

TEST_F(LabelNamesFile, names_are_one_line_of_utf8) {
    EXPECT_THAT(names_of("1,caf\xC3\xA9\n2,caf\xE9\n3,\"a\tb\"\n"),
                ElementsAre(Pair(1, "caf\xC3\xA9"), Pair(2, "caf\xC3\xA9"), Pair(3, "a b")));
    EXPECT_THAT(names_of("1,\xED\x9F\xBF\n2,\xED\xA0\x80\n3,\xE0\x9F\xBF\n4,\xF4\x90\x80\x80\n"),
                ElementsAre(Pair(1, "\xED\x9F\xBF"), Pair(2, "\xC3\xAD\xC2\xA0\xC2\x80"),
                            Pair(3, "\xC3\xA0\xC2\x9F\xC2\xBF"), Pair(4, "\xC3\xB4\xC2\x90\xC2\x80\xC2\x80")))
        << "halves of pairs, characters longer than needed, and those beyond the last are none";
}

TEST_F(LabelNamesFile, xml_atlases_are_read) {
    const std::string fsl =
        "<?xml version=\"1.0\"?><atlas version=\"1.0\"><header><name>A</name><type>Label</type></header><data>"
        "<label index=\"0\" x=\"1\" y=\"2\" z=\"3\">Unclassified</label><label index=\"1\">Pole &amp; tip</label>"
        "</data></atlas>";
    EXPECT_THAT(names_of(fsl), ElementsAre(Pair(0, "Unclassified"), Pair(1, "Pole & tip")));
    std::string probabilistic = fsl;
    probabilistic.replace(probabilistic.find(">Label<"), 7, ">Probabilistic<");
    EXPECT_THAT(names_of(probabilistic), ElementsAre(Pair(1, "Unclassified"), Pair(2, "Pole & tip")));
    EXPECT_THAT(names_of("<atlas><data><label><index>2001</index><name>Precentral_L</name></label></data></atlas>"),
                ElementsAre(Pair(2001, "Precentral_L")));
}

TEST_F(LabelNamesFile, errors_name_the_row) {
    EXPECT_THAT(failure_of(""), HasSubstr("holds no labels and names"));
    EXPECT_THAT(failure_of("label,name\n"), HasSubstr("holds no labels and names"));
    EXPECT_THAT(failure_of("label,name\n1,a\nb,c\n"), HasSubstr("row 3: 'b' is no label"));
    EXPECT_THAT(failure_of("label,name\n1.5,a\n"), HasSubstr("row 2: '1.5' is no label"));
    EXPECT_THAT(failure_of("label,name\n99999999999999999999,a\n"), HasSubstr("is no label"));
    EXPECT_THAT(failure_of("label,name\n1,a\n1,b\n"), HasSubstr("row 3: label 1 is called 'a' and 'b'"));
    EXPECT_THAT(failure_of("label,area\n1,2.5\n2,3.5\n"), HasSubstr("no column of names"));
    EXPECT_THAT(failure_of("0 1000 2000\n1 1000 2000\n"), HasSubstr("row 1: has no name"));
    EXPECT_THAT(failure_of("1,a,b\n2,\"c\n"), HasSubstr("row 2: a quote is not closed"));
    EXPECT_THAT(failure_of("x,y,label,name\n1,2\n"), HasSubstr("row 2: has 2 columns"));
    EXPECT_THAT(failure_of(std::string("1,a\0b\n", 6)), HasSubstr("is no text"));
    EXPECT_THAT(failure_of(std::string(1000, ',') + "x\n1,1\n"), HasSubstr("more than 1000 columns"));
    std::string rows;
    for (int n = 0; n < 1100; ++n) rows += "1,x" + std::string(998, ',') + "\n";
    EXPECT_THAT(failure_of(rows), HasSubstr("row 1049: is behind more than a million fields"));
    EXPECT_THAT(failure_of("<atlas>"), HasSubstr("is no whole XML"));
    EXPECT_THAT(failure_of("<atlas/>"), HasSubstr("holds no names"));
    EXPECT_THAT(failure_of("<atlas><data><label index=\"x\">a</label></data></atlas>"), HasSubstr("no whole number"));
    EXPECT_THROW(read_label_names(path("missing.csv")), Error);
}

TEST_F(LabelNamesFile, table_beside_a_volume_is_found_and_another_file_passed_over) {
    EXPECT_THAT(formats::table_beside(path("atlas.nii.gz")).names, IsEmpty());
    put_text(path("atlas.nii.txt"), "this is a note on the atlas\n");
    EXPECT_THAT(formats::table_beside(path("atlas.nii.gz")).names, IsEmpty());
    put_text(path("atlas.txt"), "1 one\n");
    EXPECT_THAT(formats::table_beside(path("atlas.nii.gz")).names, ElementsAre(Pair(1, "one")));
    EXPECT_THAT(formats::table_beside(path("atlas.nii")).names, ElementsAre(Pair(1, "one")));
    put_text(path("atlas.nii.txt"), "1 first\n");
    EXPECT_THAT(formats::table_beside(path("atlas.nii.gz")).names, ElementsAre(Pair(1, "first")));
    EXPECT_THAT(formats::table_beside(path("other.nii.gz")).names, IsEmpty());
}

}  // namespace
}  // namespace regionmesh
