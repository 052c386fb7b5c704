// What an HDF5 file holds, asked of the HDF5 library. Runs in the process that a damaged file may crash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/child_process.h"
#include "formats/chunked/hdf5_handle.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

/// A group or dataset, with the few numbers and words that may say what it means.
struct Hdf5Entry {
    std::string path;  // "/a/b"
    bool is_dataset = false;
    std::string type = {};                       // of a dataset's samples, in words: "uint16", "float32", "compound"
    std::optional<SampleType> sample_type = {};  // where they are integers, enumerations or bit fields
    std::vector<std::uint64_t> shape = {};       // slowest axis first
    std::vector<std::uint64_t> chunk = {};       // shape of the parts stored together; empty where it is not chunked
    std::uint64_t stored_bytes = 0;              // what its samples take in the file
    std::string obstacle = {};                   // why its samples cannot be read here, if so
    std::vector<double> values = {};             // of a dataset of at most 16 numbers
    std::map<std::string, std::vector<double>> numbers = {};  // attributes of at most 16 numbers
    std::map<std::string, std::string> words = {};            // attributes of one text
};

/// Part of an array: indices along each of its axes, slowest first.
struct Hdf5Box {
    std::vector<std::uint64_t> start;
    std::vector<std::uint64_t> count;
};

/// One open HDF5 file. Links to other places and files are followed where they are named, and not looked for in
/// entries(). Errors name the file.
class Hdf5Catalogue {
public:
    explicit Hdf5Catalogue(const std::filesystem::path& path);

    /// Nothing where there is no such object.
    std::optional<Hdf5Entry> entry(const std::string& path);
    /// All groups and datasets below the root, in order of their names, without words of variable length: in a damaged
    /// file the library may look for those for ever. Throws where there are more than 100,000.
    std::vector<Hdf5Entry> entries();
    /// Samples in the byte order of this machine, last axis fastest; reals of any size as doubles. Requires a
    /// sample_type or reals, and a box inside the array.
    Bytes read(const std::string& path, const Hdf5Box& box);

private:
    std::filesystem::path path_;
    Hdf5Silence silence_;
    Hdf5File file_;
    std::string open_path_;  // of dataset_
    Hdf5Dataset dataset_;
};

}  // namespace regionmesh::formats
