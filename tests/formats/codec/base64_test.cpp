#include "formats/codec/base64.h"

#include <gmock/gmock.h>

#include <string>

#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

class Base64 : public TemporaryFolder {
protected:
    /// What a stream over `text` gives, `piece` bytes at a time.
    std::string decoded(std::string_view text, std::size_t piece = 100) {
        put_text(path("base64.txt"), std::string(text));
        formats::Base64Stream stream{formats::InputFile(path("base64.txt"))};
        std::string bytes, part(piece, '\0');
        while (const std::size_t got = stream.read(std::as_writable_bytes(std::span(part))))
            bytes += part.substr(0, got);
        EXPECT_THAT(stream.problem(), testing::HasSubstr("ends early or is damaged"));
        return bytes;
    }
};

TEST_F(Base64, gives_the_vectors_of_rfc_4648) {
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
        EXPECT_EQ(decoded(text), bytes);
    }
}

TEST_F(Base64, text_does_not_depend_on_the_pieces) {
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

        EXPECT_EQ(decoded(whole, piece), bytes);
    }
}

TEST_F(Base64, streams_one_after_the_other_read_as_one) { EXPECT_EQ(decoded("Zg==Zm8=Zm9v"), "ffofoo"); }

TEST_F(Base64, white_space_is_skipped) { EXPECT_EQ(decoded("\n  Zm\t9v\r\nYm Fy\n"), "foobar"); }

TEST_F(Base64, bad_text_ends_the_stream) {
    EXPECT_EQ(decoded("Zm9v!m9v"), "foo");
    EXPECT_EQ(decoded("Zm9vZm9"), "foo");
    EXPECT_EQ(decoded("Zm9v===="), "foo");
    EXPECT_EQ(decoded("Zm9vZ=9v"), "foo");
    EXPECT_EQ(decoded("Zm9v\xff\xff\xff\xff"), "foo");
}

TEST_F(Base64, text_ends_at_a_tag_or_at_a_given_byte) {
    EXPECT_EQ(decoded("Zm9vYm<FyZm9v"), "foo");
    put_text(path("base64.txt"), "xxZm9vYmFy");
    formats::Base64Stream stream(formats::InputFile(path("base64.txt")), 2, 6);
    std::byte bytes[5];
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(stream.read(bytes), 3u);
        EXPECT_EQ(bytes[2], std::byte{'o'});
        stream.rewind();
        EXPECT_EQ(stream.problem(), "");
    }
}

TEST_F(Base64, text_of_any_length_is_read_in_parts) {
    std::string bytes;
    for (std::uint32_t i = 0; i < 100'000; ++i) bytes += static_cast<char>(i * i >> 3);
    std::string text = base64(bytes_of(bytes));
    for (std::size_t i = 77; i < text.size(); i += 77) text.insert(i, "\n");
    EXPECT_EQ(decoded(text, 4099), bytes);
}

}  // namespace
}  // namespace regionmesh
