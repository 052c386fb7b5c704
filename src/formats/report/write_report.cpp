#include "regionmesh/write_report.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "formats/report/json_parts.h"
#include "regionmesh/output_file.h"

namespace regionmesh {
namespace {

/// `volumes` is by dense label and may be shorter than the table of labels.
void put_volume(Json& json, const char* name, const std::vector<double>& volumes, Label label) {
    if (label < volumes.size()) json[name] = volumes[label];
}

Json regions_json(std::vector<RegionReport> regions, const LabelTable& labels, const LabelNames& names,
                  const Report* run) {
    std::ranges::sort(regions, [&](const RegionReport& a, const RegionReport& b) {
        return labels.less(labels.input(a.label), labels.input(b.label));
    });
    Json json = Json::array();
    for (const RegionReport& region : regions) {
        json.push_back({{"label", label_json(labels.input(region.label), labels)},
                        {"euler", region.euler},
                        {"components", region.components},
                        {"volume", region.volume},
                        {"area", region.area}});
        if (const auto name = names.find(labels.input(region.label)); name != names.end())
            json.back()["name"] = name->second;
        if (!run) continue;
        put_volume(json.back(), "volume_unsmoothed", run->unsmoothed_volumes, region.label);
        put_volume(json.back(), "volume_smoothed", run->smoothing.volume_after, region.label);
        if (region.label < run->unsmoothed_volumes.size())
            json.back()["volume_change"] = region.volume / run->unsmoothed_volumes[region.label] - 1;
    }
    return json;
}

Json smoothing_json(const Report& report) {
    const SmoothReport& done = report.smoothing;
    const double seconds = done.filter_seconds;
    return {{"vertices", done.vertices},
            {"vertex_passes", done.vertex_passes},
            {"vertex_passes_per_second", seconds > 0 ? static_cast<double>(done.vertex_passes) / seconds : 0.0},
            {"filter_seconds", done.filter_seconds},
            {"guard_seconds", done.guard_seconds},
            {"turned_faces", done.turned_faces},
            {"low_quality_faces", done.low_quality_faces},
            {"crossing_pairs", done.crossing_pairs},
            {"islands", done.islands},
            {"held_vertices", done.held_vertices},
            {"stepped_back", done.backtracked},
            {"largest_displacement", done.largest_displacement},
            {"rms_displacement", done.rms_displacement},
            {"window_strips", done.window_chunks},
            {"window_bytes", done.window_bytes}};
}

Json shapes_json(const FaceShapes& shapes) {
    return {{"min_quality", shapes.min_quality},
            {"mean_quality", shapes.mean_quality},
            {"min_angle", shapes.min_angle},
            {"max_angle", shapes.max_angle},
            {"faces_below", shapes.faces_below}};
}

Json floor_json(const FloorResult& done) {
    Json left = Json::array();
    for (const Vec3 at : done.left) left.push_back({at.x, at.y, at.z});
    return {{"faces_below_before", done.below_before},
            {"faces_below", done.below_after},
            {"lowest_before", done.lowest_before},
            {"lowest", done.lowest_after},
            {"collapses", done.collapses},
            {"flips", done.flips},
            {"moves", done.moves},
            {"splits", done.splits},
            {"left", left}};
}

Json lines_json(const SmoothLinesResult& done) {
    return {{"vertices", done.vertices},     {"moves", done.moves},
            {"sweeps", done.sweeps},         {"turn_before", done.turn_before},
            {"turn_after", done.turn_after}, {"largest_displacement", done.largest_displacement}};
}

Json lengths_json(const EdgeLengths& lengths) {
    return {{"edges", lengths.edges},
            {"wanted", lengths.wanted},
            {"mean", lengths.mean},
            {"least", lengths.least},
            {"largest", lengths.largest}};
}

Json remeshed_json(const RemeshResult& done) {
    return {{"edge_length", done.edge_length},
            {"splits", done.splits},
            {"collapses", done.collapses},
            {"flips", done.flips},
            {"moves", done.moves},
            {"sweeps", done.sweeps},
            {"before", lengths_json(done.before)},
            {"after", lengths_json(done.after)}};
}

Json improved_json(const ImproveResult& done) {
    return {{"flips", done.flips},
            {"moves", done.moves},
            {"collapses", done.collapses},
            {"sweeps", done.sweeps},
            {"before", shapes_json(done.before)},
            {"after", shapes_json(done.after)}};
}

Json violations_json(const std::vector<Violation>& violations, const LabelTable& labels) {
    Json json = Json::array();
    for (const Violation& violation : violations) {
        json.push_back({{"kind", to_string(violation.kind)},
                        {"text", violation.text},
                        {"vertices", violation.vertices},
                        {"faces", violation.faces}});
        if (!violation.at) continue;
        json.back()["at"] = {violation.at->x, violation.at->y, violation.at->z};
        Json& met = json.back()["labels"] = Json::array();
        for (const Label label : violation.labels) {
            const Json text = label_json(is_exterior(label) ? labels.exterior_label() : labels.input(label), labels);
            if (met.empty() || met.back() != text) met.push_back(text);  // all sides of the box are one exterior
        }
    }
    return json;
}

void put_check(Json& json, const CheckReport& report, const LabelTable& labels, const LabelNames& names,
               const Report* run = nullptr) {
    json["quality"] = quality_json(report.quality);
    if (report.shapes) json["shapes"] = shapes_json(*report.shapes);
    json["regions"] = regions_json(report.regions, labels, names, run);
    json["triple_lines"] = {{"edges", report.lines.edges},
                            {"length", report.lines.length},
                            {"mean_turning_angle", report.lines.mean_turning_angle}};
    json["region_pairs"] = report.region_pairs;
    json["quadruple_points_inside"] = report.quadruple_points_inside;
    json["violations"] = violations_json(report.violations, labels);
    Json& counts = json["violation_counts"] = Json::object();
    for (std::size_t kind = 0; kind < report.counts.size(); ++kind)
        counts[to_string(static_cast<ViolationKind>(kind))] = report.counts[kind];
}

/// How well the model agrees with the sections, and each region with its label.
void put_samples(Json& json, const SampleAgreement& samples, const LabelTable& labels) {
    json["samples"] = samples.samples;
    json["samples_wrong"] = samples.wrong;
    json["samples_contradicting"] = samples.contradictions;
    json["dice"] = samples.dice();
    std::vector<Label> order(samples.regions.size());
    std::iota(order.begin(), order.end(), Label{0});
    std::ranges::sort(order, [&](Label a, Label b) { return labels.less(labels.input(a), labels.input(b)); });
    Json& all = json["dice_of_regions"] = Json::array();
    for (const Label label : order) {
        const SampleAgreement::Counts& region = samples.regions[label];
        if (region.in_sections + region.in_model == 0) continue;
        all.push_back({{"label", label_json(labels.input(label), labels)},
                       {"samples", region.in_sections},
                       {"samples_in_model", region.in_model},
                       {"dice", region.dice()}});
    }
}

/// Samples that several masks claim.
void put_overlaps(Json& json, const Overlaps& overlaps) {
    if (overlaps.samples.empty()) return;
    Json& all = json["overlaps"] = Json::array();
    for (const auto& [pair, samples] : overlaps.samples)
        all.push_back({{"labels", {pair.first, pair.second}}, {"samples", samples}});
}

Json denoise_json(const DenoiseReport& done, const LabelTable& labels) {
    Json json{{"specks", done.specks},
              {"speck_samples", done.speck_samples},
              {"largest_speck", done.largest_speck},
              {"samples_changed", done.changed},
              {"samples_cut", done.cut_samples},
              {"largest_distance", done.largest_distance}};
    if (done.roughness) put_roughness(*done.roughness, json);
    Json& regions = json["regions"] = Json::array();
    for (const auto& [label, change] : done.regions)
        regions.push_back({{"label", label_json(label, labels)}, {"gained", change.gained}, {"lost", change.lost}});
    return json;
}

/// Each option by its name: a text, or a list of texts where it was given several times.
Json options_json(const std::vector<std::pair<std::string, std::string>>& options) {
    Json json = Json::object();
    for (const auto& [name, text] : options) {
        Json& value = json[name];
        if (value.is_null())
            value = text;
        else if (value.is_array())
            value.push_back(text);
        else
            value = Json::array({value, text});
    }
    return json;
}

}  // namespace

std::string report_json(const Report& report, const LabelTable& labels, const LabelNames& names, const MadeBy& made_by,
                        std::optional<double> metres) {
    Json json{{"initial_faces", report.initial_faces},
              {"initial_vertices", report.initial_vertices},
              {"final_faces", report.final_faces},
              {"final_vertices", report.final_vertices},
              {"seconds", report.seconds},
              {"stage_bytes", report.stage_bytes},
              {"peak_bytes", report.peak_bytes},
              {"peak_faces", report.peak_faces},
              {"bytes_per_face", report.bytes_per_face}};
    put_unit(metres, json);
    Json& verdicts = json["verdicts"] = Json::object();
    for (std::size_t i = 0; i < report.verdicts.size(); ++i) verdicts[kVerdictNames[i]] = report.verdicts[i];
    json["refreshes"] = report.refreshes;
    json["sections_between"] = report.sections_between;
    json["sections_moved"] = report.sections_moved;
    json["largest_section_shift"] = report.largest_section_shift;
    put_overlaps(json, report.overlaps);
    json["samples_in_room"] = report.samples_in_room;
    json["denoise"] = denoise_json(report.denoise, labels);
    json["stopped"] = to_string(report.stopped);
    if (report.quality_bound) json["quality_bound"] = *report.quality_bound;
    json["error_bound"] = report.error_bound;
    json["smoothing"] = smoothing_json(report);
    json["pinned_vertices"] = report.pinned_vertices;
    json["volumes_preserved"] = {{"rounds", report.preserved.rounds},
                                 {"drift_before", report.preserved.drift_before},
                                 {"drift", report.preserved.drift},
                                 {"regions_off", report.preserved.regions_off},
                                 {"held_vertices", report.preserved.held_vertices}};
    if (report.remeshed) json["remeshed"] = remeshed_json(*report.remeshed);
    if (report.smoothed_lines) json["smoothed_lines"] = lines_json(*report.smoothed_lines);
    if (report.floor) json["floor"] = floor_json(*report.floor);
    if (report.improved) json["improved"] = improved_json(*report.improved);
    put_check(json, report.check, labels, names, &report);
    if (report.samples) put_samples(json, *report.samples, labels);
    if (!made_by.command.empty()) json["command"] = made_by.command;
    if (!made_by.command.empty()) json["options"] = options_json(made_by.options);
    return text_of(json);
}

std::string check_json(const CheckReport& report, const LabelTable& labels, const LabelNames& names,
                       const SampleAgreement* samples, std::optional<double> metres) {
    Json json;
    put_unit(metres, json);
    put_check(json, report, labels, names);
    if (samples) put_samples(json, *samples, labels);
    return text_of(json);
}

void write_text(const std::filesystem::path& path, std::string_view text, const OutputOptions& options) {
    OutputFile file(path, options);
    file.write(text);
    file.commit();
}

}  // namespace regionmesh
