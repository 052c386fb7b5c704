#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "formats/array/volume_formats.h"
#include "formats/contours/contours.h"
#include "regionmesh/error.h"
#include "regionmesh/options.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

const char* kind_text(InputKind kind) {
    return kind == kVolumeInput ? "a volume of samples" : kind == kTableInput ? "a table of points" : "a mesh";
}

/// "--reduce 90%", or "--quiet" of a flag.
std::string typed(const OptionSpec& option, const std::string& text) {
    return option.flag() + (option.kind == OptionKind::kFlag ? "" : ' ' + text);
}

[[noreturn]] void refuse_both(std::string_view a, std::string_view b, std::string_view why) {
    throw Error(ErrorCode::kUsage, fmt::format("--{} and --{}: {}; give one of them", a, b, why));
}

/// Options that cannot both be followed.
struct Contradiction {
    std::string_view a, b, why;
};
constexpr std::string_view kNoDecimation = "nothing is decimated, so there is no target to reach";
constexpr Contradiction kContradictions[] = {
    {"reduce", "target-faces", "both say how many faces are left"},
    {"no-decimate", "reduce", kNoDecimation},
    {"no-decimate", "target-faces", kNoDecimation},
    {"no-decimate", "max-error", kNoDecimation},
    {"no-background", "background", "either there is a background or there is none"},
    {"no-sandbox", "require-sandbox", "one gives up what the other insists on"},
    {"quiet", "verbose", "one prints less, the other more"},
};

void require_consistent_smoothing(const Settings& settings) {
    const std::string* const filter = given_text(settings, "smooth-filter");
    const std::string* const much = given_text(settings, "smooth");
    const bool is_off = much && (*much == "off" || *much == "0"), has_no_filter = filter && *filter == "none";
    if (has_no_filter && much && !is_off)
        refuse_both("smooth-filter none", "smooth " + *much, "one smooths, the other does not");
    if (!is_off && !has_no_filter) return;
    const std::string off = is_off ? "smooth " + *much : "smooth-filter none";
    if (is_off && filter && !has_no_filter && *filter != "auto")
        refuse_both(off, "smooth-filter " + *filter, "one smooths, the other does not");
    for (const char* name : {"smooth-lambda", "smooth-points"})
        if (given_text(settings, name)) refuse_both(off, name, "nothing is smoothed");
}

/// Options of a table that need layers, and one that they do not take.
void require_layers(const Settings& settings, InputKind kind) {
    if (kind != kTableInput) return;
    if (given_text(settings, "surveys") && !given_text(settings, "collars"))
        throw Error(ErrorCode::kUsage, "--surveys: directions of holes need their places; give --collars, too");
    if (!settings.layers.empty()) {
        if (given_text(settings, "step")) refuse_both("layers", "step", "layers take the whole intervals");
        return;
    }
    for (const char* name : {"spacing", "box", "terrain", "max-work", "cells", "room", "no-keep-samples"})
        if (const std::string* text = given_text(settings, name))
            throw Error(ErrorCode::kUsage, fmt::format("{}: applies to drill holes as layers; give --layers auto, too",
                                                       typed(*find_option(name), *text)));
}

}  // namespace

LayerOptions layer_options(const Settings& settings) {
    return {.units = settings.layers,
            .spacing = settings.volume.spacing,
            .box = settings.volume.select.box,
            .terrain = settings.terrain,
            .sweep = settings.volume.sweep,
            .memory = settings.reconstruct.memory,
            .max_work = settings.volume.max_work,
            .threads = settings.reconstruct.threads};
}

namespace {

/// The inputs as open_sections() takes them: --array NAME of a file is its dataset "FILE:/NAME".
std::vector<std::filesystem::path> named_arrays(const Settings& settings, const std::vector<std::string>& inputs) {
    const std::string& array = settings.tetrahedra.array;
    if (array.empty()) return {inputs.begin(), inputs.end()};
    if (inputs.size() > 1 || inputs.front() == "-")
        throw Error(ErrorCode::kUsage, "--array " + array + ": chooses one of the arrays of one file; name one file");
    const formats::DatasetPath path = formats::split_dataset(inputs.front());
    std::error_code ignored;
    if (path.dataset.empty() && !std::filesystem::exists(path.file, ignored))
        return {path.file};  // refused by its name
    const std::string named = path.file.string() + ":/" + array;
    if (!path.dataset.empty() || formats::split_dataset(named).dataset.empty())
        throw Error(ErrorCode::kUsage,
                    fmt::format("--array {}: {} has no arrays to choose from; leave it out", array, inputs.front()));
    return {named};
}

}  // namespace

bool is_lattice(const Settings& settings, const std::vector<std::string>& inputs) {
    const InputKind kind = kind_of_input(inputs);
    return kind == kVolumeInput || (kind == kTableInput && !settings.layers.empty());
}

std::unique_ptr<SectionReader> open_lattice(const Settings& settings, const std::vector<std::string>& inputs) {
    if (kind_of_input(inputs) != kVolumeInput)
        return open_layers(inputs.front(), settings.tetrahedra, layer_options(settings));
    auto sections = open_sections(named_arrays(settings, inputs), settings.volume);
    const bool is_in_blocks = settings.block_cells || settings.output.ends_with('/');
    return is_in_blocks ? std::move(sections) : as_plate(std::move(sections));
}

PreparedSections open_prepared(const Settings& settings, const std::vector<std::string>& inputs) {
    if (kind_of_input(inputs) != kVolumeInput) return {.reader = open_lattice(settings, inputs)};
    PrepareOptions options = settings.prepare;
    options.threads = settings.reconstruct.threads;
    options.memory = settings.reconstruct.memory;
    const auto open = [&](SweepChoice sweep) {
        ReadOptions volume = settings.volume;
        volume.sweep = sweep;
        return open_sections(named_arrays(settings, inputs), volume);
    };
    PreparedSections made = prepare_sections(open, settings.volume.sweep, options);
    made.reader = as_plate(std::move(made.reader));
    return made;
}

InputKind kind_of_input(const std::vector<std::string>& inputs) {
    const auto found = std::ranges::find_if(inputs, [](const auto& input) { return holds_tetrahedra(input); });
    if (found == inputs.end()) return kVolumeInput;
    if (inputs.size() == 1 && (formats::holds_voxels(*found) || formats::holds_contours(*found))) return kVolumeInput;
    return is_mesh(*found) ? kMeshInput : kTableInput;
}

void require_fit(const Settings& settings, const std::vector<std::string>& inputs) {
    if (inputs.empty()) return;
    const InputKind kind = kind_of_input(inputs);
    if (kind != kVolumeInput && inputs.size() > 1)
        throw Error(ErrorCode::kUsage, inputs[1] + ": one table or mesh at a time; give one");
    require_layers(settings, kind);
    for (const auto& [name, text] : settings.given) {
        const OptionSpec& option = *find_option(name);
        if ((option.inputs & kind) != 0) continue;
        throw Error(ErrorCode::kUsage, fmt::format("{}: does not apply to {}, which is {}", typed(option, text),
                                                   inputs[0], kind_text(kind)));
    }
}

void require_no_input_options(const Settings& settings) {
    for (const auto& [name, text] : settings.given)
        if (const OptionSpec& option = *find_option(name); option.inputs != kAnyInput)
            throw Error(ErrorCode::kUsage, fmt::format("{}: says how sections are read, and there are none; give "
                                                       "--sections, too",
                                                       typed(option, text)));
}

void require_consistent(const Settings& settings) {
    for (const Contradiction& pair : kContradictions)
        if (given_text(settings, pair.a) && given_text(settings, pair.b)) refuse_both(pair.a, pair.b, pair.why);
    if (given_text(settings, "face-budget") && given_text(settings, "memory") && !settings.memory_is_hard)
        refuse_both("face-budget", "memory", "each says how many faces are held, unless --memory-limit is hard");
    require_consistent_smoothing(settings);
    if (!settings.volume.select.labels.empty() && settings.reconstruct.background.empty())
        throw Error(ErrorCode::kUsage,
                    "--labels: the other labels become background, and --no-background has none; leave out one");
    if (settings.precomputed_is_legacy)
        for (const char* name : {"sharded", "levels"})
            if (given_text(settings, name)) refuse_both("precomputed legacy", name, "legacy meshes have neither");
    if (settings.reconstruct.cap) return;
    if (settings.hull)
        throw Error(ErrorCode::kUsage,
                    "--hull and --boundary open: one closes the regions that the other leaves open; give one of them");
    if (settings.reconstruct.preserve_volume)
        throw Error(ErrorCode::kUsage, "--preserve-volume: open regions have no volume; leave out --boundary open");
}

}  // namespace regionmesh
