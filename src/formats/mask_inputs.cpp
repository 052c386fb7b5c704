#include "formats/mask_inputs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "formats/array/array_file.h"
#include "formats/array/layered_sections.h"
#include "formats/array/soft_labels.h"
#include "formats/array/volume_formats.h"
#include "formats/input_file.h"
#include "formats/registry.h"
#include "formats/text/header_text.h"
#include "formats/text/natural_order.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMasks = 4096;  // as many files are open at once

SweepChoice choice_of(const Sweep& sweep) {
    constexpr std::array kChoices{SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};
    return kChoices[static_cast<std::size_t>(sweep.axes[2])];
}

/// The name of a file without the extension of its format.
std::string name_of(const fs::path& file) {
    const std::string name = file.filename().string();
    return one_line(name.substr(0, name.size() - extension(file).size()));
}

/// What is read of all files after the first.
ReadOptions along(const SectionReader& first, ReadOptions options) {
    options.sweep = choice_of(first.info().sweep);
    return options;
}

}  // namespace

bool is_volume_file(const fs::path& file) {
    const Format* format = find_format(file);
    return format && format->open_sections && !format->detect_file && !format->is_image && !format->is_folder &&
           !format->open_tetrahedra && format->open_sections != open_raw;
}

std::vector<fs::path> volumes_in(const fs::path& folder) {
    std::vector<fs::path> volumes;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        const fs::path& file = at->path();
        if (file.filename().string().starts_with('.') || !fs::is_regular_file(file, ignored)) continue;
        const Format* format = find_format(file);
        if (format && (format->is_image || format->detect_file)) return {};
        const bool is_samples_of_pair = extension(file).starts_with(".img");
        if (is_volume_file(file) && !is_samples_of_pair) volumes.push_back(file);
    }
    std::ranges::sort(volumes, [](const fs::path& a, const fs::path& b) {
        return natural_less(a.filename().string(), b.filename().string());
    });
    return volumes;
}

std::unique_ptr<SectionReader> open_masks(const std::vector<fs::path>& files, const fs::path& source,
                                          const ReadOptions& options, const OpenVolume& open) {
    if (files.size() > kMostMasks)
        fail(source, "has " + std::to_string(files.size()) + " masks, more than 4096; join some of them");
    VolumeInfo info;
    info.source = source.string();
    info.format = "masks";
    info.files = files;
    std::vector<Layer> layers;
    std::vector<InputLabel> labels;
    for (const fs::path& file : files) {
        const ReadOptions own = layers.empty() ? options : along(*layers.front().reader, options);
        layers.push_back({open(file, own), {}, static_cast<std::uint32_t>(layers.size())});
        labels.push_back(static_cast<InputLabel>(layers.size()));
        info.names[labels.back()] = name_of(file);
    }
    info.warning = layers.front().reader->info().warning;
    return join_layers(std::move(layers), std::move(info), std::move(labels), options.priority);
}

std::unique_ptr<SectionReader> open_argmax(const std::vector<fs::path>& files, const fs::path& source,
                                           const ReadOptions& options, const OpenVolume& open) {
    if (options.threshold.size() > 1)
        fail(source, "--argmax takes one --threshold, below which a sample is background; give one");
    if (files.size() > kMostMasks)
        fail(source, "has " + std::to_string(files.size()) + " files of shares, more than 4096; join some of them");
    VolumeInfo info;
    std::vector<std::unique_ptr<SectionReader>> readers;
    const bool is_list = files.size() > 1;
    ReadOptions own = options;
    if (!is_list) own.layer = options.layer.value_or(0);
    readers.push_back(open(files.front(), own));
    own = along(*readers.front(), own);
    const std::uint64_t count = is_list ? files.size() : readers.front()->info().layer_count;
    if (count < 2)
        fail(source, "--argmax compares several volumes of shares, and this is one; give --threshold V, or more files");
    if (count > kMostLayers) fail(source, "has more than 4096 volumes; save fewer in one file");
    if (!is_list && options.layer) fail(source, "--argmax compares all layers; leave out --layer");
    for (std::uint32_t n = 1; n < count; ++n) {
        if (!is_list) own.layer = n;
        readers.push_back(open(files[is_list ? n : 0], own));
    }
    if (is_list) {
        info.format = "shares";
        info.files = files;
        for (std::size_t n = 0; n < files.size(); ++n) info.names[static_cast<InputLabel>(n) + 1] = name_of(files[n]);
    } else {
        info = readers.front()->info();
    }
    info.source = source.string();
    info.warning = readers.front()->info().warning;
    constexpr double kHalf = 0.5, kNone = -std::numeric_limits<double>::infinity();
    const double least = !options.threshold.empty() ? options.threshold.front() : is_list ? kHalf : kNone;
    return argmax_sections(std::move(readers), std::move(info), least, is_list);
}

}  // namespace regionmesh::formats
