// An HDF5 file, read by the program regionmesh-hdf5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/asked_program.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// A group or dataset, with the few numbers and words that may describe its meaning.
struct Hdf5Entry {
    std::string path;  // "/a/b"
    bool is_dataset = false;
    std::string type = {};                       // of a dataset's samples, in words: "uint16", "float32", "compound"
    std::optional<SampleType> sample_type = {};  // where they are integers, enumerations or bit fields
    std::vector<std::uint64_t> shape = {};       // slowest axis first
    std::vector<std::uint64_t> chunk = {};       // shape of the parts stored together; empty if contiguous
    std::uint64_t stored_bytes = 0;              // size of the samples in the file
    std::string obstacle = {};                   // why the samples cannot be read, if so
    std::vector<double> values = {};             // of a dataset of at most 16 numbers
    std::map<std::string, std::vector<double>> numbers = {};  // attributes of at most 16 numbers
    std::map<std::string, std::string> words = {};            // attributes of one text
};

/// Part of an array: indices along each axis, the slowest first.
struct Hdf5Box {
    std::vector<std::uint64_t> start;
    std::vector<std::uint64_t> count;
};

/// Asks regionmesh-hdf5 (apps/hdf5/README.md), which ends with this object. Requires one caller at a time.
class Hdf5Reader {
public:
    /// Throws where the file is missing or does not begin as HDF5 files do, or where the program is not found.
    explicit Hdf5Reader(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    /// Nothing where there is no such object. Follows links.
    std::optional<Hdf5Entry> entry(const std::string& path);
    /// All groups and datasets, ordered by name, without words of variable length. Follows no links.
    std::vector<Hdf5Entry> entries();
    /// Samples in the byte order of this machine, last axis fastest; reals of any size as doubles. Requires integers or
    /// reals, and a box inside the array. Holds the samples twice, here and in the program, while they are sent.
    Bytes read(const std::string& path, const Hdf5Box& box);

private:
    std::vector<Hdf5Entry> ask_entries(const std::string& request);

    std::filesystem::path path_;
    AskedProgram program_;
};

}  // namespace regionmesh::formats
