// Reads arrays stored as a folder of chunks, one or several in each file: Zarr and N5.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/array/array_axes.h"
#include "formats/chunked/chunk_codec.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

/// The name of the file of a chunk: "c/0/1/2", "0.1.2".
struct ChunkNames {
    std::string prefix = {};
    char separator = '.';
    bool is_reversed = false;  // the fastest axis first
};

/// The metadata of an array. Lists have one entry for each axis, the slowest first.
struct StoreArray {
    std::filesystem::path folder;
    std::vector<std::uint64_t> shape = {};
    std::vector<std::uint64_t> chunk = {};  // samples packed together
    std::vector<std::uint64_t> file = {};   // samples in one file: of a chunk, or of a shard of chunks
    std::vector<int> stored = {};           // order of axes in a chunk
    SampleFormat format = {};
    std::vector<std::byte> fill = {};      // a stored sample, for missing chunks
    std::vector<Codec> codecs = {};        // of a chunk, in the order of packing
    std::vector<Codec> index_codecs = {};  // check sums of the index of a shard
    bool is_sharded = false;
    bool index_is_first = false;  // in a shard; else the index is last
    bool has_head = false;        // N5: chunks begin with their size
    ChunkNames names = {};
    std::vector<std::string> axis_names = {};
    nlohmann::json attributes = {};
};

/// What is known of the volume in addition to its samples.
struct StoreVolume {
    const char* format = "zarr";
    std::string source = {};  // the path given by the user
    ArrayAxes axes = {};
    Placement placement = {};
    LabelNames names = {};
    LabelColours colours = {};
    std::vector<std::filesystem::path> files = {};  // outside of the array, which describe it
};

/// Throws if lists have different lengths or a chunk is larger than a GiB. `metadata` is the file named in errors.
void check_array(const StoreArray& array, const std::filesystem::path& metadata);

/// Requires an array that passed check_array. Reads and unpacks one chunk at a time; missing chunks have the value
/// `fill`. Throws if there is no chunk at all.
std::unique_ptr<SectionReader> open_store_array(StoreArray array, StoreVolume volume, const ReadOptions& options);

/// The format of a word ("uint16", "bool", "float32"). Throws for any other word.
SampleFormat format_of(const std::filesystem::path& metadata, const std::string& word, bool is_big_endian = false);

/// Throws the error for a codec that is not read; it lists those that are.
[[noreturn]] void refuse_codec(const std::filesystem::path& metadata, const std::string& name);

}  // namespace regionmesh::formats
