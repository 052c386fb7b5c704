// Models in pieces for Neuroglancer.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "blocks/precomputed/precomputed.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/write_report.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// Regions that a state selects: each is one request and more.
constexpr std::size_t kMostSelected = 100;

/// Those with the most faces, in the order of their labels.
std::vector<Label> largest_regions(const WrittenRegions& regions) {
    std::vector<Label> labels;
    for (const auto& [label, faces] : regions.faces) labels.push_back(label);
    std::ranges::stable_sort(labels, std::greater(), [&](Label label) { return regions.faces.at(label); });
    labels.resize(std::min(labels.size(), kMostSelected));
    std::ranges::sort(labels);
    return labels;
}

}  // namespace

bool Precomputed::is_region(Label label) const {
    return !is_exterior(label) && std::ranges::find(options.background, label) == options.background.end();
}

std::string Precomputed::id(Label label) const {
    const InputLabel input = labels.input(label);
    if (!labels.is_unsigned() && input < 0)
        throw Error(ErrorCode::kInput,
                    fmt::format("{}: label {} is negative, and ids in Neuroglancer are not; give the region another "
                                "label, as reconstruct does with --merge",
                                options.source, input));
    return labels.text(input);
}

void Precomputed::write(const std::string& name, std::string_view content) const {
    OutputFile file(output / name, options.output);
    file.write(content);
    files.commit(file, name);
}

NewFiles::~NewFiles() {
    std::error_code ignored;
    for (const std::string& name : names_) fs::remove(folder_ / name, ignored);
}

void NewFiles::commit(OutputFile& file, const std::string& name) {
    std::error_code missing;
    const bool is_new = !fs::exists(folder_ / name, missing);
    file.commit();
    if (is_new) names_.push_back(name);
}

void write_segment_names(const Precomputed& precomputed, const WrittenRegions& regions) {
    const LabelNames& names = precomputed.options.names;
    Json ids = Json::array(), values = Json::array();
    for (const auto& [label, faces] : regions.faces) {
        const auto name = names.find(precomputed.labels.input(label));
        ids.push_back(precomputed.id(label));
        values.push_back(name == names.end() ? precomputed.id(label) : name->second);
    }
    Json properties = Json::array({{{"id", "label"}, {"type", "label"}, {"values", values}}});
    if (const LabelColours& given = precomputed.options.colours; !given.empty()) {
        Json colours = Json::array();
        for (const auto& [label, faces] : regions.faces) {
            const auto colour = given.find(precomputed.labels.input(label));
            colours.push_back(colour == given.end() ? "" : hex_of(colour->second));
        }
        properties.push_back({{"id", "colour"}, {"type", "string"}, {"values", colours}});
    }
    precomputed.write("names/info", text_of({{"@type", "neuroglancer_segment_properties"},
                                             {"inline", {{"ids", ids}, {"properties", properties}}}}));
}

/// Percent-encoded, apart from what RFC 3986 calls unreserved.
std::string in_url(const std::string& name) {
    std::string text;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '_' || c == '~')
            text += c;
        else
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return text;
}

void write_viewer_state(const Precomputed& precomputed, const WrittenRegions& regions) {
    const fs::path name =
        precomputed.output.has_filename() ? precomputed.output.filename() : precomputed.output.parent_path().filename();
    Json dimensions, position = Json::array(), segments = Json::array(), colours = Json::object();
    for (const char* axis : {"x", "y", "z"}) dimensions[axis] = {1e-9, "m"};
    double diagonal = 0;
    for (int axis = 0; axis < 3 && !regions.box.is_empty(); ++axis) {
        position.push_back((regions.box.low[axis] + regions.box.high[axis]) / 2);
        diagonal = std::hypot(diagonal, regions.box.high[axis] - regions.box.low[axis]);
    }
    for (const Label label : largest_regions(regions)) {
        segments.push_back(precomputed.id(label));
        const auto colour = precomputed.options.colours.find(precomputed.labels.input(label));
        if (colour != precomputed.options.colours.end()) colours[precomputed.id(label)] = hex_of(colour->second);
    }
    const Json layer{
        {"type", "segmentation"},       {"source", "precomputed://http://localhost:8080/" + in_url(name.string())},
        {"name", name.stem().string()}, {"tab", "segments"},
        {"segments", segments},         {"segmentColors", colours}};
    precomputed.write("state.json", text_of({{"dimensions", dimensions},
                                             {"position", position},
                                             {"projectionScale", diagonal},
                                             {"layers", Json::array({layer})},
                                             {"selectedLayer", {{"layer", name.stem().string()}, {"visible", true}}},
                                             {"layout", "3d"}}));
}

namespace {

PrecomputedResult write(const Precomputed& precomputed, ModelLevels& model) {
    for (Label label = 0; label < precomputed.labels.size(); ++label)
        if (precomputed.is_region(label)) precomputed.id(label);  // refuses before the work
    const fs::path info = precomputed.output / "info";
    if (std::error_code error; fs::remove(info, error), error)
        throw Error(ErrorCode::kOutput, info.string() + ": cannot be replaced: " + error.message());
    WrittenRegions written = precomputed.options.is_legacy ? write_legacy_meshes(precomputed, model)
                                                           : write_multi_resolution_meshes(precomputed, model);
    write_segment_names(precomputed, written);
    write_viewer_state(precomputed, written);
    written.info["segment_properties"] = "names";
    precomputed.write("info", text_of(written.info));  // last: a folder without it is not taken for whole
    precomputed.files.keep();
    return {written.faces.size(), written.rounded_share_of_edge};
}

}  // namespace

void make_precomputed_folder(const fs::path& output) {
    make_folder(output);
    make_folder(output / "names");
}

PrecomputedResult write_precomputed(const fs::path& folder, const fs::path& output, const PrecomputedOptions& given) {
    const Manifest manifest = read_complete_manifest(folder);
    LabelTable labels = read_labels(manifest, folder);
    PrecomputedOptions options = given;
    options.background = dense_background(manifest.background, labels);
    options.source = folder.string();
    if (!options.metres) options.metres = manifest.metres;
    if (options.names.empty()) options.names = manifest.names;
    if (options.colours.empty()) options.colours = manifest.colours;
    NewFiles files(output);
    return write({output, labels, options, files}, *levels_of_folder(folder, manifest));
}

PrecomputedResult write_precomputed(Mesh mesh, const LabelTable& labels, const fs::path& output,
                                    const PrecomputedOptions& options) {
    const CheckOptions checks{.boundary_is_open = options.boundary_is_open,
                              .background = options.background,
                              .threads = options.output.threads};
    NewFiles files(output);
    return write({output, labels, options, files}, *levels_of_mesh(std::move(mesh), checks));
}

}  // namespace regionmesh
