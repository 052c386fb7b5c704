// A volume as the header of its format describes it, and the one function that opens a reader for it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

enum class Encoding { kRaw, kDeflated, kAscii };

/// What NPY, NIfTI, NRRD, MetaImage, INR and raw files say. Samples lie without gaps.
struct ArrayFile {
    const char* format = "";                        // as VolumeInfo has it
    std::filesystem::path source = {};              // the file that the user named, for messages
    std::vector<std::filesystem::path> files = {};  // of samples, in order, of one size; none: `source`
    Encoding encoding = Encoding::kRaw;
    bool is_bare = false;  // deflated without the wrapper of gzip or zlib
    SampleFormat sample = {};
    Lattice lattice = {};               // shape along x, y, z, and the affine map
    std::array<int, 3> order{0, 1, 2};  // axes, the fastest first; raw samples in one file may have another order
    std::uint64_t end = UINT64_MAX;     // of samples as text, in the file
    std::uint64_t begin = 0;            // bytes to skip at the start of every file,
    std::uint64_t skipped_lines = 0;    // then lines to skip,
    std::int64_t skipped_bytes = 0;     // then bytes, counted after inflation; -1: the samples end the file
    std::uint32_t components = 1;       // values at each sample, and the index of the one to read
    std::uint32_t component = 0;
    std::uint32_t blocks = 1;  // volumes one after another, and the index of the one to read
    std::uint32_t block = 0;
    Space space = Space::kUnknown;
    std::optional<double> metres = {};  // in the unit of the lattice
    LabelNames names = {};
    LabelColours colours = {};
    std::string warning = {};   // as VolumeInfo has it
    bool can_sweep_all = true;  // if raw samples in one file; else along z alone
    const char* remedy = "write the samples uncompressed in one file";  // if the user wants another sweep
};

inline constexpr std::uint64_t kMostLayers = 4096;

/// An axis along which whole volumes follow one another.
struct BlockAxis {
    std::string name;  // in messages
    std::uint64_t size = 1;
};

/// Sets `blocks` and `block` of the array from its axes beyond the third, of which one may have more than one sample.
/// Throws where that needs options.layer, and where it is out of range.
void choose_block(const std::vector<BlockAxis>& axes, const ReadOptions& options, ArrayFile& array);

/// Raw samples in one file can be swept along any axis, unless can_sweep_all is false; all others along z. Requires a
/// lattice size from checked_size. The layer of the options stands for the block or component that was chosen. Throws
/// Error(kInput) where a file is missing or too short for the header.
std::unique_ptr<SectionReader> open_array(const ArrayFile& array, const ReadOptions& options);

/// The bytes of a file from its start, inflated if it is gzipped, whatever its name. `encoding` becomes kDeflated then.
std::unique_ptr<ByteStream> open_inflated(const std::filesystem::path& path, Encoding& encoding);

/// At most `most` bytes from the start of such a file; fewer where it ends. Throws where one that is gzipped ends, or
/// is damaged, before `least`.
std::vector<std::byte> read_header(const std::filesystem::path& path, Encoding& encoding, std::size_t least,
                                   std::size_t most);

/// Sets the names and colours of labels from a table beside the file, if there is one.
void take_table_beside(ArrayFile& array);

/// The path of a file that a header names: in the folder of the header, if the name is relative.
std::filesystem::path file_beside(const std::filesystem::path& header, std::string_view name);

/// The files named in the lines of `text`.
std::vector<std::filesystem::path> listed_files(const std::filesystem::path& header, std::string_view text);

/// The files of "name%03d.raw 1 10 1": a pattern with one number in it, the first, the last and the step (default 1).
/// With a count of files, the first (default 1) and the last may be left out.
std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& header, std::string_view text,
                                                  std::optional<std::uint32_t> count = {});

/// Whether `text` has one number to fill in, as numbered_files needs it.
bool is_pattern(std::string_view text);

}  // namespace regionmesh::formats
