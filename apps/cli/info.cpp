#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "printable.h"
#include "regionmesh/blocks.h"

namespace regionmesh::cli {
namespace {

constexpr std::size_t kShown = 20;    // labels, without --all
constexpr double kLeastJitter = 0.5;  // samples: less changes nothing when it is taken out

/// Prints a row for each of `order`, or for the first only; row(label) gives it. `plural` is what they are.
template <class Row>
void print_rows(const Settings& settings, std::size_t count, const char* plural, Row&& row) {
    fmt::print("{:<10} {}\n", plural, count);
    const std::size_t shown = settings.list_all ? count : std::min(count, kShown);
    for (std::size_t n = 0; n < shown; ++n) fmt::print("  {}\n", row(n));
    if (shown < count) fmt::print("  and {} more; --all lists them\n", count - shown);
}

std::string name_after(const LabelNames& names, InputLabel label) {
    const auto name = names.find(label);
    return name == names.end() ? "" : "  " + printable(name->second);
}

/// `unit` is the thing counted for each label: "sample", "point" or "tetrahedron".
template <class AnyCensus>
void print_labels(const Settings& settings, const AnyCensus& census, const LabelNames& names, const char* unit) {
    std::vector<Label> order;
    for (Label label = 0; label < census.labels.size(); ++label)
        if (label < census.samples.size() && census.samples[label] > 0) order.push_back(label);
    std::sort(order.begin(), order.end(),
              [&](Label a, Label b) { return census.labels.less(census.labels.input(a), census.labels.input(b)); });
    print_rows(settings, order.size(), "labels", [&](std::size_t n) {
        const InputLabel label = census.labels.input(order[n]);
        const std::uint64_t count = census.samples[order[n]];
        return fmt::format("{:>12}  {} {}{}", census.labels.text(label), count, count == 1 ? unit : plural_of(unit),
                           name_after(names, label));
    });
}

template <class AnyCensus>
void print_model(const AnyCensus& census) {
    fmt::print("model      {} faces unsimplified; {} of regions with an interface\n", census.face_count,
               counted(census.oracle.region_pairs, "pair"));
}

std::string unit_after(const std::optional<double>& metres) { return metres ? ' ' + length_symbol(*metres) : ""; }

std::string print_info(const Settings& settings, TetrahedronReader& reader) {
    const TetrahedraInfo& info = reader.info();
    const TetrahedronCensus census = count_labels(reader, census_options(settings));
    fmt::print("file       {} ({})\n", printable(info.source), info.format);
    fmt::print("size       {} points, {} {}\n", census.point_count, census.tetrahedron_count,
               census.tetrahedron_count == 1 ? "tetrahedron" : "tetrahedra");
    fmt::print("spacing    {:.6g}{} (mean){}\n", census.spacing, unit_after(info.metres),
               info.scale_z == 1 ? "" : ", z scaled");
    fmt::print("sweep      along {}\n", "xyz"[census.sweep.axes[2]]);
    print_labels(settings, census, info.names, info.has_cell_labels ? "tetrahedron" : "point");
    print_model(census);
    return info_json(info, census);
}

std::string print_info(const Settings& settings, SectionReader& reader) {
    const VolumeInfo info = reader.info();
    const Lattice& lattice = info.lattice;
    const Census census = count_labels(reader, census_options(settings));
    fmt::print("file       {} ({})\n", printable(info.source), info.format);
    fmt::print("size       {} x {} x {} samples of {}\n", lattice.size[0], lattice.size[1], lattice.size[2],
               to_string(info.type));
    fmt::print("spacing    {} x {} x {}{}\n", lattice.spacing.x, lattice.spacing.y, lattice.spacing.z,
               unit_after(info.metres));
    const Vec3 origin = lattice.origin + Vec3{};  // 0, not -0
    fmt::print("origin     {}, {}, {}\n", origin.x, origin.y, origin.z);
    if (!lattice.is_axis_aligned()) {
        auto d = lattice.direction;
        for (double& part : d) part += 0.0;  // not -0
        fmt::print("direction  [{:g} {:g} {:g}] [{:g} {:g} {:g}] [{:g} {:g} {:g}]\n", d[0], d[1], d[2], d[3], d[4],
                   d[5], d[6], d[7], d[8]);
    }
    const char axis = std::string("xyz")[info.sweep.axes[2]];
    fmt::print("sweep      along {}, {} sections of {} x {}\n", axis, reader.section_count(), reader.section_width(),
               reader.section_height());
    print_labels(settings, census, info.names, "sample");
    print_model(census);
    std::optional<Roughness> roughness;
    if (info.can_rewind) roughness = measure_roughness(reader, settings.reconstruct.threads);
    if (roughness) fmt::print("roughness  {}\n", roughness->text());
    const auto megabytes = [&](std::optional<double> reduce) {
        ReconstructOptions options = with_free_target(settings, info.lattice.spacing);
        if (reduce) options.reduce = reduce;
        std::uint64_t least = least_memory(info, census, options);
        if (roughness && options.room == 0 && options.denoise.distance != 0)
            least = std::max(least, bytes_to_denoise(info, *roughness, options.denoise));
        return std::ceil(static_cast<double>(least) / 1e6);
    };
    fmt::print("memory     {:.0f} MB at least, {:.0f} MB with --reduce 80%\n", megabytes({}), megabytes(0.8));
    return info_json(info, census, roughness);
}

/// What --between and --align would do: one line each, where there is something to say.
void print_sections(const Settings& settings) {
    const auto open = [&](SweepChoice sweep) {
        Settings own = settings;
        own.volume.sweep = sweep;
        return open_volume(own, own.inputs);
    };
    const auto sections = open_as_cut(open, settings.volume.sweep);
    const VolumeInfo& info = sections->info();
    if (!info.can_rewind || sections->section_count() < 2) return;
    const JitterSum jitter = summed(find_jitter(*sections, AlignKind::kTranslate));
    if (jitter.rms >= kLeastJitter)
        fmt::print(
            "jitter     {:.1f} samples (root mean square), largest {:.1f} in section {}: --align translate takes it "
            "out\n",
            jitter.rms, jitter.largest, jitter.section);
    if (far_axis(info.lattice) != info.sweep.axes[2]) return;
    const PartPairs pairs = count_part_pairs(*sections);
    fmt::print("parts      {} of neighbouring sections, {} do not overlap\n",
               counted(pairs.overlapping + pairs.apart, "pair"), grouped(pairs.apart));
}

/// A folder of pieces is read piece by piece.
std::string print_info(const Settings& given, const std::string& path) {
    const bool is_folder = is_block_folder(path);
    MeshFile file = is_folder ? describe_block_folder(path) : read_mesh(path);
    const Settings settings = settings_for(given, file);
    CheckOptions options = check_options(settings, file.labels);
    options.crossing = false;
    const CheckReport report = is_folder ? check_block_folder(path, options) : check(file.mesh, options);
    const ModelSize size = is_folder ? size_of_block_folder(path) : size_of(file.mesh);
    const auto& [low, high] = size.box;
    fmt::print("file       {} (surface model)\n", printable(path));
    fmt::print("size       {}, {}\n", counted(size.faces, "face"), counted(size.vertices, "vertex"));
    fmt::print("box        {:g} to {:g}, {:g} to {:g}, {:g} to {:g}{}\n", low.x, high.x, low.y, high.y, low.z, high.z,
               unit_after(file.coordinates.metres));
    std::vector<RegionReport> regions = report.regions;
    std::ranges::sort(regions, [&](const RegionReport& a, const RegionReport& b) {
        return file.labels.less(file.labels.input(a.label), file.labels.input(b.label));
    });
    print_rows(settings, regions.size(), "regions", [&](std::size_t n) {
        const InputLabel label = file.labels.input(regions[n].label);
        return fmt::format("{:>12}  volume {:.6g}, area {:.6g}{}", file.labels.text(label), regions[n].volume,
                           regions[n].area, name_after(file.names, label));
    });
    fmt::print("interfaces {} of regions; regionmesh check looks for violations\n",
               counted(report.region_pairs, "pair"));
    return info_json(path, file, size, report);
}

/// How well drill holes are layers.
void print_layers(const Settings& settings) {
    LayerSummary found;
    open_layers(settings.inputs.front(), settings.tetrahedra, layer_options(settings), &found);
    std::string units;
    for (const std::string& unit : found.units) units.append(units.empty() ? "" : ", ").append(printable(unit));
    fmt::print("layers     {} from young to old: {}; {:.1f} % of the logged length is in this order\n",
               found.units.size(), units, 100 * found.ordered_share);
}

std::string print_input(const Settings& settings) {
    if (!settings.layers.empty()) {
        require_fit(settings, settings.inputs);
        print_layers(settings);
    }
    return with_reader(settings, settings.inputs, [&](auto& reader) {
        const std::string warned = reader.info().warning;
        std::string json = print_info(settings, reader);
        if (kind_of_input(settings.inputs) == kVolumeInput && settings.inputs.front() != "-") print_sections(settings);
        warn_of_rest(reader, warned);
        warn_of_grey_scale(settings, reader);
        return json;
    });
}

/// An input, or a surface model: some files may be either, and a folder too.
std::string print_anything(const Settings& settings) {
    const std::string& path = settings.inputs.front();
    const auto model = [&] { return print_info(settings, path); };
    std::error_code ignored;
    const bool is_folder = std::filesystem::is_directory(path, ignored);
    const bool may_be_model = settings.inputs.size() == 1 && (is_folder || has_extension(path, readable_extensions()));
    if (!may_be_model) return print_input(settings);
    const bool may_be_input = is_folder || has_extension(path, volume_extensions() + ' ' + tetrahedron_extensions());
    if (!may_be_input || is_block_folder(path)) return model();
    try {
        return print_input(settings);
    } catch (const Error& no_input) {
        if (no_input.code() != ErrorCode::kInput) throw;
        try {
            return model();
        } catch (const Error&) {
        }
        throw;
    }
}

}  // namespace

int run_info(const Settings& settings) {
    if (!settings.json.empty()) require_writable(settings.json, settings.writing);
    const std::string json = print_anything(settings);
    if (!settings.json.empty()) write_text(settings.json, json, settings.writing);
    return kGood;
}

}  // namespace regionmesh::cli
