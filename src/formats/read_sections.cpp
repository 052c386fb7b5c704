#include "regionmesh/read_sections.h"

#include "formats/array/volume_formats.h"
#include "formats/chunked/zarr_array.h"
#include "formats/file_type.h"
#include "formats/input_file.h"
#include "regionmesh/error.h"

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
        if (formats::file_type(file) != formats::FileType::kHdf5 || !fs::is_regular_file(file, ignored)) continue;
        const std::string inside = text.substr(colon + 1);
        return formats::open_hdf5(file, inside.starts_with('/') ? inside : "/" + inside, options);
    }
    return nullptr;
}

/// Groups of a store need no file of their own: then the name of the store must tell.
std::unique_ptr<SectionReader> open_store(const fs::path& folder, const ReadOptions& options) {
    std::error_code locked;
    if (fs::directory_iterator(folder, locked); locked) return nullptr;  // for the reader of directories to say
    if (formats::is_zarr(folder)) return formats::open_zarr(folder, options);
    if (formats::is_n5(folder)) return formats::open_n5(folder, options);
    for (const fs::path& part : fs::path(folder.lexically_normal())) {
        const std::string name = formats::extension(part);
        if (name == ".zarr") return formats::open_zarr(folder, options);
        if (name == ".n5") return formats::open_n5(folder, options);
    }
    return nullptr;
}

std::unique_ptr<SectionReader> open_one(const fs::path& path, const ReadOptions& options) {
    std::error_code ignored;
    if (auto reader = open_inside(path, options)) return reader;
    const bool has_raw_option = options.raw_size || options.raw_type;
    if (fs::is_directory(path, ignored)) {
        if (has_raw_option)
            formats::fail(path, "--size and --type are for one raw file, and this is a directory; leave them out");
        if (auto reader = open_store(path, options)) return reader;
        return formats::open_image_directory(path, options);
    }
    const formats::InputFile there(path);
    if (has_raw_option) return formats::open_raw(path, options);
    switch (formats::file_type(path)) {
        case formats::FileType::kNpy:
            return formats::open_npy(path, options);
        case formats::FileType::kNifti:
            return formats::open_nifti(path, options);
        case formats::FileType::kRaw:
            return formats::open_raw(path, options);
        case formats::FileType::kTiff:
            return formats::open_tiff(path, options);
        case formats::FileType::kHdf5:
            return formats::open_hdf5(path, "", options);
        case formats::FileType::kPng:
            return formats::open_image_list({path}, options);
        case formats::FileType::kStore:
            formats::fail(path, "stores in one file are not read; unpack it into a directory (unzip) and name that");
        case formats::FileType::kNrrd:
            return formats::open_nrrd(path, options);
        case formats::FileType::kMetaImage:
            return formats::open_meta_image(path, options);
        case formats::FileType::kVti:
            return formats::open_vti(path, options);
        case formats::FileType::kInr:
            return formats::open_inr(path, options);
        case formats::FileType::kNiftiPair:
            formats::fail(path, "NIfTI pairs (.hdr and .img) are not read; join them into one .nii file");
        case formats::FileType::kOtherImage:
        case formats::FileType::kOther:
            break;
    }
    formats::fail(path, "unknown format '" + formats::extension(path) + "'; regionmesh reads " + formats::kFormatsRead);
}

}  // namespace

std::unique_ptr<SectionReader> open_sections(const std::vector<fs::path>& inputs, const ReadOptions& options) {
    if (inputs.empty())
        throw Error(ErrorCode::kInput, "no input: name a volume file, a directory or a list of sections");
    if (inputs.size() == 1) return open_one(inputs.front(), options);
    if (options.raw_size || options.raw_type) {
        formats::fail(inputs.front(), "--size and --type are for one raw file, and " + std::to_string(inputs.size()) +
                                          " are given; give one");
    }
    return formats::open_image_list(inputs, options);
}

}  // namespace regionmesh
