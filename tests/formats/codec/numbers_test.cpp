#include "formats/codec/numbers.h"

#include <gtest/gtest.h>

#include <array>

#include "formats/codec/number_writer.h"
#include "formats/temporary_folder.h"

namespace regionmesh::formats {
namespace {

constexpr std::array<unsigned char, 8> kBytes{0xFF, 0xFE, 0xFD, 0xFC, 0x00, 0x00, 0x80, 0x3F};

template <class To>
To loaded(NumberType type, bool is_big_endian, std::size_t from = 0) {
    To number{};
    load_all(reinterpret_cast<const std::byte*>(&kBytes[from]), bytes_of(type), type, is_big_endian,
             std::span(&number, 1));
    return number;
}

TEST(Numbers, are_read_in_either_byte_order) {
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kUint16, false), 0xFEFF);
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kUint16, true), 0xFFFE);
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kUint32, true), 0xFFFEFDFC);
    EXPECT_EQ(loaded<double>(NumberType::kFloat32, false, 4), 1.0);
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kInt64, true), std::int64_t(0xFFFEFDFC0000803F));
}

TEST(Numbers, keep_their_sign) {
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kInt8, false), -1);
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kUint8, false), 255);
    EXPECT_EQ(loaded<std::int64_t>(NumberType::kInt16, true), -2);
    EXPECT_EQ(loaded<double>(NumberType::kInt32, true), -66052.0);
    EXPECT_LT(loaded<std::int64_t>(NumberType::kUint64, true), 0) << "the bits of an unsigned number";
    EXPECT_GT(loaded<double>(NumberType::kUint64, true), 0x1p63);
}

TEST(Numbers, are_taken_at_a_pitch) {
    std::array<std::int64_t, 4> numbers{};
    load_all(reinterpret_cast<const std::byte*>(kBytes.data()), 2, NumberType::kUint8, false,
             std::span<std::int64_t>(numbers));
    EXPECT_EQ(numbers, (std::array<std::int64_t, 4>{0xFF, 0xFD, 0x00, 0x80}));
}

class NumberWriterTest : public TemporaryFolder {};

TEST_F(NumberWriterTest, writes_without_gaps_in_little_endian) {
    OutputFile file(path("n.bin"));
    NumberWriter numbers(file);
    numbers.put(std::uint8_t{7});
    numbers.put(std::uint16_t{0x0102});
    numbers.put(1.0F);
    numbers.flush();
    file.commit();
    EXPECT_EQ(text_of(path("n.bin")), std::string("\x07\x02\x01\x00\x00\x80\x3F", 7));
}

}  // namespace
}  // namespace regionmesh::formats
