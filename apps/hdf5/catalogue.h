// Describes and reads the objects of one HDF5 file with the HDF5 library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/chunked/hdf5_handle.h"
#include "helper/serve.h"

namespace regionmesh::hdf5 {

using helper::Refusal;

/// A group or dataset, with the few numbers and words that may describe its meaning. README.md explains the members.
struct Entry {
    std::string path;
    bool is_dataset = false;
    std::string type = {};
    bool is_integer = false;
    std::vector<std::uint64_t> shape = {};
    std::vector<std::uint64_t> chunk = {};
    std::uint64_t stored_bytes = 0;
    std::string obstacle = {};
    std::vector<double> values = {};
    std::map<std::string, std::vector<double>> numbers = {};
    std::map<std::string, std::string> words = {};
};

/// Part of an array: indices along each axis, the slowest first.
struct Box {
    std::vector<std::uint64_t> start;
    std::vector<std::uint64_t> count;
};

/// One open file. Links are followed where they are named, but not while entries() are collected.
class Catalogue {
public:
    explicit Catalogue(const std::string& file);

    /// Nothing where there is no such object.
    std::optional<Entry> entry(const std::string& path);
    /// All groups and datasets below the root, ordered by name, without words of variable length: in a damaged file the
    /// library may search for those without end. Throws where there are more than 100,000.
    std::vector<Entry> entries();
    /// Samples in the byte order of this machine, the last axis fastest; reals of any size as doubles. Requires
    /// integers or reals, and a box inside the array.
    std::vector<std::byte> read(const std::string& path, const Box& box);

private:
    std::string name_;
    formats::Hdf5Silence silence_;
    formats::Hdf5File file_;
    std::string open_path_;  // open path of dataset_
    formats::Hdf5Dataset dataset_;
};

}  // namespace regionmesh::hdf5
