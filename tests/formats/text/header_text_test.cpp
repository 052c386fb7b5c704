#include "formats/text/header_text.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "formats/codec/byte_reader.h"
#include "formats/temporary_folder.h"
#include "formats/text/csv_rows.h"

namespace regionmesh::formats {
namespace {

using testing::ElementsAre;

TEST(Words, are_taken_off_the_front) {
    std::string_view line = " v\t1 \r";
    EXPECT_EQ(take_word(line), "v");
    EXPECT_EQ(take_word(line), "1");
    EXPECT_EQ(take_word(line), "");
}

TEST(Words, are_numbers_as_a_whole_or_none) {
    EXPECT_EQ(parse_real("+1.5e1"), 15.0);
    EXPECT_EQ(parse_real("1e-400"), 0.0) << "too small for a double";
    EXPECT_TRUE(std::isnan(*parse_real("nan")));
    for (const char* text : {"", "+", "1x", "1 ", "inf", "1e400", "+-1", "0x10"})
        EXPECT_EQ(parse_real(text), std::nullopt) << text;
    EXPECT_EQ(parse_finite("nan"), std::nullopt);
    EXPECT_EQ(parse_finite("-2"), -2.0);
    EXPECT_EQ(parse_integer("9223372036854775808"), std::nullopt);
    EXPECT_EQ(parse_size("-1"), std::nullopt);
}

TEST(Words, are_labels_with_the_bits_of_unsigned_ones) {
    EXPECT_EQ(parse_label("+7"), 7);
    EXPECT_EQ(parse_label("18446744073709551615"), -1);
    EXPECT_EQ(parse_label("18446744073709551616"), std::nullopt);
    EXPECT_EQ(parse_label("3.0"), std::nullopt);
    EXPECT_EQ(parse_table_label("3.0"), 3);
    EXPECT_EQ(parse_table_label("3."), 3);
    EXPECT_EQ(parse_table_label("3.5"), std::nullopt);
    EXPECT_EQ(parse_table_label(".0"), std::nullopt);
}

class TextFile : public TemporaryFolder {};

TEST_F(TextFile, words_end_at_blanks_or_also_at_commas_within_a_part_of_the_file) {
    put_text(path("a.txt"), "xx1,2\n 3 4xx");
    const auto words = [&](std::string_view separators) {
        ByteReader reader(InputFile(path("a.txt")), 2, 10, separators);
        std::vector<std::string> found;
        while (const auto word = reader.take_word()) found.emplace_back(*word);
        EXPECT_EQ(reader.lines(), 1u);
        EXPECT_EQ(reader.left(), 0u);
        return found;
    };
    EXPECT_THAT(words(kBlanks), ElementsAre("1,2", "3", "4"));
    EXPECT_THAT(words(kBlanksAndCommas), ElementsAre("1", "2", "3", "4"));
}

TEST_F(TextFile, words_longer_than_what_is_held_at_a_time_are_whole) {
    const std::string longest(3 << 20, 'w');
    put_text(path("a.txt"), "a " + longest + " b");
    ByteReader reader(path("a.txt"));
    EXPECT_EQ(reader.take_word(), "a");
    EXPECT_EQ(reader.take_word(), longest);
    EXPECT_EQ(reader.take_word(), "b");
    EXPECT_EQ(reader.take_word(), std::nullopt);
}

TEST_F(TextFile, given_text_is_split_into_rows_like_a_file) {
    put_text(path("a.csv"), "not read");
    CsvRows rows(InputFile(path("a.csv")), "1 \"two words\"\r\n\r\n3 x", ' ');
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.field(1), "two words");
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.number(), 3u);
    EXPECT_EQ(rows.field(0), "3");
    EXPECT_FALSE(rows.next());
}

}  // namespace
}  // namespace regionmesh::formats
