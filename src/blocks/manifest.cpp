#include "blocks/manifest.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/fingerprint.h"
#include "blocks/block_grid.h"
#include "blocks/block_size.h"
#include "blocks/passes.h"
#include "formats/input_file.h"
#include "formats/report/json_parts.h"
#include "formats/text/header_text.h"
#include "formats/text/json_text.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "stream/section_faces.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "regionmesh blocks";
constexpr int kVersion = 1;

/// Along an axis of a volume or a block: a sum of three fits in 32 bits.
constexpr std::uint32_t kMostCells = 1u << 30;

Json vec_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec_of(const nlohmann::json& json) { return {json.at(0), json.at(1), json.at(2)}; }

/// Without changes by region.
Json json_of(const DenoiseReport& done) {
    Json json{{"samples", done.samples},
              {"specks", done.specks},
              {"speck_samples", done.speck_samples},
              {"largest_speck", done.largest_speck},
              {"cut_samples", done.cut_samples},
              {"changed", done.changed},
              {"largest_distance", done.largest_distance},
              {"labels", done.labels},
              {"labels_left", done.labels_left}};
    if (!done.refused.empty()) json["refused"] = done.refused;
    if (done.roughness)
        json["roughness"] = {{"enlarged", done.roughness->enlarged},
                             {"ragged", done.roughness->ragged},
                             {"stray", done.roughness->stray}};
    return json;
}

Json json_of(const Manifest& manifest) {
    Json json{{"format", kFormat}, {"version", kVersion}};
    Json& identity = json["run"] = Json::array();
    for (const auto& [name, value] : manifest.identity) identity.push_back({name, value});
    if (!manifest.is_surveyed) return json;
    const Lattice& lattice = manifest.lattice;
    json["in_place"] = manifest.is_in_place;
    json["source"] = manifest.source;
    json["size"] = lattice.size;
    json["spacing"] = vec_json(lattice.spacing);
    json["origin"] = vec_json(lattice.origin);
    json["direction"] = lattice.direction;
    json["sweep"] = manifest.sweep.axes;
    json["unsigned_labels"] = manifest.is_unsigned;
    json["labels"] = manifest.label_count;
    if (manifest.labels_hash) json["labels_hash"] = *manifest.labels_hash;
    if (manifest.hashes_hash) json["hashes_hash"] = *manifest.hashes_hash;
    if (manifest.samples_hash) json["samples_hash"] = *manifest.samples_hash;
    json["space"] = space_name(manifest.space);
    if (manifest.metres) json["metres_per_unit"] = *manifest.metres;
    Json& names = json["names"] = Json::array();
    for (const auto& [label, name] : manifest.names) names.push_back({label, name});
    Json& colours = json["colours"] = Json::array();
    for (const auto& [label, colour] : manifest.colours) colours.push_back({label, hex_of(colour)});
    if (manifest.denoise) json["denoise"] = json_of(*manifest.denoise);
    json["background"] = manifest.background;
    json["block_cells"] = manifest.block_cells;
    json["shift"] = manifest.shift;
    json["scale_z"] = manifest.scale_z;
    json["initial_faces"] = manifest.initial_faces;
    json["passes"] = manifest.passes;
    json["complete"] = manifest.is_complete;
    json["vertices"] = manifest.vertices;
    json["faces"] = manifest.faces;
    json["stopped"] = to_string(manifest.stopped);
    json["error_bound"] = manifest.error_bound;
    Json& pieces = json["pieces"] = Json::array();
    for (const PieceEntry& piece : manifest.pieces) {
        pieces.push_back(
            {{"pass", piece.pass}, {"vertices", piece.vertices}, {"faces", piece.faces}, {"crc32", piece.checksum}});
        if (piece.collapses) pieces.back()["collapses"] = *piece.collapses;
    }
    const auto& [seams, first_log, second_log] = manifest.thresholds;
    if (!manifest.is_complete) json["thresholds"] = {seams, first_log, second_log};
    return json;
}

StopReason stop_reason_of(const std::string& text) {
    for (const StopReason reason : {StopReason::kTarget, StopReason::kMaxError, StopReason::kTopology})
        if (text == to_string(reason)) return reason;
    return StopReason::kNoneAsked;
}

std::uint32_t colour_of(const std::string& text, const fs::path& path) {
    const auto colour = formats::parse_colour(text);
    if (!colour) formats::fail(path, "has the colour '" + formats::shown(text) + "'; write it as #ff8000");
    return *colour;
}

/// Whole numbers that fit in what they are read into.
class WholeNumbers {
public:
    WholeNumbers(const nlohmann::json& json, const fs::path& path) : json_(json), path_(path) {}

    template <class Number>
    void get(const char* key, Number& number) const {
        number = static_cast<Number>(formats::whole_number(path_, json_.at(key), std::numeric_limits<Number>::max()));
    }
    template <class Number>
    void get(const char* key, std::optional<Number>& number) const {
        if (json_.contains(key)) get(key, number.emplace());
    }

private:
    const nlohmann::json& json_;
    const fs::path& path_;
};

PieceEntry piece_of(const nlohmann::json& json, const fs::path& path) {
    PieceEntry piece{};
    const WholeNumbers numbers(json, path);
    numbers.get("pass", piece.pass);
    numbers.get("vertices", piece.vertices);
    numbers.get("faces", piece.faces);
    numbers.get("crc32", piece.checksum);
    numbers.get("collapses", piece.collapses);
    return piece;
}

DenoiseReport denoise_of(const nlohmann::json& json, const fs::path& path) {
    DenoiseReport done;
    const WholeNumbers numbers(json, path);
    numbers.get("samples", done.samples);
    numbers.get("specks", done.specks);
    numbers.get("speck_samples", done.speck_samples);
    numbers.get("largest_speck", done.largest_speck);
    numbers.get("cut_samples", done.cut_samples);
    numbers.get("changed", done.changed);
    numbers.get("labels", done.labels);
    numbers.get("labels_left", done.labels_left);
    done.largest_distance = json.at("largest_distance");
    done.refused = json.value("refused", "");
    if (json.contains("roughness")) {
        const auto& roughness = json.at("roughness");
        done.roughness.emplace();
        done.roughness->enlarged = roughness.at("enlarged");
        done.roughness->ragged = roughness.at("ragged");
        done.roughness->stray = roughness.at("stray");
    }
    return done;
}

Manifest manifest_of(const nlohmann::json& json, const fs::path& path) {
    Manifest manifest;
    for (const auto& pair : json.at("run")) manifest.identity.emplace_back(pair.at(0), pair.at(1));
    manifest.is_surveyed = json.contains("size");
    if (!manifest.is_surveyed) return manifest;
    Lattice& lattice = manifest.lattice;
    manifest.is_in_place = json.at("in_place");
    manifest.source = json.at("source");
    for (std::size_t axis = 0; axis < 3; ++axis)
        lattice.size[axis] =
            static_cast<std::uint32_t>(formats::whole_number(path, json.at("size").at(axis), kMostCells));
    lattice.spacing = vec_of(json.at("spacing"));
    lattice.origin = vec_of(json.at("origin"));
    lattice.direction = json.at("direction");
    manifest.sweep.axes = json.at("sweep");
    manifest.is_unsigned = json.at("unsigned_labels");
    const WholeNumbers numbers(json, path);
    numbers.get("labels", manifest.label_count);
    numbers.get("labels_hash", manifest.labels_hash);
    numbers.get("hashes_hash", manifest.hashes_hash);
    numbers.get("samples_hash", manifest.samples_hash);
    manifest.space = space_named(json.at("space").get<std::string>());
    if (json.contains("metres_per_unit"))
        manifest.metres = json.at("metres_per_unit").get<double>();  // added to version 1
    for (const auto& pair : json.at("names")) manifest.names.emplace(pair.at(0), pair.at(1));
    if (json.contains("colours"))  // added to version 1
        for (const auto& pair : json.at("colours")) manifest.colours.emplace(pair.at(0), colour_of(pair.at(1), path));
    if (json.contains("denoise")) manifest.denoise = denoise_of(json.at("denoise"), path);
    manifest.background = json.at("background").get<std::vector<InputLabel>>();
    numbers.get("block_cells", manifest.block_cells);
    numbers.get("shift", manifest.shift);
    manifest.scale_z = json.at("scale_z");
    numbers.get("initial_faces", manifest.initial_faces);
    numbers.get("passes", manifest.passes);
    manifest.is_complete = json.at("complete");
    numbers.get("vertices", manifest.vertices);
    numbers.get("faces", manifest.faces);
    manifest.stopped = stop_reason_of(json.at("stopped"));
    manifest.error_bound = json.at("error_bound");
    if (json.contains("thresholds")) {
        const auto& [seams, first_log, second_log] = json["thresholds"].get<std::array<double, 3>>();
        manifest.thresholds = {seams, first_log, second_log};
    }
    for (const auto& piece : json.at("pieces")) manifest.pieces.push_back(piece_of(piece, path));
    return manifest;
}

/// Sizes that no volume and no run has would lead out of arrays.
void require_sound(const Manifest& manifest, const fs::path& path) {
    if (!manifest.is_surveyed) return;
    const auto damaged = [&] { formats::fail(path, "sizes and pieces do not fit together; the file is damaged"); };
    const auto& size = manifest.lattice.size;
    if (!std::ranges::is_permutation(manifest.sweep.axes, std::array{0, 1, 2})) damaged();
    if (std::ranges::min(size) < 2 || std::ranges::max(size) > kMostCells) damaged();
    if (manifest.block_cells < 1 || manifest.block_cells > kMostCells || manifest.shift >= manifest.block_cells)
        damaged();
    if (manifest.metres && !is_unit_of_length(*manifest.metres)) damaged();
    if (!(manifest.scale_z > 0) || manifest.passes > kMostBlockPasses) damaged();
    require_lattice(path.string(), manifest.lattice);
    const BlockGrid grid = piece_grid(manifest);
    double blocks = 1;  // more than 32 bits hold, perhaps
    for (const std::uint32_t along : grid.counts()) blocks *= along;
    if (blocks > kMostBlocks) damaged();
    const bool has_pieces = manifest.is_complete || manifest.passes > 0;
    if (static_cast<double>(manifest.pieces.size()) != (has_pieces ? blocks : 0)) damaged();
}

/// Of all keys and values, in whatever order and layout.
std::uint64_t checksum_of(const nlohmann::json& json) { return Fingerprint().add(json.dump()).value(); }

fs::path labels_path(const fs::path& folder) { return folder / kLabels; }

}  // namespace

Manifest require_manifest(const fs::path& folder) {
    auto manifest = read_manifest(folder);
    if (!manifest) formats::fail(folder, "has no manifest.json; it is no model in pieces");
    return std::move(*manifest);
}

Manifest read_complete_manifest(const fs::path& folder) {
    Manifest manifest = require_manifest(folder);
    if (!manifest.is_complete)
        formats::fail(folder, "the model is not complete; run the command that began it once more");
    std::uint64_t vertices = 0, faces = 0;  // vertices on walls are those of several pieces
    for (const PieceEntry& piece : manifest.pieces) {
        vertices += piece.vertices;
        faces += piece.faces;
    }
    if (faces != manifest.faces || vertices < manifest.vertices)
        formats::fail(manifest_path(folder), "the counts of the pieces do not fit its own; the file is damaged");
    return manifest;
}

Lattice piece_lattice(const Manifest& manifest) {
    VolumeInfo info;
    info.source = manifest.source;
    info.lattice = manifest.lattice;
    info.sweep = manifest.sweep;
    return section_shape(info, CellKind::kCompact, manifest.scale_z).lattice;
}

BlockGrid piece_grid(const Manifest& manifest) {
    return {piece_lattice(manifest), manifest.block_cells, manifest.shift};
}

Coordinates coordinates_of(const Manifest& manifest) {
    return {manifest.space, manifest.metres, manifest.lattice.spacing};
}

fs::path manifest_path(const fs::path& folder) { return folder / "manifest.json"; }

std::optional<Manifest> read_manifest(const fs::path& folder) {
    const fs::path path = manifest_path(folder);
    const auto json = formats::read_json(path);
    if (!json) return {};
    return formats::reading(path, [&] {
        if (json->value("format", "") != kFormat) formats::fail(path, "is no manifest of blocks");
        if (json->at("version") != kVersion)
            formats::fail(path, "is of version " + json->at("version").dump() + ", and this program writes version " +
                                    std::to_string(kVersion) + "; take the program that wrote it");
        if (json->contains("checksum")) {  // added to version 1
            nlohmann::json rest = *json;
            rest.erase("checksum");
            if (json->at("checksum") != checksum_of(rest))
                formats::fail(path,
                              "its checksum does not fit: the file was changed; remove the folder, and run again");
        }
        Manifest manifest = manifest_of(*json, path);
        require_sound(manifest, path);
        return manifest;
    });
}

void write_manifest(const Manifest& manifest, const fs::path& folder, const OutputOptions& options) {
    OutputFile file(manifest_path(folder), options);
    Json json = json_of(manifest);
    json["checksum"] = checksum_of(nlohmann::json::parse(text_of(json)));
    file.write(text_of(json));
    file.commit();
}

namespace {

/// "50%" as 0.5; nothing for other words.
std::optional<double> share_of(std::string_view text) {
    const bool is_percent = text.ends_with('%');
    if (is_percent) text.remove_suffix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return is_percent ? number / 100 : number;
}

/// The same text, or the same share as a number and in per cent.
bool is_same_value(const std::string& a, const std::string& b) {
    if (a.ends_with('%') == b.ends_with('%')) return a == b;
    return share_of(a) && share_of(a) == share_of(b);
}

}  // namespace

void require_same_run(const Manifest& there, const RunIdentity& identity, const fs::path& folder) {
    const auto refuse = [&](const std::string& name, const std::string& was, const std::string& is) {
        throw Error(ErrorCode::kInput, folder.string() + ": was begun with " + name + ' ' + was +
                                           ", and this run has " + is +
                                           "; give what it was begun with, or another folder");
    };
    const auto find = [](const RunIdentity& in, const std::string& name) -> const std::string* {
        for (const auto& [other, value] : in)
            if (other == name) return &value;
        return nullptr;
    };
    for (const auto& [name, value] : there.identity) {
        const std::string* const now = find(identity, name);
        if (!now || !is_same_value(*now, value)) refuse(name, value, now ? *now : "none");
    }
    for (const auto& [name, value] : identity)
        if (!find(there.identity, name)) refuse(name, "not given", value);
}

void write_labels(const LabelTable& labels, const fs::path& folder, const OutputOptions& options) {
    OutputFile file(labels_path(folder), options);
    for (Label label = 0; label < labels.size(); ++label) {
        const InputLabel input = labels.input(label);
        file.write({reinterpret_cast<const char*>(&input), sizeof(input)});
    }
    file.commit();
}

LabelTable read_labels(const Manifest& manifest, const fs::path& folder) {
    const formats::InputFile file(labels_path(folder));
    if (file.size() % sizeof(InputLabel) != 0 || file.size() / sizeof(InputLabel) != manifest.label_count)
        formats::fail(file.path(), "has not the labels that the manifest counts; the file is damaged");
    std::vector<InputLabel> inputs(manifest.label_count);
    const auto bytes = std::as_writable_bytes(std::span(inputs));
    if (file.read(0, bytes) != bytes.size()) formats::fail(file.path(), "ends early");
    LabelTable labels(manifest.is_unsigned);
    for (const InputLabel input : inputs) labels.dense(input);
    if (labels.size() != manifest.label_count) formats::fail(file.path(), "has a label twice; the file is damaged");
    if (manifest.labels_hash && *manifest.labels_hash != hash_of(labels))
        formats::fail(file.path(), "has other labels than the manifest says; the file is damaged");
    return labels;
}

std::uint64_t hash_of(const LabelTable& labels) {
    Fingerprint fingerprint;
    for (Label label = 0; label < labels.size(); ++label)
        fingerprint.add(static_cast<std::uint64_t>(labels.input(label)));
    return fingerprint.value();
}

std::uint64_t job_of(const RunIdentity& identity) {
    Fingerprint fingerprint;
    fingerprint.add(kVersion);
    for (const auto& [name, value] : identity) fingerprint.add(name.size()).add(name).add(value.size()).add(value);
    return fingerprint.value();
}

}  // namespace regionmesh
