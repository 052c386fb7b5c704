// The formats of files: one table, one row each.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "formats/array/volume_formats.h"
#include "formats/images/image_formats.h"
#include "formats/surface/file_surface.h"
#include "formats/surface/mesh_formats.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"
#include "regionmesh/read_layers.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/read_tetrahedra.h"
#include "surface/file_view.h"

namespace regionmesh::formats {

/// A part of the library that a build may leave out, by the CMake option REGIONMESH_WITH_ and `option`.
struct Part {
    const char* option = nullptr;
    bool is_built = true;
};

/// A format is the file of its functions and a row in registry.cpp. Functions that it has not are null; those of a part
/// that is not built are null, too.
struct Format {
    using Path = std::filesystem::path;

    const char* name;                             // in messages
    std::array<const char*, 12> extensions = {};  // in lower case; null after the last
    Part part = {};
    const char* refusal = nullptr;  // for a format that is known but not read: what to do

    // Volumes.
    Opener* open_sections = nullptr;
    bool (*detect)(const Path& folder) = nullptr;  // for a format that is a folder: whether its files say so
    bool is_folder = false;
    bool (*detect_file)(const InputFile&) = nullptr;  // for a format whose files may have any extension
    bool has_datasets = false;                        // "FILE:/DATASET" names one of several volumes
    bool is_image = false;                            // a file may be one section of a volume
    ReadShape* read_shape = nullptr;                  // of one image
    ReadImage* read_image = nullptr;
    IsTiled* is_tiled = nullptr;  // null where no image is
    ReadWindow* read_window = nullptr;

    // Labelled tetrahedra.
    std::unique_ptr<TetrahedronReader> (*open_tetrahedra)(const Path&, const TetrahedraOptions&) = nullptr;
    bool is_table = false;  // of points, not a mesh
    std::unique_ptr<SectionReader> (*open_layers)(const Path&, const TetrahedraOptions&, const LayerOptions&,
                                                  LayerSummary*) = nullptr;

    // Models.
    bool holds_surface = false;  // only set where the functions may be left out
    FileSurface (*read_surface)(const Path&) = nullptr;
    void (*write_surface)(const FileView&, const WriteOptions&, OutputFiles&, const Path&) = nullptr;
    void (*write_region)(const FileView&, const RegionStyle&, OutputFile&) = nullptr;  // one region as a file
    void (*write_companion)(const FileView&, OutputFile&) = nullptr;  // of the files of regions, by the model's name
    bool has_single_points = false;                                   // single precision, from the origin of the model,
    bool has_single_region_points = false;                            // and of the file of one region
    bool has_point_arrays = false;
    bool needs_closed_regions = false;
    const char* companion = nullptr;          // extension of a second file
    const char* forbidden_in_name = nullptr;  // characters, where one of the two files names the other
};

std::span<const Format> all_formats();

/// The extension as the user sees it, in lower case: ".png", ".nii.gz".
std::string extension(const std::filesystem::path& path);

/// The row of the extension, upper or lower case; null if it is unknown.
const Format* find_format(const std::filesystem::path& path);

/// ".npy .nii .nii.gz": the extensions of all formats that have the function.
template <class Member>
std::string extensions_with(Member Format::*function) {
    std::string text;
    for (const Format& format : all_formats()) {
        for (const char* extension : format.extensions)
            if (extension && format.*function) text.append(text.empty() ? "" : " ").append(extension);
    }
    return text;
}

/// The row of the extension, else that whose content the file has; null if both are unknown.
const Format* find_format(const InputFile& file);

/// Throws Error(kInput) where the row's part is not built, or the format is known but not read.
void require_readable(const std::filesystem::path& path, const Format* format);

}  // namespace regionmesh::formats
