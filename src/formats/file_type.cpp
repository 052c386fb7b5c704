#include "formats/file_type.h"

#include <algorithm>
#include <array>
#include <utility>

namespace regionmesh::formats {
namespace {

constexpr std::array<std::pair<const char*, FileType>, 43> kTypes{{
    {".npy", FileType::kNpy},          {".nii", FileType::kNifti},        {".nii.gz", FileType::kNifti},
    {".raw", FileType::kRaw},          {".png", FileType::kPng},          {".tif", FileType::kTiff},
    {".tiff", FileType::kTiff},        {".hdr", FileType::kNiftiPair},    {".img", FileType::kNiftiPair},
    {".hdr.gz", FileType::kNiftiPair}, {".img.gz", FileType::kNiftiPair}, {".bmp", FileType::kOtherImage},
    {".gif", FileType::kOtherImage},   {".jpg", FileType::kOtherImage},   {".jpeg", FileType::kOtherImage},
    {".jp2", FileType::kOtherImage},   {".pbm", FileType::kOtherImage},   {".pgm", FileType::kOtherImage},
    {".pnm", FileType::kOtherImage},   {".ppm", FileType::kOtherImage},   {".tga", FileType::kOtherImage},
    {".webp", FileType::kOtherImage},  {".dcm", FileType::kOtherImage},   {".exr", FileType::kOtherImage},
    {".h5", FileType::kHdf5},          {".hdf5", FileType::kHdf5},        {".hdf", FileType::kHdf5},
    {".he5", FileType::kHdf5},         {".nxs", FileType::kHdf5},         {".dream3d", FileType::kHdf5},
    {".zarr", FileType::kStore},       {".n5", FileType::kStore},         {".zip", FileType::kStore},
    {".pcx", FileType::kOtherImage},   {".pam", FileType::kOtherImage},   {".avif", FileType::kOtherImage},
    {".nrrd", FileType::kNrrd},        {".nhdr", FileType::kNrrd},        {".mha", FileType::kMetaImage},
    {".mhd", FileType::kMetaImage},    {".vti", FileType::kVti},          {".inr", FileType::kInr},
    {".inr.gz", FileType::kInr},
}};

}  // namespace

std::string extension(const std::filesystem::path& path) {
    std::string text = path.extension().string();
    if (text == ".gz" || text == ".GZ") text = path.stem().extension().string() + text;
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

FileType file_type(const std::filesystem::path& path) {
    const std::string wanted = extension(path);
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return wanted == entry.first; });
    return found == kTypes.end() ? FileType::kOther : found->second;
}

}  // namespace regionmesh::formats
