// How the chunks of Zarr and N5 stores are packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh::formats {

enum class Codec {
    kInflate,  // zlib or gzip, whichever its first bytes say
    kZstd,
    kLz4,  // numcodecs: 4 bytes of length, one LZ4 block; or the blocks of lz4-java, whichever its first bytes say
    kBlosc,
    kCrc32c,  // 4 bytes behind the others
};

/// "zlib", "gzip", "zstd", "lz4", "blosc" and "crc32c"; no others.
std::optional<Codec> parse_codec(std::string_view name);

/// Unpacks what `codecs`, in the order in which they were applied, made of as many bytes as `bytes` has. At most one of
/// them compresses, any number are check sums. Empty where that worked, else what is wrong. Nothing is allocated for
/// sizes that `packed` claims; check sums of zlib, gzip, zstd and crc32c are verified.
std::string unpack(std::span<const std::byte> packed, std::span<const Codec> codecs, std::span<std::byte> bytes);

/// False where no `packed_bytes` of these codecs can hold `bytes`: a damaged size, to be refused before it is
/// allocated.
bool may_hold(std::uint64_t packed_bytes, std::span<const Codec> codecs, std::uint64_t bytes);

/// The Castagnoli check sum, as in iSCSI (RFC 3720).
std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace regionmesh::formats
