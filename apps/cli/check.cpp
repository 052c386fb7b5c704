#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"
#include "regionmesh/blocks.h"

namespace regionmesh::cli {
namespace {

constexpr int kListed = 3;  // findings printed of each kind; the JSON has up to CheckOptions::listed

/// The volume that the model was made from, with the sections that were put between, and the labels that --room or
/// --denoise gave. A model says how far its samples lie apart: it was made as they tell, unless --between says
/// otherwise.
std::unique_ptr<SectionReader> open_modelled(const Settings& given, const MeshFile& file) {
    Settings settings = given;
    const auto& spacing = file.coordinates.spacing;
    const bool is_piped = std::ranges::find(given.sections, "-") != given.sections.end();
    if (spacing && !is_piped && !given_text(given, "between") && kind_of_input(given.sections) == kVolumeInput) {
        const auto made = between_of_model(open_volume(given, given.sections)->info().lattice, *spacing);
        settings.prepare.between = made ? made->between : 0;
        constexpr SweepChoice kAlong[] = {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};
        if (made) settings.volume.sweep = kAlong[made->axis];
    }
    return modelled_sections(open_prepared_volume(settings, settings.sections).reader, settings.reconstruct);
}

void print_findings(const std::string& name, const CheckReport& report, bool is_verbose) {
    say("{}: {}, {} with an interface, {} inside, lowest quality {:.3f}, mean {:.3f}", printable(name),
        counted(report.regions.size(), "region"), counted(report.region_pairs, "pair"),
        counted(report.quadruple_points_inside, "quadruple point"), report.quality.min, report.quality.mean);
    print_shapes(report, is_verbose);
    if (report.regions.empty()) say("it has no regions: nothing was checked");
    print_violations(report, kListed);
    if (report.violation_count() == 0) say("no violations");
    print_orient_hint(report);
}

/// Whether there are samples, and regions that have an inside.
bool has_samples(const Settings& settings) {
    return settings.reconstruct.cap && !settings.sections.empty() && is_lattice(settings, settings.sections);
}

/// Sections are read for the labels, and again where there are samples to compare.
void require_readable_twice(const Settings& settings) {
    for (const std::string& file : settings.sections)
        if (file == "-" && has_samples(settings))
            throw Error(ErrorCode::kUsage,
                        "--sections -: the sections are read twice, and standard input can be read once; name a file");
}

std::optional<SampleAgreement> compare_with_sections(const Settings& settings, MeshFile& file,
                                                     const CheckOptions& options) {
    if (!has_samples(settings)) return {};
    const auto reader = open_modelled(settings, file);
    return compare_samples(file.mesh, file.labels, options.background, *reader, options.threads);
}

/// Labels on faces of the model that the sections do not have, as text; empty where there are none.
std::string labels_without_samples(const MeshFile& file, const Census& census, const std::vector<Label>& background) {
    constexpr std::size_t kNamed = 5;
    std::set<InputLabel> there, absent;
    for (Label label = 0; label < census.labels.size(); ++label) there.insert(census.labels.input(label));
    for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f) {
        if (!file.mesh.is_alive(FaceId{f})) continue;
        for (const Label label : file.mesh[FaceId{f}].labels)
            if (!is_exterior(label) && std::ranges::find(background, label) == background.end() &&
                !there.contains(file.labels.input(label)))
                absent.insert(file.labels.input(label));
    }
    std::string text;
    std::size_t named = 0;
    for (const InputLabel label : absent)
        if (named++ < kNamed) text += (text.empty() ? "" : ", ") + file.labels.text(label);
    return absent.size() > kNamed ? text + " and " + grouped(absent.size() - kNamed) + " more" : text;
}

/// Points of the model along the axes of the lattice, from its first sample.
Box along_lattice(const Mesh& mesh, const Lattice& lattice) {
    Box box;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        const Vec3 p = mesh.position(VertexId{v}) - lattice.origin;
        Vec3 turned;
        for (int axis = 0; axis < 3; ++axis)
            for (int k = 0; k < 3; ++k) turned[axis] += lattice.direction[3 * k + axis] * p[k];
        box.add(turned);
    }
    return box;
}

/// Says, before all violations, that the sections cannot be those that the model was made from.
void print_misfit(const Settings& settings, const MeshFile& file, const SectionReader& reader, const Census& census,
                  const std::vector<Label>& background) {
    const std::string source = printable(settings.sections.front());
    const Lattice& lattice = reader.info().lattice;
    const Box box = along_lattice(file.mesh, lattice);
    std::string beyond;
    for (int axis = 0; axis < 3; ++axis) {
        const double last = lattice.spacing[axis] * (lattice.size[axis] - 1.0), room = lattice.spacing[axis];
        if (box.low[axis] < -room || box.high[axis] > last + room)
            beyond += fmt::format("{}{} from {:.6g} to {:.6g} and the samples from 0 to {:.6g}",
                                  beyond.empty() ? "" : ", ", "xyz"[axis], box.low[axis], box.high[axis], last);
    }
    if (!beyond.empty())
        say("the extents do not fit: from the first sample of {} the model reaches along {}; is this the scan that it "
            "was made from?",
            source, beyond);
    if (const std::string absent = labels_without_samples(file, census, background); !absent.empty())
        say("the labels do not fit: {} has no sample of {}; is this the scan that the model was made from?", source,
            absent);
}

/// What the labels of the input say, of either kind. Warns where it is in another unit of length than the model.
std::optional<LabelOracle> oracle_of(const Settings& settings, MeshFile& file, const std::vector<Label>& background) {
    if (settings.sections.empty()) return {};
    const auto oracle_from = [&](auto& reader) {
        warn_of_units(settings.models.front(), file.coordinates.metres, settings.sections.front(),
                      reader.info().metres);
        const auto counted = count_labels(reader, census_options(settings));
        if constexpr (requires { reader.info().lattice; }) print_misfit(settings, file, reader, counted, background);
        return relabelled(counted.oracle, counted.labels, file.labels);
    };
    if (is_lattice(settings, settings.sections)) return oracle_from(*open_modelled(settings, file));
    return oracle_from(*open_unstructured(settings, settings.sections));
}

/// Is the background of the volume the exterior of the model?
bool has_exterior_for_background(const Settings& settings, const MeshFile& file) {
    const auto& background = settings.reconstruct.background;
    return !settings.sections.empty() && is_lattice(settings, settings.sections) && !background.empty() &&
           lacks_background(file, settings.models.front(), background.front());
}

/// Piece by piece: memory never holds the model.
int check_folder(const Settings& given) {
    const std::string& path = given.models.front();
    require_fit_of_folder(path, given.surface);
    MeshFile file = describe_block_folder(path);
    Settings settings = settings_for(given, file);
    refuse_prepared_blocks(settings);
    settings.prepare = {};
    CheckOptions options = check_options(settings, file.labels);
    std::optional<SampleAgreement> samples;
    if (!settings.sections.empty()) {
        const auto reader = open_modelled(settings, file);
        warn_of_units(path, file.coordinates.metres, settings.sections.front(), reader->info().metres);
        const Census census = count_labels(*reader, census_options(settings));
        options.oracle = relabelled(census.oracle, census.labels, file.labels);
        if (!has_lattice_of(path, reader->info()))
            throw Error(ErrorCode::kInput, settings.sections.front() + ": its samples do not lie where those of " +
                                               path + " do; give the volume that the model was made from");
        if (has_samples(settings)) samples = compare_block_samples(path, file.labels, options.background, *reader);
    }
    const CheckReport report = check_block_folder(path, options);
    if (!settings.json.empty())
        write_text(settings.json,
                   check_json(report, file.labels, file.names, samples ? &*samples : nullptr, file.coordinates.metres),
                   settings.writing);
    print_findings(path, report, settings.verbose);
    if (samples) say("{}", samples_text(*samples, settings.reconstruct.room > 0));
    return exit_code(report);
}

/// Whether the whole model is asked for: its page or its tables.
bool needs_whole(const Settings& settings) {
    return !settings.html.empty() || !settings.regions.empty() || !settings.interfaces.empty() ||
           !settings.lines.empty();
}

}  // namespace

int run_check(const Settings& given) {
    if (given.sections.empty())
        require_no_input_options(given);
    else
        require_fit(given, given.sections);
    require_readable_twice(given);
    require_page(given.html, given.writing);
    const std::string& path = given.models.front();
    for (const std::string& file : {given.json, given.regions, given.interfaces, given.lines})
        if (!file.empty()) require_writable(file, given.writing);
    if (is_block_folder(path) && !needs_whole(given)) return check_folder(given);
    MeshFile file = read_model(path, given.surface);
    if (has_exterior_for_background(given, file)) {
        const auto reader = open_volume(settings_for(given, file), given.sections);
        restore_background(file, reader->info().lattice, given.reconstruct.background.front());
    }
    const Settings settings = settings_for(given, file);
    CheckOptions options = check_options(settings, file.labels);
    options.oracle = oracle_of(settings, file, options.background);
    const CheckReport report = check(file.mesh, options);
    const auto samples = compare_with_sections(settings, file, options);
    const std::string json =
        check_json(report, file.labels, file.names, samples ? &*samples : nullptr, file.coordinates.metres);
    OutputFiles files(settings.writing);
    if (!settings.json.empty()) files.add(settings.json).write(json);
    const Model model{file.mesh, file.labels, options.background, file.names, file.colours, file.coordinates};
    write_tables(settings, model, files);
    if (!settings.html.empty())
        write_page(settings.html, {page_model(path, model)},
                   page_options(kCheck, settings, json, options.oracle.has_value()), files);
    files.commit();
    print_findings(path, report, settings.verbose);
    if (samples) say("{}", samples_text(*samples, settings.reconstruct.room > 0));
    return exit_code(report);
}

}  // namespace regionmesh::cli
