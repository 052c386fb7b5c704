#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/array/volume_formats.h"
#include "formats/chunked/dream3d_volume.h"
#include "formats/chunked/hdf5_volume.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

/// The attribute of vigra and ilastik: {"axes": [{"key": "z"}, ...]}, one for each axis of the array.
std::vector<std::string> axis_names(const Hdf5Entry& dataset) {
    const auto found = dataset.words.find("axistags");
    if (found == dataset.words.end()) return {};
    std::vector<std::string> names;
    try {
        const auto tags = nlohmann::json::parse(found->second);
        for (const auto& axis : tags.at("axes")) names.push_back(axis.at("key"));
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return names;
}

/// GrainMapper3D (LabDCT) writes the spacing along x, y, z in the parent of the group of its volumes.
void add_lab_dct_spacing(Hdf5Reader& file, Hdf5Volume& volume) {
    if (!volume.dataset.path.starts_with("/LabDCT/Data/")) return;
    const auto spacing = file.entry("/LabDCT/Spacing");
    if (!spacing || spacing->values.size() != 3) return;
    for (int axis = 0; axis < 3; ++axis) volume.placement.spacing[axis] = spacing->values[axis];
    volume.placement.warning.clear();
}

/// Datasets of integers, or else of reals, below a group that may be volumes.
std::vector<Hdf5Entry> find_candidates(Hdf5Reader& file, const std::string& below) {
    std::vector<Hdf5Entry> entries = file.entries();
    std::erase_if(entries, [&](const Hdf5Entry& entry) {
        return !format_of(entry) || !may_be_volume(entry.shape) || !entry.path.starts_with(below);
    });
    if (std::ranges::any_of(entries, [](const Hdf5Entry& entry) { return entry.sample_type.has_value(); }))
        std::erase_if(entries, [](const Hdf5Entry& entry) { return !entry.sample_type; });
    return entries;
}

Hdf5Entry only_candidate(Hdf5Reader& file, const std::string& source, const std::string& below) {
    std::vector<Hdf5Entry> candidates = find_candidates(file, below);
    if (candidates.size() == 1)
        return file.entry(candidates.front().path).value_or(candidates.front());  // with words of variable length
    if (candidates.empty())
        fail(source,
             "holds no dataset of numbers with 2 or 3 dimensions. One with more dimensions, "
             "whose axes have names, is read if you name it, as in " +
                 source + ":/path, with --layer N");
    fail(source, "holds several datasets; name one: " + list_datasets(file.path(), candidates));
}

Hdf5Entry choose_dataset(Hdf5Reader& file, const std::string& source, const std::string& inside) {
    if (inside.empty()) return only_candidate(file, source, "/");
    const auto entry = file.entry(inside);
    if (!entry) {
        const std::vector<Hdf5Entry> candidates = find_candidates(file, "/");
        fail(source, "the file holds no " + inside +
                         (candidates.empty() ? std::string("; check the path")
                                             : "; name one of " + list_datasets(file.path(), candidates)));
    }
    return entry->is_dataset ? *entry : only_candidate(file, source, inside.back() == '/' ? inside : inside + "/");
}

}  // namespace

std::unique_ptr<SectionReader> open_hdf5(const fs::path& named, const ReadOptions& options) {
    const auto [path, inside] = split_dataset(named);
    auto file = std::make_unique<Hdf5Reader>(path);
    const std::string source = inside.empty() ? path.string() : path.string() + ":" + inside;
    if (auto volume = find_dream3d_volume(*file, inside)) {
        return open_hdf5_volume(std::move(file), *volume, options);
    }
    Hdf5Volume volume{.dataset = choose_dataset(*file, source, inside)};
    volume.source = path.string() + ":" + volume.dataset.path;
    require_labels(volume.source, volume.dataset);
    volume.axis_names = axis_names(volume.dataset);
    const ArrayAxes axes = choose_axes(volume.source, volume.dataset.shape, volume.axis_names, options);
    volume.placement = common_placement(axes, volume.dataset.shape.size(), options, [&](const std::string& name) {
        const Hdf5Entry& dataset = volume.dataset;
        const auto found = dataset.numbers.find(name);
        if (found != dataset.numbers.end()) return std::optional(found->second);
        return dataset.words.contains(name) ? std::optional(std::vector<double>()) : std::nullopt;
    });
    add_lab_dct_spacing(*file, volume);
    return open_hdf5_volume(std::move(file), volume, options);
}

}  // namespace regionmesh::formats
