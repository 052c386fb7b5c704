// Unpacks the chunks of Zarr and N5 stores.
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
    kInflate,  // zlib or gzip, decided by the first bytes
    kZstd,
    kLz4,  // 4 bytes of length and one LZ4 block (numcodecs), or the blocks of lz4-java, decided by the first bytes
    kBlosc,
    kCrc32c,  // 4 bytes appended
};

/// Knows "zlib", "gzip", "zstd", "lz4", "blosc" and "crc32c".
std::optional<Codec> parse_codec(std::string_view name);

/// Undoes `codecs`, given in the order of packing, and fills `bytes`. Returns an empty string, or what is wrong with
/// the chunk. At most one codec compresses; any number are check sums. Allocates nothing by sizes read from `packed`.
/// Verifies the check sums of zlib, gzip, zstd and crc32c.
std::string unpack(std::span<const std::byte> packed, std::span<const Codec> codecs, std::span<std::byte> bytes);

/// False if `packed_bytes` of these codecs cannot unpack to `bytes`: the size is damaged, and must not be allocated.
bool may_hold(std::uint64_t packed_bytes, std::span<const Codec> codecs, std::uint64_t bytes);

/// The Castagnoli check sum, as in iSCSI (RFC 3720).
std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace regionmesh::formats
