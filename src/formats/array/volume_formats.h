// One opener a format; open_sections chooses among them.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// NumPy arrays of format 1, 2 and 3: shape (z, y, x) or (y, x), C or Fortran order, bool or integers of either byte
/// order.
std::unique_ptr<SectionReader> open_npy(const std::filesystem::path& path, const ReadOptions& options);

/// NIfTI-1 and NIfTI-2 in one file, gzipped or not, whatever its name. The lattice repeats the affine of the sform,
/// else of the qform, else the voxel sizes alone, in the unit of the file. Gzipped files are inflated section by
/// section.
std::unique_ptr<SectionReader> open_nifti(const std::filesystem::path& path, const ReadOptions& options);

/// NRRD, attached or detached, raw, gzipped or as text. Coordinates are those of the header's own space. Segmentations
/// of 3D Slicer bring the names of their segments; of several layers one is read.
std::unique_ptr<SectionReader> open_nrrd(const std::filesystem::path& path, const ReadOptions& options);

/// MetaImage: .mha, and .mhd with its files of samples; raw, compressed or as text.
std::unique_ptr<SectionReader> open_meta_image(const std::filesystem::path& path, const ReadOptions& options);

/// VTK image data of one piece: the active scalars, else the only array of integers. Samples of cells lie at their
/// centres.
std::unique_ptr<SectionReader> open_vti(const std::filesystem::path& path, const ReadOptions& options);

/// INRIMAGE-4, gzipped or not.
std::unique_ptr<SectionReader> open_inr(const std::filesystem::path& path, const ReadOptions& options);

/// Bare little-endian samples, x fastest, as options.raw_size and options.raw_type say.
std::unique_ptr<SectionReader> open_raw(const std::filesystem::path& path, const ReadOptions& options);

/// A TIFF whose pages are sections, or an ImageJ stack with one page for all of them. Spacing is read where ImageJ
/// wrote one, with a unit.
std::unique_ptr<SectionReader> open_tiff(const std::filesystem::path& path, const ReadOptions& options);

/// An HDF5 file, and the path of a dataset or group inside, which may be empty: a DREAM.3D file's regions, else the
/// only dataset of integers that may be a volume. Chunks are read once, in a process of its own.
std::unique_ptr<SectionReader> open_hdf5(const std::filesystem::path& path, const std::string& inside,
                                         const ReadOptions& options);

/// A folder of a Zarr store, version 2 or 3: an array, an OME-Zarr image (its finest resolution), or a group with one
/// volume below it.
std::unique_ptr<SectionReader> open_zarr(const std::filesystem::path& folder, const ReadOptions& options);

/// A folder of an N5 store: an array, a group of resolutions s0, s1, ... (the finest), or one with one volume below it.
std::unique_ptr<SectionReader> open_n5(const std::filesystem::path& folder, const ReadOptions& options);

/// Whether a folder's own files say that it is an array of N5, a group of resolutions, or the root of a store.
bool is_n5(const std::filesystem::path& folder);

/// PNG and one-page TIFF files, a section each, in the order given.
std::unique_ptr<SectionReader> open_image_list(const std::vector<std::filesystem::path>& files,
                                               const ReadOptions& options);

/// The PNG or TIFF files of a directory in natural order. Other files are passed over, unless they are images that are
/// not read here: leaving those out would leave out sections.
std::unique_ptr<SectionReader> open_image_directory(const std::filesystem::path& directory, const ReadOptions& options);

}  // namespace regionmesh::formats
