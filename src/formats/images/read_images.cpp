#include <algorithm>
#include <cassert>
#include <utility>

#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/file_type.h"
#include "formats/images/image_shape.h"
#include "formats/images/png_image.h"
#include "formats/images/tiff_file.h"
#include "formats/input_file.h"
#include "formats/text/natural_order.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

TiffFile open_single_page(const fs::path& path, std::uint64_t section) {
    TiffFile file(path, section);
    if (file.page_count() != 1) {
        fail_section(path, section,
                     "the file has " + std::to_string(file.page_count()) + " pages; give it alone, or split it");
    }
    return file;
}

ImageShape read_shape(const fs::path& path, std::uint64_t section) {
    const FileType type = file_type(path);
    if (type == FileType::kPng) return read_png_shape(path, section);
    if (type == FileType::kTiff) return open_single_page(path, section).read_shape(0, section);
    const InputFile there(path);
    fail_section(path, section, "is no PNG or TIFF section; give one volume, or sections alone");
}

/// One file a section; one file open at a time.
class ImageListReader final : public SectionReader {
public:
    ImageListReader(std::vector<fs::path> files, VolumeInfo info, const ImageShape& shape)
        : files_(std::move(files)), info_(std::move(info)), shape_(shape) {}

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        assert(section.size() == std::size_t{section_width()} * section_height());
        if (next_ == files_.size()) return false;
        const fs::path& path = files_[next_];
        if (file_type(path) == FileType::kPng) {
            read_png(path, next_, shape_, section);
        } else {
            open_single_page(path, next_).read_page(0, next_, shape_, section);
        }
        ++next_;
        return true;
    }

    void rewind() override { next_ = 0; }

private:
    std::vector<fs::path> files_;
    VolumeInfo info_;
    ImageShape shape_;
    std::size_t next_ = 0;
};

/// The headers of all sections are read here, so that a stray one is found before the work begins.
std::unique_ptr<SectionReader> open_files(std::vector<fs::path> files, const fs::path& source,
                                          const ReadOptions& options) {
    const ImageShape shape = read_shape(files.front(), 0);
    for (std::size_t section = 1; section < files.size(); ++section) {
        check_same_shape(files[section], section, read_shape(files[section], section), shape);
    }
    const char* format = file_type(files.front()) == FileType::kPng ? "png" : "tiff";
    VolumeInfo info =
        volume_info(source, format, label_type(shape), checked_size(source, {shape.width, shape.height, files.size()}));
    apply_options(info, options);
    return std::make_unique<ImageListReader>(std::move(files), std::move(info), shape);
}

std::vector<fs::path> list_directory(const fs::path& directory) {
    std::vector<fs::path> files;
    std::error_code error;
    fs::directory_iterator entry(directory, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        std::error_code ignored;
        if (!entry->path().filename().string().starts_with('.') && !entry->is_directory(ignored))
            files.push_back(entry->path());
    }
    if (error) fail(directory, "the directory cannot be read: " + error.message());
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return natural_less(a.filename().string(), b.filename().string());
    });
    return files;
}

}  // namespace

std::unique_ptr<SectionReader> open_image_list(const std::vector<fs::path>& files, const ReadOptions& options) {
    return open_files(files, files.front(), options);
}

std::unique_ptr<SectionReader> open_image_directory(const fs::path& directory, const ReadOptions& options) {
    std::vector<fs::path> images;
    for (const fs::path& file : list_directory(directory)) {
        const FileType type = file_type(file);
        if (type == FileType::kOtherImage) {
            fail(file,
                 "images of this format are not read; convert the sections to PNG or TIFF, or take it out of the "
                 "directory");
        }
        if (type != FileType::kPng && type != FileType::kTiff) continue;
        if (!images.empty() && file_type(images.front()) != type) {
            fail(directory, "holds both PNG and TIFF files; take out one kind, or name the sections in their order");
        }
        images.push_back(file);
    }
    if (images.empty()) fail(directory, "the directory holds no PNG or TIFF file; name the directory of the sections");
    return open_files(std::move(images), directory, options);
}

}  // namespace regionmesh::formats
