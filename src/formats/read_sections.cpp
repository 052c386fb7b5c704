#include "regionmesh/read_sections.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/array/read_pipe.h"
#include "formats/array/soft_labels.h"
#include "formats/array/volume_formats.h"
#include "formats/contours/contours.h"
#include "formats/input_file.h"
#include "formats/mask_inputs.h"
#include "formats/registry.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/read_tetrahedra.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using formats::Format;

/// The format of a folder: what its files say, else what the name of the folder or of one above it says. Groups of a
/// store need no file of their own.
const Format* format_of_folder(const fs::path& folder) {
    std::error_code locked;
    if (fs::directory_iterator(folder, locked); locked) return nullptr;  // the reader of directories reports it
    for (const Format& format : formats::all_formats())
        if (format.detect && format.detect(folder)) return &format;
    for (const fs::path& part : fs::path(folder.lexically_normal()))
        if (const Format* format = formats::find_format(part); format && format->is_folder) return format;
    return nullptr;
}

std::unique_ptr<SectionReader> open_one(const fs::path& path, const ReadOptions& options);

std::unique_ptr<SectionReader> open_folder(const fs::path& folder, const ReadOptions& options) {
    const Format* format = format_of_folder(folder);
    if (!format) {
        const std::vector<fs::path> volumes = formats::volumes_in(folder);
        if (volumes.size() == 1) return open_one(volumes.front(), options);
        return formats::open_image_directory(folder, options);
    }
    if (!format->open_sections) formats::require_readable(folder, format);
    return format->open_sections(folder, options);
}

std::unique_ptr<SectionReader> open_one(const fs::path& path, const ReadOptions& options) {
    std::error_code ignored;
    const bool has_raw_option = options.raw_size || options.raw_type;
    if (fs::is_directory(path, ignored)) {
        if (has_raw_option)
            formats::fail(path, "--size and --type are for one raw file, and this is a directory; leave them out");
        return open_folder(path, options);
    }
    const fs::path file = formats::split_dataset(path).file;
    const formats::InputFile there(file);
    const Format* format = formats::find_format(there);
    if (has_raw_option && file == path) {
        const bool has_header = format && format->open_sections != formats::open_raw;
        if (has_header && !(options.raw_size && options.raw_type))
            formats::fail(path, "--size and --type are for raw files: leave them out, or give both to read it as raw");
        return formats::open_raw(path, options);
    }
    if (formats::holds_contours(path)) return formats::open_contours(path, options);
    formats::require_readable(path, format);
    if (format && format->open_sections) return format->open_sections(path, options);
    formats::fail(
        path, "unknown format '" + formats::extension(path) + "'; volumes are read from " + volume_extensions() +
                  " and directories of .png or .tif sections, points and tetrahedra from " + tetrahedron_extensions());
}

}  // namespace

formats::DatasetPath formats::split_dataset(const fs::path& path) {
    const std::string text = path.string();
    std::error_code ignored;
    if (fs::exists(path, ignored)) return {path, {}};
    for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
        const fs::path file = text.substr(0, colon);
        if (!fs::is_regular_file(file, ignored)) continue;
        const Format* format = find_format(InputFile(file));
        if (!format || !format->has_datasets) continue;
        const std::string inside = text.substr(colon + 1);
        return {file, inside.starts_with('/') ? inside : "/" + inside};
    }
    return {path, {}};
}

namespace {

void require_work(const SectionReader& reader, std::uint64_t most) {
    const double section = double(reader.section_width()) * reader.section_height();
    const double work = reader.section_count() * (section + kSectionWork);
    if (work <= static_cast<double>(most)) return;
    formats::fail(reader.info().source,
                  fmt::format("{} sections of {} x {} samples are work of {:.0f}, more than --max-work {}; crop the "
                              "volume, read it along another axis, or raise --max-work",
                              reader.section_count(), reader.section_width(), reader.section_height(), work, most));
}

/// With the labels that options.threshold makes.
std::unique_ptr<SectionReader> with_thresholds(std::unique_ptr<SectionReader> reader, const ReadOptions& options) {
    if (options.argmax)
        formats::fail(reader->info().source, "--argmax compares volumes in one file, or several files; leave it out");
    if (options.threshold.empty()) return reader;
    return formats::threshold_sections(std::move(reader), options.threshold);
}

/// Of one file or folder.
std::unique_ptr<SectionReader> open_labels(const fs::path& path, const ReadOptions& options) {
    if (options.argmax) return formats::open_argmax({path}, path, options, open_one);
    return with_thresholds(open_one(path, options), options);
}

std::unique_ptr<SectionReader> open_several(const std::vector<fs::path>& files, const fs::path& source,
                                            const ReadOptions& options) {
    return options.argmax ? formats::open_argmax(files, source, options, open_one)
                          : formats::open_masks(files, source, options, open_labels);
}

/// The files of a folder of several volumes; none for anything else.
std::vector<fs::path> masks_in(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored) || format_of_folder(path)) return {};
    std::vector<fs::path> files = formats::volumes_in(path);
    if (files.size() < 2) files.clear();
    return files;
}

std::unique_ptr<SectionReader> open_inputs(const std::vector<fs::path>& inputs, const ReadOptions& options) {
    if (inputs.size() == 1 && inputs.front() == "-") return with_thresholds(formats::open_pipe(options), options);
    if (inputs.size() == 1) {
        const std::vector<fs::path> masks = masks_in(inputs.front());
        return masks.empty() ? open_labels(inputs.front(), options) : open_several(masks, inputs.front(), options);
    }
    if (std::ranges::find(inputs, fs::path("-")) != inputs.end())
        throw Error(ErrorCode::kUsage, "standard input: is one of several inputs; give it alone, or name files");
    if (options.raw_size || options.raw_type) {
        formats::fail(inputs.front(), "--size and --type are for one raw file, and " + std::to_string(inputs.size()) +
                                          " are given; give one");
    }
    if (std::ranges::all_of(inputs, formats::is_volume_file)) return open_several(inputs, inputs.front(), options);
    return with_thresholds(formats::open_image_list(inputs, options), options);
}

}  // namespace

std::string volume_extensions() { return formats::extensions_with(&Format::open_sections); }

std::unique_ptr<SectionReader> open_sections(const std::vector<fs::path>& inputs, const ReadOptions& options) {
    if (inputs.empty())
        throw Error(ErrorCode::kInput, "no input: name a volume file, a directory or a list of sections");
    Selection selection = options.select;
    if (!options.merge_table.empty()) read_merge_table(options.merge_table, selection);
    auto reader = open_inputs(inputs, options);
    require_lattice(reader->info().source, reader->info().lattice);
    require_work(*reader, options.max_work);
    if (!options.priority.empty() && !reader->info().overlaps)
        formats::fail(reader->info().source,
                      "--priority is for masks or segments that may overlap, and each of its samples has one label; "
                      "leave it out");
    return select_sections(turn_sections(std::move(reader), options.space), selection);
}

}  // namespace regionmesh
