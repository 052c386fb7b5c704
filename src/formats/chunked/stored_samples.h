// Samples that a text header describes: behind it, in a file of their own, or in several.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

enum class Encoding { kRaw, kDeflated, kAscii };

/// x fastest, then y, then z.
struct StoredSamples {
    std::vector<std::filesystem::path> files;  // one behind the other, with as many samples in each
    Encoding encoding = Encoding::kRaw;
    SampleFormat format;
    std::uint64_t begin = 0;          // in every file: bytes that are passed over,
    std::uint64_t skipped_lines = 0;  // then lines,
    std::int64_t skipped_bytes = 0;   // then bytes, inflated where deflated; -1: samples are what ends the file
    std::uint32_t components = 1;     // that lie together at each sample, and the one to read
    std::uint32_t component = 0;
    std::uint32_t blocks = 1;  // whole volumes one behind the other, and the one to read
    std::uint32_t block = 0;
};

inline constexpr std::uint64_t kMostLayers = 4096;

/// Requires info.source (the header), format, type and lattice. One raw file can be swept along any axis, all else
/// along z. Throws where a file is missing or too short.
std::unique_ptr<SectionReader> open_samples(const StoredSamples& samples, VolumeInfo info, const ReadOptions& options);

/// The file that a header names: beside it, where the path is relative.
std::filesystem::path file_beside(const std::filesystem::path& header, std::string_view name);

/// The files named in the lines of `text`.
std::vector<std::filesystem::path> listed_files(const std::filesystem::path& header, std::string_view text);

/// The files of "name%03d.raw 1 10 1": a pattern with one number in it, the first, the last and the step (1 if left
/// out). Throws where one is missing.
std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& header, std::string_view text);

/// Whether `text` has a number to be filled in, as numbered_files needs it.
bool is_pattern(std::string_view text);

}  // namespace regionmesh::formats
