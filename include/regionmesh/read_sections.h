// Opens label volumes of every format that regionmesh reads.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"
#include "regionmesh/select_sections.h"

namespace regionmesh {

/// Work of a volume: its samples, and kSectionWork for each section, which takes about as long. 10^12 samples take some
/// hours.
inline constexpr std::uint64_t kMostWork = 1'000'000'000'000, kSectionWork = 4096;

/// How to open a volume; all optional.
struct ReadOptions {
    SweepChoice sweep = SweepChoice::kAuto;  // kAuto: along the axis with the smallest section (P 3.1)
    std::optional<Vec3> spacing = {};        // replaces the spacing of the file, in its unit
    std::optional<std::array<std::uint32_t, 3>> raw_size = {};  // raw files: samples along x, y, z
    std::optional<SampleType> raw_type = {};                    // raw files: type of the little-endian samples
    std::optional<std::uint32_t> layer = {};                    // of a file with several layers, counted from 0
    std::vector<std::string> priority = {};  // of overlapping masks: names or labels, from the one that wins; then the
                                             // others, the last first
    std::vector<double> threshold =
        {};               // rising: a label is the number of these that a sample reaches; none: the sample
    bool argmax = false;  // volumes of one file, or several files, are shares or distances of labels, and the
                          // label is that of the largest; where that is below `threshold`, it is 0
    std::optional<double> pitch = {};        // contours: distance of samples in a section; none: from the contours
    Space space = Space::kUnknown;           // turns the volume into this space, if its file says another
    std::uint64_t max_work = kMostWork;      // refuses volumes of more work, which a tiny file may describe
    bool external_files = false;             // a header may name files outside its own folder and those below it
    Selection select = {};                   // part of the volume, labels, coarser samples
    std::filesystem::path merge_table = {};  // adds to select.merge and select.names: read_merge_table()
};

/// ".npy .nii .nii.gz ...": the extensions that this build reads.
std::string volume_extensions();

/// Opens one volume file, one directory of sections, or a list of section files in the order given.
/// docs/reference/files.md lists the formats. A dataset of an HDF5 file is named as `file.h5:/path`; HDF5 files are
/// read by the program regionmesh-hdf5, DICOM segmentations by regionmesh-dicom. A directory is a Zarr or N5 store, or
/// its images are sections in natural order (s2 before s10). Throws Error(kInput) for a missing or unreadable file, an
/// unknown format or one that this build leaves out, float or complex samples, an empty volume, sections of different
/// size, or a sweep that the format does not allow.
std::unique_ptr<SectionReader> open_sections(const std::vector<std::filesystem::path>& inputs,
                                             const ReadOptions& options = {});

/// Reads a table with rows old,new[,name] into `selection`: an old label, or several as 5-9, then the new one and its
/// name. A first row without labels is a header. Throws Error(kInput) naming file and row.
void read_merge_table(const std::filesystem::path& path, Selection& selection);

/// "bool", "int8" to "int64", "uint8" to "uint64"; --type takes the same words.
std::string to_string(SampleType type);
std::optional<SampleType> parse_sample_type(const std::string& word);

}  // namespace regionmesh
