// What the extension of a file's name says.
#pragma once

#include <filesystem>
#include <string>

namespace regionmesh::formats {

enum class FileType {
    kNpy,
    kNifti,
    kRaw,
    kPng,
    kTiff,
    kNrrd,
    kMetaImage,
    kVti,
    kInr,
    kHdf5,
    kStore,       // .zarr or .n5 as one file, as .zip most often
    kNiftiPair,   // .hdr, .img
    kOtherImage,  // sections all the same, in a format that is not read: .pgm, .jpg and the like
    kOther,
};

/// By extension, upper or lower case.
FileType file_type(const std::filesystem::path& path);

/// The extension as the user sees it, in lower case: ".png", ".nii.gz".
std::string extension(const std::filesystem::path& path);

inline constexpr const char* kFormatsRead =
    ".npy .nii .nii.gz .nrrd .nhdr .mha .mhd .vti .inr .inr.gz .tif .tiff .png .raw .h5 .hdf5 .dream3d .zarr .n5 and "
    "directories of .png or .tif sections";

}  // namespace regionmesh::formats
