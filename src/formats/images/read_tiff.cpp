#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
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

/// The pages that are sections: `count` of them, from `first` on, each `step` pages after the one before.
struct PageOrder {
    std::uint32_t first = 0, step = 1;
    std::uint64_t count = 0;
};

/// A page a section. Of pages in tiles, boxes are read.
class TiffReader final : public CroppedSections {
public:
    TiffReader(TiffFile file, VolumeInfo info, const ImageShape& shape, const PageOrder& pages)
        : CroppedSections(std::move(info)), file_(std::move(file)), shape_(shape), pages_(pages) {
        file_.read_shape(0, 0);
        is_tiled_ = file_.is_tiled();
    }

private:
    bool can_crop() const override { return is_tiled_; }
    void plan_blocks() override {}
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        const std::uint32_t page = pages_.first + (box_.low[2] + number) * pages_.step;
        file_.read_page(page, page, {shape_, window_of(box_)}, section);
    }

    TiffFile file_;
    ImageShape shape_;
    PageOrder pages_;
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

/// Pages along one axis, the next pages of which lie `step` pages apart.
struct PageAxis {
    char name;  // 'Z', 'C', 'T', or '?'
    std::uint64_t size = 1, step = 1;
};

/// The pages of the sections, of one channel at one time. `axes` are those of all pages, the fastest first.
PageOrder choose_pages(const std::filesystem::path& path, const std::vector<PageAxis>& axes,
                       const ReadOptions& options) {
    PageOrder order{.count = 1};
    std::uint64_t first = 0;
    const auto extra = std::ranges::count_if(axes, [](const PageAxis& a) { return a.name != 'Z' && a.size > 1; });
    for (const PageAxis& axis : axes) {
        if (axis.name == 'Z') {
            order.count = axis.size;
            order.step = static_cast<std::uint32_t>(axis.step);
            continue;
        }
        if (axis.size == 1) continue;
        const char* const word = axis.name == 'C' ? "channel" : axis.name == 'T' ? "time" : "volume";
        if (extra > 1)
            fail(path, fmt::format("has {} {}s, and more along another axis; save one of them", axis.size, word));
        if (!options.layer)
            fail(path, fmt::format("has {} {}s; choose one with --layer 0 to {}", axis.size, word, axis.size - 1));
        if (*options.layer >= axis.size)
            fail(path, fmt::format("has {}s 0 to {}; there is no {}", word, axis.size - 1, *options.layer));
        first += *options.layer * axis.step;
    }
    order.first = static_cast<std::uint32_t>(first);
    return order;
}

/// An ImageJ hyperstack: channels run fastest, then slices, then frames. Frames without slices are read as sections.
std::vector<PageAxis> imagej_axes(const std::string& description, std::uint64_t pages) {
    const std::uint64_t channels = imagej_count(description, "channels"), slices = imagej_count(description, "slices"),
                        frames = imagej_count(description, "frames");
    const std::uint64_t all = channels * slices * frames;
    if (channels > pages || slices > pages || frames > pages || all != pages || (channels == 1 && slices == 1))
        return {{'Z', pages, 1}};
    return {{'C', channels, 1}, {'Z', slices, channels}, {'T', frames, channels * slices}};
}

/// What OME writes of the first image into the description of the first page.
struct OmeImage {
    std::vector<PageAxis> axes;  // of pages, the fastest first; empty where pages are sections
    Vec3 spacing{1, 1, 1};
    std::optional<double> metres = {};
};

/// The lengths of a pixel, in the unit of x, which is a micrometre where none is given.
void read_ome_spacing(const std::filesystem::path& path, const pugi::xml_node pixels, OmeImage& image) {
    std::array<double, 3> femtometres{1e9, 1e9, 1e9};
    for (int axis = 0; axis < 3; ++axis) {
        const std::string key = std::string("PhysicalSize") + "XYZ"[axis];
        const std::string_view text = pixels.attribute(key.c_str()).value();
        const std::string_view unit = pixels.attribute((key + "Unit").c_str()).value();
        const auto number = text.empty() ? std::optional(1.0) : parse_real(text);
        if (!number || !(*number > 0))
            fail(path, fmt::format("{} is '{}', no length; give --spacing X,Y,Z", key, shown(text)));
        image.spacing[axis] = *number;
        if (text.empty()) {  // not said: as x
            femtometres[axis] = femtometres[0];
            continue;
        }
        const auto known = unit.empty() ? std::optional(1e9) : femtometres_in(unit);
        if (known) femtometres[axis] = *known;
        const bool is_other = !known && unit != pixels.attribute("PhysicalSizeXUnit").value();
        if (is_other) fail(path, fmt::format("{} is in {}, no unit of length; give --spacing X,Y,Z", key, shown(unit)));
        if (axis == 0 && known) image.metres = *known / 1e15;
        if (known && axis > 0 && femtometres[axis] != femtometres[0])
            image.spacing[axis] *= femtometres[axis] / femtometres[0];
    }
}

/// Its pages go along z, channels and times. The XML may describe the pages of other files, too: then pages are
/// sections.
std::optional<OmeImage> read_ome(const std::filesystem::path& path, const std::string& description,
                                 const ImageShape& shape, std::uint64_t pages, const ReadOptions& options) {
    if (description.find("<OME") == std::string::npos) return {};
    pugi::xml_document document;
    if (!document.load_buffer(description.data(), description.size())) return {};
    const pugi::xml_node pixels =
        document.find_node([](const pugi::xml_node& node) { return std::string_view(node.name()) == "Pixels"; });
    if (!pixels) return {};
    OmeImage image;
    if (!options.spacing) read_ome_spacing(path, pixels, image);
    const auto size = [&](const char* name) {
        const auto number = parse_size(pixels.attribute(name).value());
        return std::max<std::uint64_t>(number.value_or(1), 1);
    };
    const std::uint64_t in_pixel = static_cast<std::uint64_t>(shape.channels);
    std::uint64_t step = 1;
    std::string_view order = pixels.attribute("DimensionOrder").value();
    if (order.size() != 5 || !order.starts_with("XY")) order = "XYZCT";
    for (const char name : order.substr(2)) {
        std::uint64_t count = size(name == 'Z' ? "SizeZ" : name == 'C' ? "SizeC" : "SizeT");
        if (name == 'C' && count % in_pixel == 0) count /= in_pixel;  // those of a pixel are in one page
        image.axes.push_back({name, count, step});
        if (count > pages / step) return image.axes.clear(), image;
        step *= count;
    }
    const auto of_z = std::ranges::find(image.axes, 'Z', &PageAxis::name);
    const bool is_in_time =
        std::ranges::all_of(image.axes, [](const PageAxis& a) { return a.name == 'T' || a.size == 1; });
    if (step != pages || (of_z->size == 1 && is_in_time)) image.axes.clear();
    return image;
}

/// tifffile writes the shape of an array as JSON into the description of the first page; its pages go along all axes
/// but those of a page.
std::vector<PageAxis> array_axes(const std::string& description, std::uint64_t pages) {
    if (!description.starts_with("{\"shape\":")) return {};
    const auto json = nlohmann::json::parse(description, nullptr, /*allow_exceptions=*/false);
    if (json.is_discarded() || !json["shape"].is_array()) return {};
    std::vector<std::uint64_t> sizes;
    std::uint64_t images = 1;
    for (const nlohmann::json& size : json["shape"]) {
        if (!size.is_number_unsigned()) return {};
        const auto count = size.get<std::uint64_t>();
        if (images >= pages || count < 2) continue;
        if (count > pages / images) return {};
        images *= count;
        sizes.push_back(count);
    }
    if (images != pages || sizes.size() < 2) return {};
    std::vector<PageAxis> axes;
    std::uint64_t step = 1;
    for (std::size_t n = sizes.size(); n-- > 0; step *= sizes[n])
        axes.push_back({n + 1 == sizes.size() ? 'Z' : '?', sizes[n], step});
    if (axes.size() == 3) axes[1].name = 'C', axes[2].name = 'T';  // the fastest is z, the next are channels and times
    return axes;
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
                       .sample = {.type = label_type(shape),
                                  .is_big_endian = tiff.is_big_endian(),
                                  .real = shape.is_real ? std::optional(shape.bits == 32 ? NumberType::kFloat32
                                                                                         : NumberType::kFloat64)
                                                        : std::nullopt},
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
    const int orientation = file.orientation();
    const std::string description = file.description();
    std::uint64_t images = file.page_count();
    const bool is_imagej = description.starts_with("ImageJ=");
    if (is_imagej && images == 1) images = imagej_count(description, "images");
    const auto ome = read_ome(path, description, shape, images, options);
    std::vector<PageAxis> axes = is_imagej ? imagej_axes(description, images)
                                 : ome     ? ome->axes
                                           : array_axes(description, images);
    if (axes.empty()) axes = {{'Z', images, 1}};
    const PageOrder order = choose_pages(path, axes, options);
    if (images > file.page_count() && order.count < images)
        fail(path, "an ImageJ hyperstack in one page, of several channels or frames; save one of them alone");
    Lattice lattice{.size = checked_size(path, {shape.width, shape.height, order.count})};
    std::optional<double> metres;
    if (is_imagej) {
        lattice.spacing = imagej_spacing(description, file);
        metres = imagej_metres(description);
    } else if (ome) {
        lattice.spacing = ome->spacing;
        metres = ome->metres;
    }
    const ReadOptions rest = axes.size() > 1 ? without_choice(options) : options;
    if (images > file.page_count()) return open_imagej_stack(path, file, shape, lattice, metres, rest);
    for (std::uint32_t page = 1; page < file.page_count(); ++page) {
        check_same_shape(path, page, file.read_shape(page, page), shape);
    }
    VolumeInfo info = volume_info(path, "tiff", label_type(shape), lattice.size);
    info.lattice = lattice;
    info.metres = metres;
    apply_options(info, rest);
    info.warning = warning_of_alpha(shape);
    if (orientation != 1)
        add_warning(info.warning,
                    fmt::format("its pages are turned or mirrored as its tag Orientation, {}, says", orientation));
    const bool is_in_time = axes.size() == 1 && is_imagej && imagej_count(description, "frames") > 1;
    if (is_in_time)
        add_warning(info.warning,
                    "its pages are frames, images of one section at several times; they are read as sections");
    return std::make_unique<TiffReader>(std::move(file), std::move(info), shape, order);
}

}  // namespace regionmesh::formats
