#include "formats/file_signature.h"

#include <array>
#include <string_view>
#include <system_error>

#include "formats/array/array_file.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::size_t offset;
    std::string_view bytes;
    const char* extension;
};

// HDF5 allows a block of the user before its own, as MATLAB has one of 512 bytes.
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n"sv;
constexpr std::size_t kHead = 2048 + kHdf5.size();
constexpr Signature kSignatures[] = {
    {0, kHdf5, ".h5"},
    {512, kHdf5, ".h5"},
    {1024, kHdf5, ".h5"},
    {2048, kHdf5, ".h5"},
    {0, "\x93NUMPY"sv, ".npy"},
    {0, "NRRD000"sv, ".nrrd"},
    {344, "n+1\0"sv, ".nii"},
    {4, "n+2\0"sv, ".nii"},
    {0, "#INRIMAGE"sv, ".inr"},
    {0, "# AmiraMesh"sv, ".am"},
    {0, "# Avizo"sv, ".am"},
    {0, "# vtk DataFile"sv, ".vtk"},
    {0, "ObjectType = Image"sv, ".mha"},
    {0, "***tesr"sv, ".tesr"},
    {0, "II*\0"sv, ".tif"},
    {0, "MM\0*"sv, ".tif"},
    {0, "II+\0"sv, ".tif"},
    {0, "MM\0+"sv, ".tif"},
};

bool may_be_gzipped(std::string_view extension) {
    return extension == ".nii" || extension == ".inr" || extension == ".mgh" || extension == ".mrc";
}

}  // namespace

const char* extension_by_content(const InputFile& file) {
    try {
        Encoding encoding = Encoding::kRaw;  // kDeflated where it is gzipped
        const std::vector<std::byte> bytes = read_header(file.path(), encoding, 0, kHead);
        const std::string_view head(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        for (const Signature& signature : kSignatures)
            if (head.size() >= signature.offset && head.substr(signature.offset).starts_with(signature.bytes))
                return encoding == Encoding::kDeflated && !may_be_gzipped(signature.extension) ? nullptr
                                                                                               : signature.extension;
    } catch (const Error&) {
        return nullptr;  // a damaged gzip file
    }
    return nullptr;
}

}  // namespace regionmesh::formats
