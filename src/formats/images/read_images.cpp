#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/add_warning.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/images/image_shape.h"
#include "formats/input_file.h"
#include "formats/registry.h"
#include "formats/text/header_text.h"
#include "formats/text/natural_order.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

/// Files of DICOM images hold samples in grey; a segmentation is one file.
[[noreturn]] void refuse_dicom(const fs::path& path) {
    fail(path,
         "is a DICOM file, which is no section of labels; segment the series of images, in 3D Slicer for example, and "
         "name the file of the segmentation alone");
}

/// The row of a section's format. Throws where it is no image that is read.
const Format& image_format(const fs::path& path, std::uint64_t section) {
    const Format* format = find_format(path);
    if (format && format->read_image) return *format;
    const InputFile there(path);
    if (is_dicom(there)) refuse_dicom(path);
    if (format && format->is_image) require_readable(path, format);
    fail_section(path, section, "is no PNG or TIFF section; give one volume, or sections alone");
}

/// One file a section; one file open at a time. Boxes are read if all files are of one format and the first is tiled.
class ImageListReader final : public CroppedSections {
public:
    ImageListReader(std::vector<fs::path> files, VolumeInfo info, const ImageShape& shape)
        : CroppedSections(std::move(info)), files_(std::move(files)), shape_(shape) {
        const Format* const format = find_format(files_.front());
        is_tiled_ = format->is_tiled && format->is_tiled(files_.front(), 0) &&
                    std::ranges::all_of(files_, [&](const fs::path& file) { return find_format(file) == format; });
    }

private:
    bool can_crop() const override { return is_tiled_; }
    void plan_blocks() override {}
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        const std::uint32_t n = box_.low[2] + number;
        const Format& format = image_format(files_[n], n);
        if (is_tiled_)
            format.read_window(files_[n], n, shape_, window_of(box_), section);
        else
            format.read_image(files_[n], n, shape_, section);
    }

    std::vector<fs::path> files_;
    ImageShape shape_;
    bool is_tiled_ = false;
};

/// The headers of all sections are read here, so that a different one is found before the work begins.
std::unique_ptr<SectionReader> open_files(std::vector<fs::path> files, const fs::path& source,
                                          const ReadOptions& options, const std::string& warning = "") {
    const auto shape_of = [&](std::uint64_t section) {
        return image_format(files[section], section).read_shape(files[section], section);
    };
    const ImageShape shape = shape_of(0);
    for (std::size_t section = 1; section < files.size(); ++section)
        check_same_shape(files[section], section, shape_of(section), shape);
    VolumeInfo info = volume_info(source, lower(image_format(files.front(), 0).name), label_type(shape),
                                  checked_size(source, {shape.width, shape.height, files.size()}));
    apply_options(info, options);
    info.warning = warning;
    add_warning(info.warning, warning_of_alpha(shape));
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

/// A file name in three parts: the last number is in the middle.
struct NumberedName {
    std::string before, after;
    std::int64_t number = 0;
};

std::optional<NumberedName> numbered_name(const fs::path& file) {
    constexpr std::string_view kDigits = "0123456789";
    constexpr std::size_t kMostDigits = 18;  // of 64 bits
    const std::string name = file.stem().string();
    const std::size_t last = name.find_last_of(kDigits);
    if (last == std::string::npos) return {};
    const std::size_t before = name.find_last_not_of(kDigits, last),
                      first = before == std::string::npos ? 0 : before + 1;
    if (last - first >= kMostDigits) return {};
    return NumberedName{name.substr(0, first), name.substr(last + 1), std::stoll(name.substr(first, last + 1 - first))};
}

/// What the numbers of sections say where nearly all of them rise by the same step: a line that names the first place
/// where they do not, since a section may be missing there. Empty where there is none.
std::string warning_of_gaps(const std::vector<fs::path>& files) {
    constexpr std::size_t kFewest = 5, kMostOfSteps = 4;  // at most one step in four is another
    if (files.size() < kFewest) return {};
    std::vector<std::int64_t> steps;
    std::optional<NumberedName> last;
    for (const fs::path& file : files) {
        std::optional<NumberedName> name = numbered_name(file);
        if (!name || (last && (name->before != last->before || name->after != last->after))) return {};
        if (last) steps.push_back(name->number - last->number);
        last = std::move(name);
    }
    std::vector<std::int64_t> sorted = steps;
    std::ranges::sort(sorted);
    const std::int64_t usual = sorted[sorted.size() / 2];
    const auto others = steps.size() - static_cast<std::size_t>(std::ranges::count(steps, usual));
    if (others == 0 || others * kMostOfSteps > steps.size()) return {};
    const auto at = std::ranges::find_if(steps, [&](std::int64_t step) { return step != usual; }) - steps.begin();
    return fmt::format(
        "{} is followed by {}, and other numbers rise by {}: if a section is missing, put one in, since "
        "sections are read as equally far apart",
        files[at].filename().string(), files[at + 1].filename().string(), usual);
}

/// DICOM files often have no extension.
void refuse_dicom_among(const std::vector<fs::path>& files) {
    std::error_code ignored;
    for (const fs::path& file : files)
        if (fs::is_regular_file(file, ignored) && is_dicom(InputFile(file))) refuse_dicom(file);
}

}  // namespace

std::unique_ptr<SectionReader> open_image(const fs::path& path, const ReadOptions& options) {
    return open_files({path}, path, options);
}

std::unique_ptr<SectionReader> open_image_list(const std::vector<fs::path>& files, const ReadOptions& options) {
    return open_files(files, files.front(), options);
}

std::unique_ptr<SectionReader> open_image_directory(const fs::path& directory, const ReadOptions& options) {
    std::vector<fs::path> images;
    const Format* kind = nullptr;
    const std::vector<fs::path> files = list_directory(directory);
    for (const fs::path& file : files) {
        const Format* format = find_format(file);
        if (format && format->detect_file) refuse_dicom(file);
        if (!format || !format->is_image) continue;
        require_readable(file, format);
        if (!format->read_image) {
            fail(file,
                 "images of this format are not read; convert the sections to PNG or TIFF, or take it out of the "
                 "directory");
        }
        if (kind && kind != format)
            fail(directory, "holds both PNG and TIFF files; take out one kind, or name the sections in their order");
        kind = format;
        images.push_back(file);
    }
    if (images.empty()) refuse_dicom_among(files);
    if (images.empty()) fail(directory, "the directory holds no PNG or TIFF file; name the directory of the sections");
    const std::string warning = warning_of_gaps(images);
    return open_files(std::move(images), directory, options, warning);
}

}  // namespace regionmesh::formats
