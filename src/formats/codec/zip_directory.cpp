// https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT
#include "formats/codec/zip_directory.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

#include "formats/codec/numbers.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint32_t kEndMark = 0x06054b50, kEnd64Mark = 0x06064b50, kLocator64Mark = 0x07064b50,
                        kEntryMark = 0x02014b50, kLocalMark = 0x04034b50;
constexpr std::size_t kEndBytes = 22, kLocatorBytes = 20, kEnd64Bytes = 56, kEntryBytes = 46, kLocalBytes = 30;
constexpr std::size_t kMostComment = 0xFFFF;
constexpr std::uint32_t kIn64 = 0xFFFFFFFF;  // the number stands in an extra field
constexpr std::uint16_t kStored = 0, kDeflated = 8, kEncrypted = 1, kExtra64 = 1;
constexpr std::uint64_t kMostEntries = 1'000'000, kMostDirectory = std::uint64_t{1} << 30;

[[noreturn]] void refuse(const InputFile& file) {
    fail(file.path(), "is no zip archive, or a damaged one; fetch it again");
}

template <class T>
T number(std::span<const std::byte> bytes, std::size_t place) {
    return load<T>(&bytes[place], false);
}

std::vector<std::byte> bytes_at(const InputFile& file, std::uint64_t place, std::size_t count) {
    std::vector<std::byte> bytes(count);
    if (place > file.size() || file.read(place, bytes) < count) refuse(file);
    return bytes;
}

struct Directory {
    std::uint64_t begin = 0, bytes = 0, entries = 0;
};

Directory find_directory(const InputFile& file) {
    const std::uint64_t most = std::min<std::uint64_t>(file.size(), kEndBytes + kMostComment);
    const std::vector<std::byte> tail = bytes_at(file, file.size() - most, most);
    for (std::size_t at = tail.size(); at-- > 0;) {
        if (tail.size() - at < kEndBytes || number<std::uint32_t>(tail, at) != kEndMark) continue;
        const auto end = std::span(tail).subspan(at);
        Directory found{number<std::uint32_t>(end, 16), number<std::uint32_t>(end, 12), number<std::uint16_t>(end, 10)};
        const std::uint64_t place = file.size() - most + at;
        if ((found.begin == kIn64 || found.entries == 0xFFFF || found.bytes == kIn64) && place >= kLocatorBytes) {
            const auto locator = bytes_at(file, place - kLocatorBytes, kLocatorBytes);
            if (number<std::uint32_t>(locator, 0) != kLocator64Mark) return found;
            const auto end64 = bytes_at(file, number<std::uint64_t>(locator, 8), kEnd64Bytes);
            if (number<std::uint32_t>(end64, 0) != kEnd64Mark) refuse(file);
            found = {number<std::uint64_t>(end64, 48), number<std::uint64_t>(end64, 40),
                     number<std::uint64_t>(end64, 32)};
        }
        return found;
    }
    refuse(file);
}

/// Numbers of 64 bits in the extra field, in the order of those that are missing in the entry.
void take_extra(std::span<const std::byte> extra, std::span<std::uint64_t* const> missing) {
    while (extra.size() >= 4) {
        const std::size_t size = number<std::uint16_t>(extra, 2);
        if (size > extra.size() - 4) return;
        if (number<std::uint16_t>(extra, 0) == kExtra64) {
            std::size_t at = 4;
            for (std::uint64_t* const value : missing) {
                if (at + 8 > 4 + size) return;
                *value = number<std::uint64_t>(extra, at);
                at += 8;
            }
            return;
        }
        extra = extra.subspan(4 + size);
    }
}

}  // namespace

std::vector<ZipEntry> zip_entries(const InputFile& file) {
    const Directory directory = find_directory(file);
    if (directory.entries > kMostEntries || directory.bytes > kMostDirectory || directory.begin > file.size() ||
        directory.bytes > file.size() - directory.begin)
        refuse(file);
    const std::vector<std::byte> all = bytes_at(file, directory.begin, directory.bytes);
    std::span<const std::byte> rest = all;
    std::vector<ZipEntry> entries;
    for (std::uint64_t n = 0; n < directory.entries; ++n) {
        if (rest.size() < kEntryBytes || number<std::uint32_t>(rest, 0) != kEntryMark) refuse(file);
        const auto flags = number<std::uint16_t>(rest, 8), method = number<std::uint16_t>(rest, 10);
        const std::size_t name = number<std::uint16_t>(rest, 28), extra = number<std::uint16_t>(rest, 30),
                          comment = number<std::uint16_t>(rest, 32);
        if (rest.size() < kEntryBytes + name + extra + comment) refuse(file);
        ZipEntry entry{.name = {reinterpret_cast<const char*>(&rest[kEntryBytes - 1]) + 1, name},
                       .packed_bytes = number<std::uint32_t>(rest, 20),
                       .bytes = number<std::uint32_t>(rest, 24),
                       .is_deflated = method == kDeflated};
        std::uint64_t local = number<std::uint32_t>(rest, 42);
        std::vector<std::uint64_t*> missing;
        for (std::uint64_t* const value : {&entry.bytes, &entry.packed_bytes, &local})
            if (*value == kIn64) missing.push_back(value);
        take_extra(rest.subspan(kEntryBytes + name, extra), missing);
        rest = rest.subspan(kEntryBytes + name + extra + comment);
        if ((flags & kEncrypted) != 0 || (method != kStored && method != kDeflated)) continue;
        const auto head = bytes_at(file, local, kLocalBytes);
        if (number<std::uint32_t>(head, 0) != kLocalMark) refuse(file);
        entry.begin = local + kLocalBytes + number<std::uint16_t>(head, 26) + number<std::uint16_t>(head, 28);
        if (entry.begin > file.size() || entry.packed_bytes > file.size() - entry.begin) refuse(file);
        entries.push_back(std::move(entry));
    }
    return entries;
}

}  // namespace regionmesh::formats
