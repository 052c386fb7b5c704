#include "formats/codec/base64.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace regionmesh {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string decoded(std::string_view text, std::size_t most) {
    std::string bytes(most, '\0');
    Base64Decoder decoder(text);
    bytes.resize(decoder.read(std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

TEST(Base64, gives_the_vectors_of_rfc_4648) {
    const std::pair<std::string, std::string> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(base64(bytes_of(bytes)), text);
        EXPECT_EQ(base64_length(bytes.size()), text.size());
        EXPECT_EQ(decoded(text, 100), bytes);
    }
}

TEST(Base64, text_does_not_depend_on_the_pieces) {
    std::string bytes;
    for (int i = 0; i < 300; ++i) bytes += static_cast<char>(i * 7);
    const std::string whole = base64(bytes_of(bytes));
    for (std::size_t piece = 1; piece < 8; ++piece) {
        Base64Encoder encoder;
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += piece)
            encoder.encode(bytes_of(std::string_view(bytes).substr(i, piece)), text);
        encoder.finish(text);
        EXPECT_EQ(text, whole);

        Base64Decoder decoder(whole);
        std::string back;
        for (std::string part(piece, '\0');
             const std::size_t got = decoder.read(std::as_writable_bytes(std::span(part)));)
            back += part.substr(0, got);
        EXPECT_EQ(back, bytes);
    }
}

TEST(Base64, streams_one_after_the_other_read_as_one) { EXPECT_EQ(decoded("Zg==Zm8=Zm9v", 100), "ffofoo"); }

TEST(Base64, white_space_is_skipped) { EXPECT_EQ(decoded("\n  Zm\t9v\r\nYm Fy\n", 100), "foobar"); }

TEST(Base64, bad_text_ends_the_stream) {
    EXPECT_EQ(decoded("Zm9v!m9v", 100), "foo");
    EXPECT_EQ(decoded("Zm9vZm9", 100), "foo");
    EXPECT_EQ(decoded("Zm9v====", 100), "foo");
    EXPECT_EQ(decoded("Zm9vZ=9v", 100), "foo");
    EXPECT_EQ(decoded("Zm9v\xff\xff\xff\xff", 100), "foo");
}

TEST(Base64, most_left_is_an_upper_bound) {
    Base64Decoder decoder("Zm9vYmE=");
    std::byte bytes[5];
    EXPECT_GE(decoder.most_left(), 5u);
    EXPECT_EQ(decoder.read(std::span(bytes).first(4)), 4u);
    EXPECT_EQ(decoder.most_left(), 1u);
    EXPECT_EQ(decoder.read(std::span(bytes).first(1)), 1u);
    EXPECT_EQ(decoder.most_left(), 0u);
}

}  // namespace
}  // namespace regionmesh
