// An HDF5 file read at arm's length: the library runs in a process of its own.
#pragma once

#include "formats/chunked/hdf5_catalogue.h"

namespace regionmesh::formats {

/// Hdf5Catalogue in a ChildProcess: of 15,498 damaged files, version 1.10.8 of the library crashed on 27, and never
/// came to an end with 8. Here that is an Error(kInput) that names the file, as everything else that is wrong with it.
class Hdf5Reader {
public:
    /// Throws where the file is missing, or does not begin as HDF5 files do.
    explicit Hdf5Reader(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    std::optional<Hdf5Entry> entry(const std::string& path);
    std::vector<Hdf5Entry> entries();
    /// Holds the samples twice, here and there, while they are handed over.
    Bytes read(const std::string& path, const Hdf5Box& box);

private:
    std::vector<Hdf5Entry> ask(const std::string& request, unsigned seconds);

    std::filesystem::path path_;
    ChildProcess child_;
};

}  // namespace regionmesh::formats
