#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/add_warning.h"
#include "formats/array/array_file.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/images/image_formats.h"
#include "formats/images/tiff_file.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "formats/text/length_unit.h"

namespace regionmesh::formats {
namespace {

/// A page a section. Of pages in tiles, boxes are read.
class TiffReader final : public CroppedSections {
public:
    TiffReader(TiffFile file, VolumeInfo info, const ImageShape& shape)
        : CroppedSections(std::move(info)), file_(std::move(file)), shape_(shape) {
        file_.read_shape(0, 0);
        is_tiled_ = file_.is_tiled();
    }

private:
    bool can_crop() const override { return is_tiled_; }
    void plan_blocks() override {}
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        const std::uint32_t page = box_.low[2] + number;
        file_.read_page(page, page, {shape_, window_of(box_)}, section);
    }

    TiffFile file_;
    ImageShape shape_;
    bool is_tiled_ = false;
};

TiffFile open_single_page(const std::filesystem::path& path, std::uint64_t section) {
    TiffFile file(path, section);
    if (file.page_count() != 1) {
        fail_section(path, section,
                     "the file has " + std::to_string(file.page_count()) + " pages; give it alone, or split it");
    }
    return file;
}

/// ImageJ's lines "key=value" in the description of the first page; `otherwise` where the key is missing.
template <class Value>
Value imagej_value(const std::string& description, std::string_view key, Value otherwise) {
    std::string start = "\n";
    start.append(key).append("=");
    const std::size_t at = description.find(start);
    if (at != std::string::npos) {
        std::from_chars(description.data() + at + start.size(), description.data() + description.size(), otherwise);
    }
    return otherwise;
}

std::uint64_t imagej_count(const std::string& description, std::string_view key) {
    return imagej_value<std::uint64_t>(description, key, 1);
}

/// The word behind unit=. ImageJ writes the micro sign as an escape.
std::optional<std::string_view> imagej_unit(std::string_view description) {
    constexpr std::string_view kStart = "\nunit=";
    const std::size_t at = description.find(kStart);
    if (at == std::string_view::npos) return {};
    const std::size_t begin = at + kStart.size();
    return trim(description.substr(begin, description.find('\n', begin) - begin));
}

/// The resolution tags have pixels per unit along x and y, the description has the distance of sections. Without a unit
/// the resolution is that of a screen, and not used.
Vec3 imagej_spacing(const std::string& description, const TiffFile& file) {
    const auto unit = imagej_unit(description);
    if (!unit || *unit == "pixel" || *unit == "pixels") return {1, 1, 1};
    const auto [x, y] = file.resolution();
    const double z = std::abs(imagej_value<double>(description, "spacing", 1));
    const auto or_one = [](double length) { return std::isfinite(length) && length > 0 ? length : 1; };
    return {or_one(1 / x), or_one(1 / y), or_one(z)};
}

std::optional<double> imagej_metres(const std::string& description) {
    const auto unit = imagej_unit(description);
    return unit ? metres_in(*unit) : std::nullopt;
}

void check_channels(const std::filesystem::path& path, const std::string& description) {
    const std::uint64_t channels = imagej_count(description, "channels");
    const std::uint64_t frames = imagej_count(description, "frames");
    if (channels > 1 || (frames > 1 && imagej_count(description, "slices") > 1)) {
        fail(path, "an ImageJ hyperstack of " + std::to_string(channels) + " channels and " + std::to_string(frames) +
                       " frames; save one channel of one frame alone");
    }
}

/// A size in the first Pixels of the XML that OME writes into the description of the first page; 1 where there is none.
std::uint64_t ome_size(const std::string& description, std::string_view axis) {
    const std::size_t at = description.find(axis), number = at + axis.size() + 2;  // behind ="
    std::uint64_t size = 1;
    if (at != std::string::npos && number < description.size())
        std::from_chars(description.data() + number, description.data() + description.size(), size);
    return size;
}

/// Its pages go along z, channels and times. The XML may describe the pages of other files, too.
void check_ome_axes(const std::filesystem::path& path, const std::string& description, const ImageShape& shape,
                    std::uint64_t pages) {
    if (description.find("<OME") == std::string::npos) return;
    const std::uint64_t sections = ome_size(description, "SizeZ"), times = ome_size(description, "SizeT");
    const std::uint64_t channels = ome_size(description, "SizeC") / shape.channels;  // those of a pixel are in one page
    if (pages > sections && (channels > 1 || (times > 1 && sections > 1)))
        fail(path, "an OME stack of " + std::to_string(channels) + " channels and " + std::to_string(times) +
                       " times; save one channel of one time alone");
}

/// tifffile writes the shape of an array as JSON into the description of the first page; its pages go along all axes
/// but those of a page.
void check_array_axes(const std::filesystem::path& path, const std::string& description, std::uint64_t pages) {
    if (!description.starts_with("{\"shape\":")) return;
    const auto json = nlohmann::json::parse(description, nullptr, /*allow_exceptions=*/false);
    if (json.is_discarded() || !json["shape"].is_array()) return;
    std::string sizes;
    std::uint64_t images = 1, axes = 0;
    for (const nlohmann::json& size : json["shape"]) {
        if (!size.is_number_unsigned()) return;
        sizes += (sizes.empty() ? "" : " x ") + size.dump();
        if (images < pages && size > 1u) {
            images *= size.get<std::uint64_t>();
            ++axes;
        }
    }
    if (images == pages && axes > 1)
        fail(path, "an array of " + sizes + ", whose pages go along " + std::to_string(axes) +
                       " axes; save one volume of it alone");
}

/// ImageJ writes stacks beyond 4 GiB, and others on request, as one page; the pixels of all images follow one another.
std::unique_ptr<SectionReader> open_imagej_stack(const std::filesystem::path& path, const TiffFile& tiff,
                                                 const ImageShape& shape, const Lattice& lattice,
                                                 std::optional<double> metres, const ReadOptions& options) {
    const auto offset = tiff.bare_offset();
    if (!offset || shape.channels != 1 || shape.bits < 8) {
        fail(path, "an ImageJ stack of " + std::to_string(lattice.size[2]) + " images in one page, of " +
                       describe(shape) + ", which is not read; save it uncompressed in 8 or 16 bit");
    }
    return open_array({.format = "tiff",
                       .source = path,
                       .files = {},
                       .sample = {label_type(shape), tiff.is_big_endian()},
                       .lattice = lattice,
                       .begin = *offset,
                       .metres = metres,
                       .can_sweep_all = false},
                      options);
}

}  // namespace

ImageShape read_tiff_shape(const std::filesystem::path& path, std::uint64_t section) {
    return open_single_page(path, section).read_shape(0, section);
}

void read_tiff_image(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                     std::span<InputLabel> labels) {
    open_single_page(path, section).read_page(0, section, TiffFile::all_of(expected), labels);
}

bool is_tiled_tiff(const std::filesystem::path& path, std::uint64_t section) {
    TiffFile file = open_single_page(path, section);
    file.read_shape(0, section);
    return file.is_tiled();
}

void read_tiff_window(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                      const ImageWindow& window, std::span<InputLabel> labels) {
    open_single_page(path, section).read_page(0, section, {expected, window}, labels);
}

std::unique_ptr<SectionReader> open_tiff(const std::filesystem::path& path, const ReadOptions& options) {
    TiffFile file(path);
    const ImageShape shape = file.read_shape(0, 0);
    const std::string description = file.description();
    std::uint64_t images = file.page_count();
    const bool is_imagej = description.starts_with("ImageJ=");
    if (is_imagej) {
        check_channels(path, description);
        if (images == 1) images = imagej_count(description, "images");
    }
    check_ome_axes(path, description, shape, images);
    check_array_axes(path, description, images);
    Lattice lattice{.size = checked_size(path, {shape.width, shape.height, images})};
    if (is_imagej) lattice.spacing = imagej_spacing(description, file);
    const std::optional<double> metres = is_imagej ? imagej_metres(description) : std::nullopt;
    if (images > file.page_count()) return open_imagej_stack(path, file, shape, lattice, metres, options);
    for (std::uint32_t page = 1; page < file.page_count(); ++page) {
        check_same_shape(path, page, file.read_shape(page, page), shape);
    }
    VolumeInfo info = volume_info(path, "tiff", label_type(shape), lattice.size);
    info.lattice = lattice;
    info.metres = metres;
    apply_options(info, options);
    info.warning = warning_of_alpha(shape);
    if (is_imagej && imagej_count(description, "frames") > 1)
        add_warning(info.warning,
                    "its pages are frames, images of one section at several times; they are read as sections");
    return std::make_unique<TiffReader>(std::move(file), std::move(info), shape);
}

}  // namespace regionmesh::formats
