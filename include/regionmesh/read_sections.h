// Opens label volumes of every format that regionmesh reads.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// How to open a volume; all optional.
struct ReadOptions {
    SweepChoice sweep = SweepChoice::kAuto;  // kAuto: along the axis with the smallest section (P 3.1)
    std::optional<Vec3> spacing = {};        // instead of the file's own
    std::optional<std::array<std::uint32_t, 3>> raw_size = {};  // raw files: samples along x, y, z
    std::optional<SampleType> raw_type = {};                    // raw files: little-endian samples
    std::optional<std::uint32_t> layer = {};                    // of a file that holds several, counted from 0
};

/// Opens one volume file, one directory of sections, or a list of section files in the order given.
/// `.npy .nii .nii.gz .nrrd .nhdr .mha .mhd .vti .inr .inr.gz .tif .tiff .png .raw .h5 .hdf5 .dream3d .zarr .n5`; a
/// dataset of an HDF5 file is named as `file.h5:/path`. Directories take their images in natural order (s2 before s10),
/// unless they are Zarr or N5 stores. HDF5 files are read by a copy of the process, made by fork. Throws Error(kInput)
/// for a missing or unreadable file, unknown format, float or complex samples, an empty volume, sections of different
/// size, or a sweep that the format cannot do.
std::unique_ptr<SectionReader> open_sections(const std::vector<std::filesystem::path>& inputs,
                                             const ReadOptions& options = {});

/// "uint16" and the like; the same words are accepted by --type.
std::string to_string(SampleType type);
std::optional<SampleType> parse_sample_type(const std::string& word);

}  // namespace regionmesh
