#include "formats/chunked/chunk_codec.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <string>
#include <vector>

namespace regionmesh::formats {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes bytes(std::string_view text) {
    const auto view = std::as_bytes(std::span(text));
    return {view.begin(), view.end()};
}

Bytes zlib(const Bytes& plain) {
    uLongf size = compressBound(plain.size());
    Bytes packed(size);
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
             plain.size());
    packed.resize(size);
    return packed;
}

std::string problem(const Bytes& packed, std::vector<Codec> codecs, std::size_t size) {
    Bytes plain(size);
    return unpack(packed, codecs, plain);
}

TEST(ChunkCodec, check_sum_is_that_of_rfc_3720) {
    EXPECT_EQ(crc32c(Bytes(32, std::byte{0})), 0x8A9136AAu);
    EXPECT_EQ(crc32c(Bytes(32, std::byte{0xFF})), 0x62A8AB43u);
}

TEST(ChunkCodec, no_codec_wants_just_the_bytes_of_the_chunk) {
    EXPECT_EQ(problem(bytes("abcd"), {}, 4), "");
    EXPECT_THAT(problem(bytes("abcd"), {}, 5), HasSubstr("4 bytes where a chunk has 5"));
    EXPECT_THAT(problem(bytes("abcd"), {}, 3), HasSubstr("4 bytes where a chunk has 3"));
}

TEST(ChunkCodec, zlib_chunks_of_another_length_cut_short_or_with_a_wrong_sum_are_refused) {
    const Bytes plain(1000, std::byte{7});
    const Bytes packed = zlib(plain);
    EXPECT_EQ(problem(packed, {Codec::kInflate}, 1000), "");
    EXPECT_NE(problem(packed, {Codec::kInflate}, 999), "");
    EXPECT_NE(problem(packed, {Codec::kInflate}, 1001), "");
    for (std::size_t length = 0; length < packed.size(); ++length)
        EXPECT_NE(problem({packed.begin(), packed.begin() + length}, {Codec::kInflate}, 1000), "") << length;
    Bytes wrong = packed;
    wrong.back() ^= std::byte{1};
    EXPECT_THAT(problem(wrong, {Codec::kInflate}, 1000), HasSubstr("check"));
}

TEST(ChunkCodec, rubbish_is_refused_by_every_codec) {
    for (const char* name : {"zlib", "gzip", "zstd", "lz4", "blosc", "crc32c"}) {
        const Codec codec = parse_codec(name).value();
        for (const char* text : {"", "a", "abcdefgh", "LZ4Block", "LZ4Block\x20....\x08...........",
                                 "\x10\x00\x00\x00\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c"}) {
            EXPECT_NE(problem(bytes(text), {codec}, 16), "") << name << " " << text;
        }
    }
    EXPECT_FALSE(parse_codec("bz2"));
}

TEST(ChunkCodec, no_size_is_believed_that_the_codec_cannot_reach) {
    const std::vector<Codec> none, lz4{Codec::kLz4}, zstd{Codec::kZstd, Codec::kCrc32c};
    EXPECT_TRUE(may_hold(100, none, 100));
    EXPECT_FALSE(may_hold(100, none, 101));
    EXPECT_TRUE(may_hold(100, lz4, 25000));
    EXPECT_FALSE(may_hold(100, lz4, 30000));
    EXPECT_TRUE(may_hold(100, zstd, 3000000));
    EXPECT_FALSE(may_hold(100, zstd, 4000000));
}

}  // namespace
}  // namespace regionmesh::formats
