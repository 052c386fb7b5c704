#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "messages.h"
#include "page_output.h"
#include "printable.h"
#include "regionmesh/blocks.h"

namespace regionmesh::cli {
namespace {

constexpr std::size_t kShown = 10;  // rows of a table; the JSON has all
constexpr std::size_t kNameWidth = 12;

/// A model, and what its file says about it. Where a folder is read piece by piece, `file` has no mesh.
struct Input {
    MeshFile file;
    std::unique_ptr<ComparedModel> model;  // refers to the file
};

/// A folder of pieces is read piece by piece, unless the whole mesh is needed.
std::unique_ptr<Input> open_model(const std::string& path, bool needs_mesh) {
    auto input = std::make_unique<Input>();
    if (is_block_folder(path) && !needs_mesh) {
        input->file = describe_block_folder(path);
        input->model = open_block_folder(path);
    } else {
        input->file = read_model(path);
        input->model = std::make_unique<ComparedMesh>(input->file.mesh, input->file.labels);
    }
    if (input->model->face_count() == 0)
        throw Error(ErrorCode::kInput, fmt::format("{}: has no faces; there is nothing to compare", path));
    return input;
}

/// Names, or labels as typed where there is none: "Femur", or "Femur|7|-1".
std::string name_of(const std::vector<Label>& labels, const LabelTable& table, const LabelNames& names) {
    std::string name;
    for (const Label label : labels) {
        if (!name.empty()) name += '|';
        const auto named = is_exterior(label) ? names.end() : names.find(table.input(label));
        if (named != names.end())
            name += printable(named->second);
        else
            name += is_exterior(label) ? std::to_string(table.exterior_label()) : table.text(table.input(label));
    }
    return name;
}

/// One row of a table: a name, measures as text, and distances.
struct Row {
    std::string name, measures;
    bool is_in_a, is_in_b;
    const TwoSidedDistance& distance;
};

std::vector<Row> rows_of(const CompareReport& report, const std::vector<RegionComparison>& regions,
                         const LabelNames& names) {
    std::vector<Row> rows;
    for (const RegionComparison& region : regions) {
        const auto& [a, b] = region.measures;
        std::string measures;
        if (a && b)
            measures = fmt::format("{:>12.5g} {:>+10.3g} {:>12.5g} {:>+10.3g} {:>6} {:>+5}", a->volume,
                                   b->volume - a->volume, a->area, b->area - a->area, a->euler, b->euler - a->euler);
        rows.push_back(
            {name_of({region.label}, report.labels, names), measures, a.has_value(), b.has_value(), region.distance});
    }
    return rows;
}

std::vector<Row> rows_of(const CompareReport& report, const std::vector<StratumComparison>& strata,
                         const LabelNames& names) {
    std::vector<Row> rows;
    for (const StratumComparison& stratum : strata) {
        const auto& [a, b] = stratum.measures;
        std::string measures;
        if (a && b) measures = fmt::format("{:>12.5g} {:>+10.3g}", *a, *b - *a);
        rows.push_back(
            {name_of(stratum.labels, report.labels, names), measures, a.has_value(), b.has_value(), stratum.distance});
    }
    return rows;
}

std::string text_of(const DistanceStatistics& d) {
    return fmt::format("{:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g}", d.rms, d.mean, d.quantile_95, d.max);
}
constexpr const char* kDistanceHead = "       rms       mean       95 %        max";

void print_only(const char* mesh, const char* what, const std::vector<Row>& rows, bool Row::*has, bool Row::*has_not) {
    std::string names;
    std::size_t count = 0;
    for (const Row& row : rows)
        if (row.*has && !(row.*has_not) && count++ < kShown) names += (names.empty() ? "" : ", ") + row.name;
    if (count > kShown) names += fmt::format(" and {} more", count - kShown);
    if (count > 0) fmt::print("only in {}: {} {}\n", mesh, what, names);
}

/// The rows that both models have, the largest rms distance first; then those that only one of them has.
void print_table(const char* what, const char* measures_head, const std::vector<Row>& rows) {
    std::vector<const Row*> shown;
    for (const Row& row : rows)
        if (row.distance.both) shown.push_back(&row);
    std::ranges::stable_sort(shown, std::greater{}, [](const Row* row) { return row->distance.both->rms; });
    const std::size_t count = std::min(shown.size(), kShown);
    std::size_t width = kNameWidth;
    for (std::size_t n = 0; n < count; ++n) width = std::max(width, shown[n]->name.size());
    fmt::print("\n{:<{}}{}{}\n", what, width, measures_head, kDistanceHead);
    for (std::size_t n = 0; n < count; ++n)
        fmt::print("{:<{}}{}{}\n", shown[n]->name, width, shown[n]->measures, text_of(*shown[n]->distance.both));
    if (shown.size() > count) fmt::print("and {} more with smaller distances\n", shown.size() - count);
    print_only("A", what, rows, &Row::is_in_a, &Row::is_in_b);
    print_only("B", what, rows, &Row::is_in_b, &Row::is_in_a);
}

/// Percent of the counts, in groups of neighbouring bins.
template <class Histogram>
std::string percents(const Histogram& histogram, std::size_t group) {
    const auto sum = static_cast<double>(std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0}));
    std::string text;
    for (std::size_t n = 0; n < histogram.size(); n += group) {
        const auto part = std::accumulate(histogram.begin() + n, histogram.begin() + n + group, std::uint64_t{0});
        text += fmt::format("{:>6.2f}", sum > 0 ? 100 * static_cast<double>(part) / sum : 0);
    }
    return text;
}

void print_quality(const std::array<QualityReport, 2>& quality) {
    constexpr std::size_t kQualityGroup = 2, kAngleGroup = 1;
    constexpr const char* kNames[] = {"A", "B"};
    fmt::print("\nquality     lowest  mean   percent of faces from");
    for (int n = 0; n < 14; ++n) fmt::print("{:>6.2f}", 0.02 * n);
    for (int n = 0; n < 2; ++n)
        fmt::print("\n{}            {:.3f}  {:.3f}                      {}", kNames[n], quality[n].min, quality[n].mean,
                   percents(quality[n].histogram, kQualityGroup));
    fmt::print("\nangles      lowest highest percent of angles from");
    for (int n = 0; n < 18; ++n) fmt::print("{:>5}{}", 10 * n, n < 17 ? " " : "");
    for (int n = 0; n < 2; ++n)
        fmt::print("\n{}           {:>6.2f} {:>6.2f}                     {}", kNames[n], quality[n].min_angle,
                   quality[n].max_angle, percents(quality[n].angle_histogram, kAngleGroup));
    fmt::print("\n");
}

void print_report(const Settings& settings, const CompareReport& report, const LabelNames& names) {
    fmt::print("A  {}: {} faces, {} vertices\n", printable(settings.models[0]), report.faces[0], report.vertices[0]);
    fmt::print("B  {}: {} faces, {} vertices\n", printable(settings.models[1]), report.faces[1], report.vertices[1]);
    fmt::print("\n{:<{}}{}\n", "surface", kNameWidth, kDistanceHead);
    fmt::print("{:<{}}{}\n", "A to B", kNameWidth, text_of(*report.distance.a_to_b));
    fmt::print("{:<{}}{}\n", "B to A", kNameWidth, text_of(*report.distance.b_to_a));
    fmt::print("{:<{}}{}\n", "both", kNameWidth, text_of(*report.distance.both));
    print_table("regions", "    volume A     change       area A     change  Euler change",
                rows_of(report, report.regions, names));
    print_table("interfaces", "      area A     change", rows_of(report, report.interfaces, names));
    print_table("lines", "    length A     change", rows_of(report, report.lines, names));
    print_quality(report.quality);
}

/// Equal labels are taken for one region. Two programs, or two runs, may have numbered the same names differently.
void warn_of_other_names(const LabelNames& a, const LabelNames& b) {
    std::size_t count = 0;
    std::string first;
    for (const auto& [label, name] : a) {
        const auto other = b.find(label);
        if (other == b.end() || other->second == name) continue;
        if (count++ == 0) first = fmt::format("{} is {} in A and {} in B", label, name, other->second);
    }
    if (count > 0)
        warn(
            fmt::format("{} under other names in A and B ({}): regions are compared by label, and shown with the "
                        "names of A; give the same region the same label in both, with --merge when you reconstruct",
                        counted(count, "label"), first));
}

/// The dense labels of the background that the model has.
std::vector<Label> background_of(const Settings& settings, const LabelTable& labels) {
    const std::vector<InputLabel>& background = settings.reconstruct.background;
    std::vector<Label> dense;
    for (Label label = 0; label < labels.size(); ++label)
        if (std::ranges::find(background, labels.input(label)) != background.end()) dense.push_back(label);
    return dense;
}

/// A with the distance of each vertex to B.
void write_distances(const Settings& settings, const MeshFile& a, const CompareReport& report, OutputFiles& files) {
    write_mesh(a.mesh, a.labels, settings.distance,
               {.background = background_of(settings, a.labels),
                .point_arrays = {{"Distance", report.vertex_distances}},
                .names = a.names,
                .colours = a.colours,
                .coordinates = a.coordinates},
               files);
}

/// The distance of each vertex of B to A.
std::vector<double> distances_back(const Settings& settings, const MeshFile& a, const MeshFile& b) {
    constexpr std::uint64_t kFew = 1000;  // samples: their distances are not looked at
    return compare({b.mesh, b.labels}, {a.mesh, a.labels},
                   {.samples = kFew,
                    .background = settings.reconstruct.background,
                    .vertex_distances = true,
                    .threads = settings.reconstruct.threads})
        .vertex_distances;
}

/// Both models side by side, each with its distances to the other.
void write_comparison(const Settings& settings, const MeshFile& a, const MeshFile& b, const CompareReport& report,
                      OutputFiles& files) {
    const std::vector<double> back = distances_back(settings, a, b);
    std::vector<PageModel> models;
    for (const auto& [path, file] : {std::pair(&settings.models[0], &a), std::pair(&settings.models[1], &b)})
        models.push_back(page_model(*path, {file->mesh, file->labels, background_of(settings, file->labels),
                                            file->names, file->colours, file->coordinates}));
    models[0].distances = report.vertex_distances;
    models[1].distances = back;
    write_page(settings.html, models, page_options(kCompare, settings, compare_json(report), false), files);
}

}  // namespace

int run_compare(const Settings& given) {
    if (!given.json.empty()) require_writable(given.json, given.writing);
    require_page(given.html, given.writing);
    if (!given.distance.empty()) require_writable_mesh(given.distance, {.output = given.writing}, true);
    const bool needs_b = !given.html.empty(), needs_a = needs_b || !given.distance.empty();
    const auto inputs = std::array{open_model(given.models[0], needs_a), open_model(given.models[1], needs_b)};
    const MeshFile &a = inputs[0]->file, &b = inputs[1]->file;
    const Space space_a = a.coordinates.space, space_b = b.coordinates.space;
    if (space_a != space_b && space_a != Space::kUnknown && space_b != Space::kUnknown)
        warn(
            fmt::format("{} is in {} and {} in {}: they are compared as they are; turn one of them with regionmesh "
                        "convert --space",
                        given.models[0], space_name(space_a), given.models[1], space_name(space_b)));
    warn_of_units(given.models[0], a.coordinates.metres, given.models[1], b.coordinates.metres);
    const Settings settings = settings_for(given, a.background && !a.background->empty() ? a : b);
    const CompareReport report = compare(*inputs[0]->model, *inputs[1]->model,
                                         {.samples = settings.samples,
                                          .background = settings.reconstruct.background,
                                          .vertex_distances = needs_a,
                                          .threads = settings.reconstruct.threads});
    if (!report.distance.both)
        throw Error(ErrorCode::kInput,
                    fmt::format("{}, {}: one of them has no face of positive area, except faces between background and "
                                "exterior: there is nothing to compare; see --no-background",
                                settings.models[0], settings.models[1]));
    warn_of_other_names(a.names, b.names);
    LabelNames names = a.names;
    names.insert(b.names.begin(), b.names.end());
    OutputFiles files(settings.writing);
    if (!settings.json.empty()) files.add(settings.json).write(compare_json(report, names));
    if (!settings.distance.empty()) write_distances(settings, a, report, files);
    if (!settings.html.empty()) write_comparison(settings, a, b, report, files);
    files.commit();
    if (!settings.quiet) print_report(settings, report, names);
    return kGood;
}

}  // namespace regionmesh::cli
