#include "boreholes/point_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "formats/temporary_folder.h"
#include "formats/text/length_unit.h"
#include "regionmesh/error.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

class PointTableFile : public TemporaryFolder {
protected:
    formats::PointTable read(const std::string& text, const TetrahedraOptions& options = {}) {
        put_text(path("points.csv"), text);
        return formats::read_point_table(path("points.csv"), options);
    }
    std::string failure_of(const std::string& text, const TetrahedraOptions& options = {},
                           ErrorCode code = ErrorCode::kInput) {
        try {
            read(text, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            const std::string what = error.what(), file = path("points.csv").string() + ": ";
            EXPECT_TRUE(what.starts_with(file)) << what;
            EXPECT_THAT(what, Not(HasSubstr("\n")));
            return what.substr(std::min(file.size(), what.size()));
        }
        return "nothing thrown";
    }
};

formats::PointTable seed(const std::string& name, const TetrahedraOptions& options = {}) {
    return formats::read_point_table(test::data_folder() + "/points/" + name, options);
}

std::vector<double> heights(const formats::PointTable& table) {
    std::vector<double> z;
    for (const Vec3& position : table.points.positions) z.push_back(position.z);
    return z;
}

TEST_F(PointTableFile, points_come_in_the_order_of_their_rows) {
    const auto table = read("x,y,z,label\n1,2,3,7\n-1.5,+2.5e1,0,-4\n");
    EXPECT_THAT(table.points.positions, ElementsAre(Vec3{1, 2, 3}, Vec3{-1.5, 25, 0}));
    EXPECT_THAT(table.points.labels, ElementsAre(7, -4));
    EXPECT_THAT(table.rows, ElementsAre(2, 3));
    EXPECT_THAT(table.info.names, IsEmpty());
    EXPECT_EQ(table.info.source, path("points.csv").string());
    EXPECT_EQ(table.info.format, "csv");
    EXPECT_FALSE(table.info.has_cell_labels);
    EXPECT_FALSE(table.info.is_unsigned);
    EXPECT_EQ(table.info.scale_z, 1);
}

TEST_F(PointTableFile, columns_are_known_by_their_usual_titles) {
    const auto expected = ElementsAre(Vec3{1, 2, 3});
    EXPECT_THAT(read("label;Z;Y;X\n5;3;2;1\n").points.positions, expected);
    EXPECT_THAT(read("Easting\tNorthing\tElevation\tLithology\n1\t2\t3\ta\n").points.positions, expected);
    EXPECT_THAT(read("X_m,Y (m),z [M],Formation\n1,2,3,a\n").points.positions, expected);
    EXPECT_THAT(read("x,easting,y,z,elev,lith,label\n1,9,2,3,9,a,5\n").points.labels, ElementsAre(5))
        << "the likeliest title wins";
    EXPECT_THAT(read("id,x,y,elev,from,unit\n9,1,2,3,9,4\n").points.positions, expected);
}

TEST_F(PointTableFile, titles_in_different_units_are_refused) {
    EXPECT_THAT(failure_of("x_m,y_m,z [ft],lith\n1,2,3,a\n"),
                testing::EndsWith("row 1: column 'z [ft]' is in another unit of length than 'x_m' in " +
                                  path("points.csv").string() + "; convert one of them"));
    EXPECT_THAT(failure_of("x (UTM),y (feet),z (m a.s.l.),lith\n1,2,3,a\n"), HasSubstr("column 'z (m a.s.l.)'"));
    EXPECT_THAT(failure_of("x (m),y (m),z (above datum in ft),lith\n1,2,3,a\n"), HasSubstr("another unit of length"));
    EXPECT_THAT(failure_of("x (m),y (m),z (in),lith\n1,2,3,a\n"), HasSubstr("another unit of length"));
    for (const char* header : {"x (UTM),y (m),z,lith", "x (m),y (in m),z (in situ),lith"})
        EXPECT_THAT(read(std::string(header) + "\n1,2,3,a\n").points.positions, ElementsAre(Vec3{1, 2, 3})) << header;
}

TEST_F(PointTableFile, the_unit_is_that_of_the_titles) {
    const auto metres = [&](const std::string& header) { return read(header + "\n1,2,3,a\n").info.metres; };
    EXPECT_EQ(metres("x,y,z,lith"), std::nullopt);
    EXPECT_EQ(metres("x (m),y (m),z (m),lith"), 1);
    EXPECT_EQ(metres("x,y,z_ft,lith"), 0.3048) << "one title says it for all";
    EXPECT_EQ(metres("x,y,z,lith (mm)"), std::nullopt) << "no length";
    for (const char* unit : {"cm", "feet", "inch", "metres", "km", "mm", "nm"})
        EXPECT_EQ(metres(std::string("x_") + unit + ",y,z,lith"), formats::metres_in(unit)) << unit;
    EXPECT_EQ(metres("x (in.),y,z,lith"), 0.0254);
    for (const char* height : {"m a.s.l.", "m.a.s.l.", "masl", "A.M.S.L. m"})
        EXPECT_EQ(metres("x,y,z (" + std::string(height) + "),lith"), 1) << height;
    for (const char* none : {"a.m.s.l.", "1000 m", "fm", "m/s", "WGS84"})
        EXPECT_EQ(metres("x,y,z (" + std::string(none) + "),lith"), std::nullopt) << none;
    EXPECT_EQ(metres("x (ft),y (ft),z (a.m.s.l.),lith"), 0.3048);
    EXPECT_EQ(read("x (km),y,top,bottom,lith\n1,2,0,1,a\n").info.metres, 1000) << "drill holes";
    EXPECT_EQ(read("1,2,3,4\n", {.columns = "1,2,3,4"}).info.metres, std::nullopt) << "no titles";
}

TEST_F(PointTableFile, columns_can_be_named_and_numbered) {
    const std::string text = "a,B,b,c,x,d\n1,2,8,3,9,5\n";
    const auto check = [&](const char* columns) {
        const auto table = read(text, {.columns = columns});
        EXPECT_THAT(table.points.positions, ElementsAre(Vec3{1, 2, 3})) << columns;
        EXPECT_THAT(table.points.labels, ElementsAre(5)) << columns;
    };
    check("a,B,c,d");
    check("A, 2 ,C,6");
    check("1,2,4,6");
    check("label=d,z=c,x=a,y=2");
    check("LABEL = 6,z=C,x=1,y=B");
}

TEST_F(PointTableFile, a_table_without_a_header_is_read_by_numbers) {
    const auto table = seed("numbers.csv", {.columns = "1,2,3,4"});
    EXPECT_THAT(table.rows, ElementsAre(2, 3, 4, 5));
    EXPECT_THAT(table.points.labels, ElementsAre(1, 1, 2, 2));
    EXPECT_THAT(read("a;1;2;3\nb;4;5;6\n", {.columns = "x=2,y=3,z=4,label=1"}).rows, ElementsAre(1, 2));
    EXPECT_THAT(failure_of("1,2,3,4\n"), HasSubstr("row 1: is no header: it holds numbers; say which column is what: "
                                                   "--columns 1,2,3,4"));
    EXPECT_THAT(failure_of("1,2,3,sand\n", {.columns = "x,y,z,label"}), HasSubstr("row 1: is no header"));
}

TEST_F(PointTableFile, a_word_among_numbers_is_a_warning) {
    const auto table = read("x,y,z,label\n0,0,0,7\n1,0,0,12\n0,1,0,clay\n");
    EXPECT_THAT(table.points.labels, ElementsAre(2, 1, 3));
    EXPECT_EQ(table.info.warning, "label '7' is a whole number and 'clay' is none; all labels are taken as words");
    EXPECT_EQ(read("x,y,z,label\n0,0,0,sand\n0,1,0,clay\n").info.warning, "");
    EXPECT_EQ(read("x,y,z,label\n0,0,0,7\n0,1,0,8.0\n").info.warning, "");
}

TEST_F(PointTableFile, words_become_labels_in_their_order) {
    const auto table = seed("words.csv");
    EXPECT_THAT(table.points.positions,
                ElementsAre(Vec3{1.5, 2, -30}, Vec3{2.5, 2, -31}, Vec3{3.5, 2, -32}, Vec3{4.5, 2, -33}));
    EXPECT_THAT(table.points.labels, ElementsAre(3, 1, 2, 3));
    EXPECT_THAT(table.info.names,
                ElementsAre(Pair(1, "clay; stiff"), Pair(2, "gr\xC3\xA8s \"rouge\""), Pair(3, "sand")));
    EXPECT_THAT(table.rows, ElementsAre(3, 4, 5, 6)) << "a text of two lines is in one row";
    EXPECT_THAT(read("x,y,z,label\n0,0,0,10\n0,0,1,9\n0,0,2,2a\n0,0,3,B\n").points.labels, ElementsAre(1, 3, 2, 4));
}

TEST_F(PointTableFile, whole_numbers_keep_their_bits) {
    const auto table = seed("unsigned.csv");
    EXPECT_TRUE(table.info.is_unsigned);
    EXPECT_THAT(table.points.labels, ElementsAre(-1, std::numeric_limits<InputLabel>::min(), 0));
    EXPECT_THAT(table.points.positions[2], (Vec3{2, 1, 2}));
    const auto low = read("x,y,z,label\n0,0,0,-9223372036854775808\n0,0,1,3.0\n0,0,2,3\n0,0,3,+4\n");
    EXPECT_FALSE(low.info.is_unsigned);
    EXPECT_THAT(low.points.labels, ElementsAre(std::numeric_limits<InputLabel>::min(), 3, 3, 4));
    EXPECT_THAT(read("x,y,z,label\n0,0,0,1\n0,0,1,2.5\n").info.names, ElementsAre(Pair(1, "1"), Pair(2, "2.5")));
}

TEST_F(PointTableFile, a_column_can_give_labels_their_names) {
    const TetrahedraOptions options{.columns = "name=rock"};
    const auto table = read("x,y,z,label,rock\n0,0,0,3,chalk\n0,0,1,5,\n0,0,2,3,\n0,0,3,3.0,chalk\n", options);
    EXPECT_THAT(table.points.labels, ElementsAre(3, 5, 3, 3));
    EXPECT_THAT(table.info.names, ElementsAre(Pair(3, "chalk")));
    EXPECT_THAT(read("x,y,z,label,rock\n0,0,0,s,sand\n0,0,1,k,\n", options).info.names,
                ElementsAre(Pair(1, "k"), Pair(2, "sand")));
    EXPECT_EQ(failure_of("x,y,z,label,rock\n0,0,0,3,chalk\n0,0,1,5,marl\n0,0,2,3,chert\n", options),
              "rows 2 and 4: label '3' is called 'chalk' and 'chert'; keep one name");
    EXPECT_THAT(failure_of("x,y,z,label,rock\n0,0,0,3.0,chalk\n0,0,1,3,marl\n", options), HasSubstr("rows 2 and 3: "));
}

TEST_F(PointTableFile, rows_are_counted_as_spreadsheets_do) {
    const std::string comments = "\xEF\xBB\xBF# one, \"two\r\n\r\n  # three\r\n";
    EXPECT_THAT(read(comments + "x,y,z,label\r\n0,0,0,1\r\n\r\n,,,\r\n0,0,1,1,,\r\n\r\n\r\n").rows, ElementsAre(5, 8));
    EXPECT_THAT(read("x,y,z,label\r0,0,0,1\r\r0,0,1,1").rows, ElementsAre(2, 4)) << "lines that end as on old Macs";
    EXPECT_THAT(read("x,y,z,label\n0,0,0,\"1\"\n 0 , 0 ,\" 1 \", 1 \n").rows, ElementsAre(2, 3));
}

TEST_F(PointTableFile, long_tables_are_read_in_parts) {
    std::string text = "x,y,z,label,remark\r\n";
    for (int i = 0; i < 20000; ++i) text += std::to_string(i) + ",0,0.5," + std::to_string(i % 7) + ",\"a\r\nb\"\r\n";
    const auto table = read(text);
    ASSERT_EQ(table.rows.size(), 20000u);
    for (std::uint32_t i = 0; i < 20000; ++i) {
        ASSERT_EQ(table.points.positions[i], (Vec3{double(i), 0, 0.5}));
        ASSERT_EQ(table.points.labels[i], i % 7);
        ASSERT_EQ(table.rows[i], i + 2);
    }
    EXPECT_LE(table.points.positions.capacity(), 40002u) << "no more than there are lines, and none of it twice";
}

TEST_F(PointTableFile, heights_are_scaled) {
    const auto table = read("x,y,z,label\n1,2,3,1\n", {.scale_z = 2.5});
    EXPECT_EQ(table.points.positions[0], (Vec3{1, 2, 7.5}));
    EXPECT_EQ(table.info.scale_z, 2.5);
    for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_THAT(failure_of("x,y,z,label\n1,2,3,1\n", {.scale_z = scale}), HasSubstr("--scale-z"));
    EXPECT_THAT(failure_of("x,y,z,label\n1,2,3,1\n1,2,1e300,1\n", {.scale_z = 1e10}),
                HasSubstr("row 3: z is out of range"));
}

TEST_F(PointTableFile, bad_fields_are_named_by_row_and_column) {
    const std::string header = "x,y,z,label\n1,2,3,4\n";
    const auto failure = [&](const std::string& row) { return failure_of(header + row + "\n1,2,3,4\n"); };
    EXPECT_EQ(failure("1,2,abc,4"), "row 3: column 'z': 'abc' is no finite number; mend it");
    for (const char* text : {"nan", "inf", "-inf", "1e999", "0x10", "1 2", "--1", "1e"})
        EXPECT_THAT(failure(std::string(text) + ",2,3,4"),
                    HasSubstr("row 3: column 'x': '" + std::string(text) + "' is no"));
    EXPECT_THAT(failure("1,2,3,18446744073709551616"), HasSubstr("label '18446744073709551616': labels are whole"));
    EXPECT_THAT(failure("1,2,3,18446744073709551615\n1,2,4,-5"), HasSubstr("negative labels and some of 2^63"));
    EXPECT_EQ(failure("1,,3,4"), "row 3: column 'y' is empty; fill it in");
    EXPECT_EQ(failure("1,2,3, "), "row 3: column 'label' is empty; fill it in");
    EXPECT_EQ(failure("1,2,3"), "row 3: has 3 fields where 4 are needed; fill it or take it out");
    EXPECT_THAT(failure("1,2,3,sand, fine"), HasSubstr("row 3: has 5 fields where there are 4 columns; put text"));
    EXPECT_THAT(failure("1,2,\"3,4"), HasSubstr("row 3: a quote is not closed"));
    EXPECT_THAT(failure("1,2,3,5\" pipe"), HasSubstr("nothing thrown")) << "a quote may be a letter";
    EXPECT_THAT(failure_of("x;y;z;label\n1,5;2;3;4\n"),
                HasSubstr("row 2: column 'x': '1,5' is no finite number; write it "
                          "with a point"));
    EXPECT_THAT(failure_of("1,2,c,d\n", {.columns = "1,2,3,4"}), HasSubstr("row 1: column 3: 'c' is no"));
    EXPECT_THAT(failure("1,2,\"a\nb\",4"), HasSubstr("'a?b' is no")) << "errors stay on one line";
}

TEST_F(PointTableFile, what_is_no_table_is_refused) {
    EXPECT_THAT(failure_of(""), HasSubstr("holds no table"));
    EXPECT_THAT(failure_of("# x,y,z,label\n\n"), HasSubstr("holds no table"));
    EXPECT_THAT(failure_of("x,y,z,label\n\n"), HasSubstr("has no rows below its header"));
    EXPECT_THAT(failure_of(std::string("\xFF\xFEx\0,\0", 6)), HasSubstr("is no text in UTF-8"));
    EXPECT_THAT(failure_of("x,y,z,label\n1,2,3,\"" + std::string(3 << 20, 'a')),
                HasSubstr("row 2: is longer than 1 MiB"));
    EXPECT_THAT(failure_of("x,y,z,label\n" + std::string(200000, ',')), HasSubstr("row 2: has more than 65536 fields"));
    EXPECT_THROW(formats::read_point_table(path("missing.csv"), {}), Error);
    EXPECT_THROW(formats::read_point_table(path("."), {}), Error);
}

TEST_F(PointTableFile, missing_and_double_columns_are_named) {
    const auto failure = [&](const std::string& columns, const std::string& header = "a,y,z,lith") {
        return failure_of(header + "\n0,0,0,1\n", {.columns = columns});
    };
    EXPECT_EQ(failure(""),
              "row 1: has no column for x, only 'a', 'y', 'z', 'lith'; say which column is what: "
              "--columns x=COLUMN,label=COLUMN");
    EXPECT_THAT(failure("x=1", "a,b,z,lith"), HasSubstr("no column for y"));
    EXPECT_THAT(failure("x=a", "a,y,zz,lith"), HasSubstr("no column for z, nor both of top and bottom"));
    EXPECT_THAT(failure("x=a", "a,y,z,stone"), HasSubstr("no column for label"));
    EXPECT_THAT(failure("x=b"), HasSubstr("no column 'b' that --columns names, only 'a', 'y'"));
    EXPECT_THAT(failure("x=5"), HasSubstr("has columns 1 to 4; --columns names 5"));
    EXPECT_THAT(failure("x=0"), HasSubstr("--columns names 0"));
    EXPECT_THAT(failure("x=a,top=y"), HasSubstr("no column for bottom"));
    EXPECT_THAT(failure("x=a", "a,z,y,z,lith"), HasSubstr("columns 2 and 4 are both called 'z'"));
    EXPECT_THAT(failure("x=b", "b,b,y,z"), HasSubstr("columns 1 and 2 are both called 'b'; choose one by number"));
}

TEST_F(PointTableFile, columns_that_contradict_themselves_are_usage_errors) {
    const auto failure = [&](const std::string& columns) {
        return failure_of("a,y,z,lith\n0,0,0,1\n", {.columns = columns}, ErrorCode::kUsage);
    };
    EXPECT_THAT(failure("x="), HasSubstr("--columns names an empty column"));
    EXPECT_THAT(failure("a,y,z"), HasSubstr("--columns a,y,z: write four columns"));
    EXPECT_THAT(failure("x=a,y"), HasSubstr("'y' is no pair"));
    EXPECT_THAT(failure("x=a,w=y"), HasSubstr("'w=y' is no pair"));
    EXPECT_THAT(failure("x=a,x=y"), HasSubstr("'x=y' comes twice"));
    EXPECT_THAT(failure("x=a,z=z,top=y"), HasSubstr("--columns names z and also top, bottom or surface"));
    EXPECT_THAT(failure("1,1,3,4"), HasSubstr("--columns 1,1,3,4: column 1 is both x and y; give each its own"));
    EXPECT_THAT(failure("x=1,y=2,z=2,label=2"), HasSubstr("column 2 is both y and z"));
}

TEST_F(PointTableFile, intervals_become_their_middles) {
    const auto table = seed("depths.csv");
    EXPECT_THAT(heights(table), ElementsAre(9.25, 7.25, 3.375, 10.5, 6.5, 7.5, 3.55));
    EXPECT_THAT(table.rows, ElementsAre(2, 3, 5, 6, 7, 8, 9)) << "row 4 has no length: a mark, which needs no label";
    EXPECT_THAT(table.info.names,
                ElementsAre(Pair(1, "clay"), Pair(2, "clay, grey"), Pair(3, "sand"), Pair(4, "soil")));
    EXPECT_THAT(heights(seed("elevations.tsv")), ElementsAre(9.25, 2.25, 4.5)) << "the surface is not needed";
    EXPECT_THAT(heights(read("x,y,top,bottom,label\n0,0,1,4,1\n")), ElementsAre(-2.5)) << "the surface is 0";
    EXPECT_THAT(heights(read("x,y,elevation,from,to,lith\n0,0,100,1,4,1\n")), ElementsAre(97.5));
    EXPECT_THAT(heights(read("x,y,top,bottom,label\n0,0,1,4,1\n", {.scale_z = 2})), ElementsAre(-5));
}

TEST_F(PointTableFile, intervals_are_cut_into_equal_parts_no_longer_than_the_step) {
    const auto z = [&](const char* to, double step) {
        return heights(read(std::string("x,y,from,to,label\n0,0,0,") + to + ",1\n", {.step = step}));
    };
    EXPECT_THAT(z("4", 5), ElementsAre(-2));
    EXPECT_THAT(z("4", 2), ElementsAre(-1, -3));
    EXPECT_THAT(z("4", 1.9), ElementsAre(-4 / 6.0, -2, -4 * (5 / 6.0)));
    EXPECT_EQ(z("0.4", 0.2).size(), 2u);
    EXPECT_EQ(z("1000", 0.01).size(), 100000u);
    const auto table = read("x,y,surface,from,to,label\n1,2,9,0,2,7\n3,4,8,0,1,5\n", {.step = 1});
    EXPECT_THAT(table.points.positions, ElementsAre(Vec3{1, 2, 8.5}, Vec3{1, 2, 7.5}, Vec3{3, 4, 7.5}));
    EXPECT_THAT(table.points.labels, ElementsAre(7, 7, 5));
    EXPECT_THAT(table.rows, ElementsAre(2, 2, 3));
}

TEST_F(PointTableFile, named_tops_and_bottoms_go_before_a_z) {
    const std::string text = "nr,x,y,z,top,base,altitude,formation\nA,0,0,-5,1,3,10,s\n";
    EXPECT_THAT(heights(read(text)), ElementsAre(-5));
    EXPECT_THAT(heights(read(text, {.columns = "hole=nr,top=top,bottom=base,label=formation,surface=altitude"})),
                ElementsAre(8));
    EXPECT_THAT(heights(read(text, {.columns = "top=top"})), ElementsAre(8)) << "the others are found";
}

TEST_F(PointTableFile, a_step_that_makes_no_sense_is_refused) {
    const std::string intervals = "x,y,top,bottom,label\n0,0,0,10,1\n0,0,10,20,1\n";
    EXPECT_THAT(failure_of(intervals, {.step = 0}), HasSubstr("--step 0: give a length above 0"));
    EXPECT_THAT(failure_of(intervals, {.step = std::nan("")}), HasSubstr("--step nan"));
    EXPECT_THAT(failure_of(intervals, {.step = 4e-9}),
                HasSubstr("row 3: with --step 4e-09 there are more than 4294967294"));
    EXPECT_THAT(failure_of(intervals, {.step = 5e-324}), HasSubstr("row 2: with --step"));
    EXPECT_THAT(failure_of("x,y,z,label\n0,0,0,1\n", {.step = 1}), HasSubstr("--step is for drill holes"));
}

TEST_F(PointTableFile, depths_with_a_minus_are_a_warning) {
    const std::string header = "x,y,elevation,from,to,lith\n";
    const auto warning_of = [&](const std::string& text) {
        const std::string all = read(text).info.warning, hulls = "drill holes become points";
        const std::size_t at = all.find(hulls);
        EXPECT_NE(at, std::string::npos) << "said of all tables of intervals";
        return at < 2 ? std::string() : all.substr(0, at - 2);
    };
    EXPECT_EQ(warning_of(header + "0,0,100,0,-4,1\n0,0,100,-4,-9,2\n"),
              "top and bottom are elevations, since no bottom is larger, and column 'elevation' is not used; write "
              "depths without a minus");
    EXPECT_EQ(warning_of(header + "0,0,4,4,0,1\n0,0,4,0,-9,2\n"), "") << "a top is the surface";
    EXPECT_EQ(warning_of(header + "0,0,0,0,-4,1\n"), "") << "the surface is 0";
    EXPECT_NE(warning_of(header + "0,0,0,0,-4,1\n9,0,100,0,-4,1\n"), "") << "one of the surfaces is 0";
    EXPECT_EQ(warning_of("x,y,from,to,lith\n0,0,0,-4,1\n"), "") << "there is no surface";
    EXPECT_EQ(warning_of(header + "0,0,100,0,4,1\n"), "") << "depths";
}

TEST_F(PointTableFile, intervals_with_the_z_of_collars_are_no_points) {
    const std::string header = "hole,x,y,z,from,to,unit\n";
    EXPECT_EQ(failure_of(header + "A,0,0,9,0,1,sand\nA,0,0,9,1,2,clay\n"),
              "row 3: lies where row 2 lies, and has another label; if these are intervals of a drill hole, say "
              "--columns surface=4");
    EXPECT_THAT(heights(read(header + "A,0,0,9,0,1,sand\nA,0,0,9,1,2,clay\n", {.columns = "surface=4"})),
                ElementsAre(8.5, 7.5));
    EXPECT_THAT(heights(read(header + "A,0,0,8.5,0,1,sand\nA,0,0,7.5,1,2,clay\n")), ElementsAre(8.5, 7.5))
        << "the middles of intervals";
}

TEST_F(PointTableFile, depths_and_elevations_must_not_mix) {
    EXPECT_EQ(failure_of("x,y,top,bottom,label\n0,0,0,1,a\n0,0,2,2,a\n0,0,1,2,b\n0,0,5,4,c\n"),
              "rows 2 and 5: the bottom has the larger number in row 2, the top in row 5; write either depths or "
              "elevations");
    EXPECT_THAT(failure_of("x,y,top,bottom,label\n0,0,5,4,c\n0,0,0,1,a\n"),
                HasSubstr("rows 2 and 3: the bottom has the "
                          "larger number in row 3"));
    EXPECT_THAT(failure_of("x,y,top,bottom,label\n0,0,2,2,a\n"), HasSubstr("has no interval with a length"));
}

TEST_F(PointTableFile, bad_intervals_are_named) {
    EXPECT_THAT(failure_of("x,y,top,bottom,label\n0,0,0,,a\n"), HasSubstr("row 2: column 'bottom' is empty"));
    EXPECT_THAT(failure_of("x,y,top,bottom,label\n0,0,0,1,a\n0,0,1,2,\n"), HasSubstr("row 3: column 'label' is empty"));
    EXPECT_THAT(failure_of("hole,x,y,top,bottom,label\n,0,0,0,1,a\n"), HasSubstr("row 2: column 'hole' is empty"));
    EXPECT_THAT(failure_of("x,y,surface,top,bottom,label\n0,0,?,0,1,a\n"), HasSubstr("row 2: column 'surface': '?'"));
    EXPECT_THAT(failure_of("x,y,top,bottom,label\n0,0,-1e308,1e308,a\n"),
                HasSubstr("row 2: top and bottom are out of range"));
    EXPECT_THAT(heights(read("x,y,surface,top,bottom,label\n0,0,,1,0,a\n")), ElementsAre(0.5))
        << "elevations need no surface";
}

TEST_F(PointTableFile, overlaps_of_two_labels_are_refused) {
    const std::string header = "hole,x,y,surface,top,bottom,label\n";
    EXPECT_EQ(failure_of(header + "A,0,0,0,6,20,clay\nA,0,0,0,0,8,sand\n"),
              "rows 2 and 3 of hole 'A': 'clay' and 'sand' overlap by 2; a place has one label, mend one of them");
    EXPECT_EQ(failure_of("x,y,top,bottom,label\n0,0,20,10,3\n0,0,10,0,3\n0,0,12,7,4\n"),
              "rows 2 and 4: '3' and '4' overlap by 2; a place has one label, mend one of them");
    EXPECT_THAT(failure_of(header + "A,0,0,0,0,1,sand\nB,0,0,0,0,1,clay\n"),
                HasSubstr("rows 2 of hole 'A' and 3 of hole 'B': 'sand'"))
        << "one place";
    EXPECT_THAT(failure_of(header + "A,0,0,5,0,4,sand\nA,0,0,2,0,3,clay\n"), HasSubstr("overlap by 1;"))
        << "elevations count";
    EXPECT_THAT(failure_of(header + "A,0,0,0,0,9,sand\nA,0,0,0,1,2,sand\nA,0,0,0,5,6,clay\n"),
                HasSubstr("rows 2 and 4"))
        << "behind a short one, a long one still lasts";
    EXPECT_THAT(failure_of(header + "A,0,0,0,0,5,sand\nA,0,0,0,4,9,sand\nA,0,0,0,7,20,clay\n"),
                HasSubstr("rows 3 and 4"))
        << "the one that reaches there";
}

TEST_F(PointTableFile, overlaps_that_contradict_nothing_are_read) {
    const std::string header = "hole,x,y,surface,top,bottom,label\n";
    EXPECT_EQ(read(header + "A,0,0,0,0,8,sand\nA,0,0,0,6,20,sand\nA,0,0,0,0,8,sand\n").rows.size(), 3u) << "one label";
    EXPECT_EQ(read(header + "A,0,0,0,0,8,sand\nA,7,0,0,0,8,clay\n").rows.size(), 2u) << "one name, two places";
    EXPECT_EQ(read(header + "A,0,0,0,0,5,sand\nA,0,0,5,10,14,clay\n").rows.size(), 2u) << "touching";
    EXPECT_EQ(read(header + "A,0,0,0,0,20,sand\nA,0,0,0,19.99,20,none\nA,0,0,0,19.5,60,clay\n").rows.size(), 3u)
        << "a layer without thickness, and a boundary read off twice";
    std::string many = header;
    for (int i = 0; i < 20000; ++i) many += "A,0,0,0,0," + std::to_string(i + 1) + ",sand\n";
    EXPECT_EQ(read(many).rows.size(), 20000u);
}

}  // namespace
}  // namespace regionmesh
