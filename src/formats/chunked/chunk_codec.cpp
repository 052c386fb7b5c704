#include "formats/chunked/chunk_codec.h"

#include <blosc.h>
#include <lz4.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "formats/array/volume_size.h"
#include "formats/codec/numbers.h"

namespace regionmesh::formats {
namespace {

using Packed = std::span<const std::byte>;

constexpr std::string_view kLz4JavaMagic = "LZ4Block";
constexpr std::size_t kLz4JavaHead = 21;           // magic, token, two lengths, check sum
constexpr unsigned kLz4JavaStored = 0x10;          // high half of the token: not compressed
constexpr unsigned kLz4JavaCompressed = 0x20;      // compressed
constexpr std::uint64_t kMaxLz4Growth = 255;       // a length byte adds at most 255 bytes
constexpr std::uint64_t kMaxZstdGrowth = 1 << 15;  // a block of 4 bytes repeats one 128 KiB long

std::uint32_t little_endian(const std::byte* bytes) { return load<std::uint32_t>(bytes, false); }

std::string length_problem(std::uint64_t there, std::uint64_t wanted) {
    return "it holds " + std::to_string(there) + " bytes where a chunk has " + std::to_string(wanted);
}

std::string inflate_chunk(Packed packed, std::span<std::byte> bytes) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return "zlib cannot start";
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = static_cast<uInt>(bytes.size());
    int status = inflate(&stream, Z_FINISH);
    // The check sum follows the last byte; inflate has not read it yet if all bytes just fit.
    std::array<Bytef, 1> beyond{};
    if (status == Z_BUF_ERROR && stream.avail_out == 0) {
        stream.next_out = beyond.data();
        stream.avail_out = beyond.size();
        status = inflate(&stream, Z_FINISH);
        if (stream.avail_out == 0) status = Z_BUF_ERROR;
    }
    std::string problem;
    if (status != Z_STREAM_END) problem = stream.msg ? stream.msg : "the zlib stream has another length than the chunk";
    if (status == Z_STREAM_END && stream.total_out != bytes.size())
        problem = length_problem(stream.total_out, bytes.size());
    inflateEnd(&stream);
    return problem;
}

std::string unpack_zstd(Packed packed, std::span<std::byte> bytes) {
    const std::size_t count = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
    if (ZSTD_isError(count)) return std::string("zstd: ") + ZSTD_getErrorName(count);
    return count == bytes.size() ? "" : length_problem(count, bytes.size());
}

std::string unpack_lz4_block(Packed packed, std::span<std::byte> bytes) {
    const int count =
        LZ4_decompress_safe(reinterpret_cast<const char*>(packed.data()), reinterpret_cast<char*>(bytes.data()),
                            static_cast<int>(packed.size()), static_cast<int>(bytes.size()));
    if (count < 0) return "the LZ4 block is damaged";
    return static_cast<std::size_t>(count) == bytes.size() ? "" : length_problem(count, bytes.size());
}

/// Blocks one after another, up to an empty block. Their check sums (xxhash) are not verified.
std::string unpack_lz4_java(Packed packed, std::span<std::byte> bytes) {
    while (packed.size() >= kLz4JavaHead &&
           std::memcmp(packed.data(), kLz4JavaMagic.data(), kLz4JavaMagic.size()) == 0) {
        const unsigned kind = std::to_integer<unsigned>(packed[8]) & 0xF0;
        const std::size_t packed_size = little_endian(&packed[9]), size = little_endian(&packed[13]);
        packed = packed.subspan(kLz4JavaHead);
        if (size == 0) return bytes.empty() ? "" : "its LZ4 blocks end early";
        if (packed_size > packed.size() || size > bytes.size()) return "an LZ4 block is longer than the chunk";
        if (kind == kLz4JavaStored && packed_size == size) {
            std::memcpy(bytes.data(), packed.data(), size);
        } else if (kind != kLz4JavaCompressed) {
            return "an LZ4 block of an unknown kind";
        } else if (std::string problem = unpack_lz4_block(packed.first(packed_size), bytes.first(size));
                   !problem.empty()) {
            return problem;
        }
        packed = packed.subspan(packed_size);
        bytes = bytes.subspan(size);
    }
    return bytes.empty() && packed.empty() ? "" : "its LZ4 blocks end early";
}

std::string unpack_lz4(Packed packed, std::span<std::byte> bytes) {
    if (packed.size() >= kLz4JavaMagic.size() &&
        std::memcmp(packed.data(), kLz4JavaMagic.data(), kLz4JavaMagic.size()) == 0) {
        return unpack_lz4_java(packed, bytes);
    }
    if (packed.size() < 4) return "the LZ4 block has no length";
    if (little_endian(packed.data()) != bytes.size()) return length_problem(little_endian(packed.data()), bytes.size());
    return unpack_lz4_block(packed.subspan(4), bytes);
}

std::string unpack_blosc(Packed packed, std::span<std::byte> bytes) {
    std::size_t size = 0;
    if (blosc_cbuffer_validate(packed.data(), packed.size(), &size) != 0) return "the Blosc buffer is damaged";
    if (size != bytes.size()) return length_problem(size, bytes.size());
    if (bytes.empty()) return "";
    const int count = blosc_decompress_ctx(packed.data(), bytes.data(), bytes.size(), 1);
    return count == static_cast<int>(bytes.size()) ? ""
                                                   : "the Blosc buffer is damaged, or packed by a codec unknown here";
}

std::string decompress(Packed packed, Codec codec, std::span<std::byte> bytes) {
    switch (codec) {
        case Codec::kInflate:
            return inflate_chunk(packed, bytes);
        case Codec::kZstd:
            return unpack_zstd(packed, bytes);
        case Codec::kLz4:
            return unpack_lz4(packed, bytes);
        case Codec::kBlosc:
            return unpack_blosc(packed, bytes);
        case Codec::kCrc32c:
            break;
    }
    return "no compressor";
}

constexpr std::array<std::uint32_t, 256> crc32c_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t rest = i;
        for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0x82F63B78u : 0);  // Castagnoli, reflected
        table[i] = rest;
    }
    return table;
}

/// Removes the check sums from the end, the last one first; false if one does not match.
bool strip_check_sums(Packed& packed, std::size_t count) {
    for (; count > 0; --count) {
        if (packed.size() < 4) return false;
        const std::uint32_t sum = little_endian(&packed[packed.size() - 4]);
        packed = packed.first(packed.size() - 4);
        if (crc32c(packed) != sum) return false;
    }
    return true;
}

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes) {
    static constexpr auto kTable = crc32c_table();
    std::uint32_t rest = ~0u;
    for (const std::byte byte : bytes) rest = rest >> 8 ^ kTable[(rest ^ std::to_integer<std::uint32_t>(byte)) & 0xFF];
    return ~rest;
}

std::optional<Codec> parse_codec(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Codec>, 6> kNames{{{"zlib", Codec::kInflate},
                                                                        {"gzip", Codec::kInflate},
                                                                        {"zstd", Codec::kZstd},
                                                                        {"lz4", Codec::kLz4},
                                                                        {"blosc", Codec::kBlosc},
                                                                        {"crc32c", Codec::kCrc32c}}};
    for (const auto& [known, codec] : kNames) {
        if (known == name) return codec;
    }
    return std::nullopt;
}

std::string unpack(std::span<const std::byte> packed, std::span<const Codec> codecs, std::span<std::byte> bytes) {
    constexpr const char* kBadSum = "its check sum (crc32c) does not match";
    const auto compressor = std::ranges::find_if(codecs, [](Codec codec) { return codec != Codec::kCrc32c; });
    const auto inner = static_cast<std::size_t>(compressor - codecs.begin());
    const std::size_t outer = codecs.size() - inner - (compressor == codecs.end() ? 0 : 1);
    if (!strip_check_sums(packed, outer)) return kBadSum;
    std::vector<std::byte> with_sums;
    if (compressor != codecs.end()) {
        if (inner == 0) return decompress(packed, *compressor, bytes);
        with_sums.resize(bytes.size() + 4 * inner);
        if (std::string problem = decompress(packed, *compressor, with_sums); !problem.empty()) return problem;
        packed = with_sums;
    }
    if (!strip_check_sums(packed, inner)) return kBadSum;
    if (packed.size() != bytes.size()) return length_problem(packed.size(), bytes.size());
    std::memcpy(bytes.data(), packed.data(), bytes.size());
    return "";
}

bool may_hold(std::uint64_t packed_bytes, std::span<const Codec> codecs, std::uint64_t bytes) {
    std::uint64_t growth = 1;
    for (const Codec codec : codecs) {
        if (codec == Codec::kInflate) growth = kMaxInflation;
        if (codec == Codec::kLz4) growth = kMaxLz4Growth;
        if (codec == Codec::kZstd || codec == Codec::kBlosc) growth = kMaxZstdGrowth;
    }
    return bytes / growth <= packed_bytes;
}

}  // namespace regionmesh::formats
