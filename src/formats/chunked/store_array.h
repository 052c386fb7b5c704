// Arrays kept as a folder of chunks, a file each or several in one: Zarr and N5.
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

/// How the file of a chunk is called: "c/0/1/2", "0.1.2".
struct ChunkNames {
    std::string prefix = {};
    char separator = '.';
    bool is_reversed = false;  // the fastest axis first
};

/// What the metadata of an array say. Lists have one entry for each axis, the slowest first.
struct StoreArray {
    std::filesystem::path folder;
    std::vector<std::uint64_t> shape = {};
    std::vector<std::uint64_t> chunk = {};  // samples packed together
    std::vector<std::uint64_t> file = {};   // samples in one file: those of a chunk, or of a shard of chunks
    std::vector<int> stored = {};           // axes in the order in which a chunk has them
    SampleFormat format = {};
    std::vector<std::byte> fill = {};      // a sample as stored, for chunks that are not there
    std::vector<Codec> codecs = {};        // of a chunk, in the order in which they were applied
    std::vector<Codec> index_codecs = {};  // check sums of the index of a shard
    bool is_sharded = false;
    bool index_is_first = false;  // in a shard; else it is last
    bool has_head = false;        // N5: chunks say their own size first
    ChunkNames names = {};
    std::vector<std::string> axis_names = {};
    nlohmann::json attributes = {};
};

/// What a store says of an array beside its samples.
struct StoreVolume {
    const char* format = "zarr";
    std::string source = {};  // as the user named it
    ArrayAxes axes = {};
    Placement placement = {};
    LabelNames names = {};
};

/// Throws where lists of the metadata do not fit each other, or a chunk is larger than a GiB. `metadata` is named.
void check_array(const StoreArray& array, const std::filesystem::path& metadata);

/// Requires an array that passed check_array. Chunks are read and unpacked one at a time; those that are not there are
/// `fill`. Throws where there is no chunk at all.
std::unique_ptr<SectionReader> open_store_array(StoreArray array, StoreVolume volume, const ReadOptions& options);

/// An integer type by its word ("uint16", "bool"); refused otherwise, naming floats and the rest.
SampleType integer_type(const std::filesystem::path& metadata, const std::string& word);

/// Throws for what is not read, naming it and what is.
[[noreturn]] void refuse_codec(const std::filesystem::path& metadata, const std::string& name);

}  // namespace regionmesh::formats
