#include "regionmesh/io/read_sections.h"

#include "regionmesh/base/error.h"
#include "regionmesh/io/file_type.h"
#include "regionmesh/io/input_file.h"
#include "regionmesh/io/read_formats.h"
#include "regionmesh/io/zarr_array.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// "a.h5:/b" is the dataset /b of a.h5, unless a file has just that name.
std::unique_ptr<SectionReader> open_inside(const fs::path& path, const ReadOptions& options) {
    const std::string text = path.string();
    std::error_code ignored;
    if (fs::exists(path, ignored)) return nullptr;
    for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
        const fs::path file = text.substr(0, colon);
        if (io::file_type(file) != io::FileType::kHdf5 || !fs::is_regular_file(file, ignored)) continue;
        const std::string inside = text.substr(colon + 1);
        return io::open_hdf5(file, inside.starts_with('/') ? inside : "/" + inside, options);
    }
    return nullptr;
}

/// Groups of a store need no file of their own: then the name of the store must tell.
std::unique_ptr<SectionReader> open_store(const fs::path& folder, const ReadOptions& options) {
    std::error_code locked;
    if (fs::directory_iterator(folder, locked); locked) return nullptr;  // for the reader of directories to say
    if (io::is_zarr(folder)) return io::open_zarr(folder, options);
    if (io::is_n5(folder)) return io::open_n5(folder, options);
    for (const fs::path& part : fs::path(folder.lexically_normal())) {
        const std::string name = io::extension(part);
        if (name == ".zarr") return io::open_zarr(folder, options);
        if (name == ".n5") return io::open_n5(folder, options);
    }
    return nullptr;
}

std::unique_ptr<SectionReader> open_one(const fs::path& path, const ReadOptions& options) {
    std::error_code ignored;
    if (auto reader = open_inside(path, options)) return reader;
    const bool has_raw_option = options.raw_size || options.raw_type;
    if (fs::is_directory(path, ignored)) {
        if (has_raw_option)
            io::fail(path, "--size and --type are for one raw file, and this is a directory; leave them out");
        if (auto reader = open_store(path, options)) return reader;
        return io::open_image_directory(path, options);
    }
    const io::InputFile there(path);
    if (has_raw_option) return io::open_raw(path, options);
    switch (io::file_type(path)) {
        case io::FileType::kNpy:
            return io::open_npy(path, options);
        case io::FileType::kNifti:
            return io::open_nifti(path, options);
        case io::FileType::kRaw:
            return io::open_raw(path, options);
        case io::FileType::kTiff:
            return io::open_tiff(path, options);
        case io::FileType::kHdf5:
            return io::open_hdf5(path, "", options);
        case io::FileType::kPng:
            return io::open_image_list({path}, options);
        case io::FileType::kStore:
            io::fail(path, "stores in one file are not read; unpack it into a directory (unzip) and name that");
        case io::FileType::kNrrd:
            return io::open_nrrd(path, options);
        case io::FileType::kMetaImage:
            return io::open_meta_image(path, options);
        case io::FileType::kVti:
            return io::open_vti(path, options);
        case io::FileType::kInr:
            return io::open_inr(path, options);
        case io::FileType::kNiftiPair:
            io::fail(path, "NIfTI pairs (.hdr and .img) are not read; join them into one .nii file");
        case io::FileType::kOtherImage:
        case io::FileType::kOther:
            break;
    }
    io::fail(path, "unknown format '" + io::extension(path) + "'; regionmesh reads " + io::kFormatsRead);
}

}  // namespace

std::unique_ptr<SectionReader> open_sections(const std::vector<fs::path>& inputs, const ReadOptions& options) {
    if (inputs.empty())
        throw Error(ErrorCode::kInput, "no input: name a volume file, a directory or a list of sections");
    if (inputs.size() == 1) return open_one(inputs.front(), options);
    if (options.raw_size || options.raw_type) {
        io::fail(inputs.front(), "--size and --type are for one raw file, and " + std::to_string(inputs.size()) +
                                     " are given; give one");
    }
    return io::open_image_list(inputs, options);
}

}  // namespace regionmesh
