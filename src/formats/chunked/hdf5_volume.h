// A volume in an HDF5 file, section by section.
#pragma once

#include <memory>
#include <optional>

#include "formats/array/array_axes.h"
#include "formats/chunked/hdf5_reader.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

/// The chosen dataset, and its position in space.
struct Hdf5Volume {
    const char* format = "hdf5";
    std::string source = {};  // FILE:DATASET
    Hdf5Entry dataset = {};
    Placement placement = {};
    std::optional<std::array<std::uint64_t, 3>> flat_size = {};  // x, y, z of a dataset with one long axis, x fastest
    std::vector<std::string> axis_names = {};
};

/// "/cells (uint16, 4 x 5 x 6)"
/// Of the samples that the program hands over; none where they are no numbers.
std::optional<SampleFormat> format_of(const Hdf5Entry& dataset);

std::string describe(const Hdf5Entry& dataset);

/// "a.h5:/cells (uint16, 4 x 5 x 6), a.h5:/mask (...)": at most eight, for an error.
std::string list_datasets(const std::filesystem::path& file, const std::vector<Hdf5Entry>& datasets);

/// Throws if the samples are no integers, or cannot be read.
void require_labels(const std::string& source, const Hdf5Entry& dataset);

/// Requires a dataset that passed require_labels.
std::unique_ptr<SectionReader> open_hdf5_volume(std::unique_ptr<Hdf5Reader> file, const Hdf5Volume& volume,
                                                const ReadOptions& options);

}  // namespace regionmesh::formats
