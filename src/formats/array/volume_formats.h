// The openers of volume formats, each in its own file; rows: registry.cpp; what they read: docs/reference/files.md.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/input_file.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Throws Error(kInput) that names the file, and the section if it is known.
using Opener = std::unique_ptr<SectionReader>(const std::filesystem::path& path, const ReadOptions& options);

Opener open_npy, open_nifti, open_nrrd, open_meta_image, open_vti, open_inr, open_mgh, open_mrc, open_legacy_vtk;
Opener open_amira, open_npz, open_tesr;
Opener open_contours;    // polygons in sections: a table with columns for them, or JSON
Opener open_vtu_voxels;  // cells that are the voxels of a regular grid; held whole, since cells come in any order
Opener open_raw;         // requires options.raw_size and options.raw_type
Opener open_tiff;        // pages are sections
Opener open_hdf5;        // a file, or "FILE:/PATH" of a dataset or group
Opener open_dicom;       // a segmentation
Opener open_zarr,
    open_n5;  // a folder: an array, an image at its finest resolution, or a group with one volume below it

/// Whether a folder is an array or group of Zarr, as far as its own files say.
bool is_zarr(const std::filesystem::path& folder);

/// Whether a folder's own files say that it is an array of N5, a group of resolutions, or the root of a store.
bool is_n5(const std::filesystem::path& folder);

/// Whether the cells of a VTK unstructured grid are the voxels of a regular grid, whole or cut into tetrahedra, with
/// one label each in the array that choose_label_array() takes: then it is a volume. False for another format, and for
/// a file that cannot be read.
bool holds_voxels(const std::filesystem::path& path);

/// Whether the file begins as DICOM files do: 128 bytes of any value, then "DICM".
bool is_dicom(const InputFile& file);

/// "a.h5:/b" is the dataset /b of a.h5, unless a file has just that name. `dataset` is empty if none is named.
struct DatasetPath {
    std::filesystem::path file;
    std::string dataset;
};
DatasetPath split_dataset(const std::filesystem::path& path);

/// One image as a volume of one section.
Opener open_image;

/// Image files, a section each, in the order given.
std::unique_ptr<SectionReader> open_image_list(const std::vector<std::filesystem::path>& files,
                                               const ReadOptions& options);

/// The images of a directory in natural order. Ignores other files, except for images that are not read: without them
/// sections would be missing.
std::unique_ptr<SectionReader> open_image_directory(const std::filesystem::path& directory, const ReadOptions& options);

}  // namespace regionmesh::formats
