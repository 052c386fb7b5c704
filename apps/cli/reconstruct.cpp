#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "advice.h"
#include "blocks.h"
#include "commands.h"
#include "input.h"
#include "memory_watch.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"
#include "progress_line.h"

namespace regionmesh::cli {
namespace {

void print_volumes(const PreserveReport& preserved) {
    if (preserved.rounds == 0) return;
    say_more("largest relative error of a region's volume {:.1e}; before the correction {:.1e}", preserved.drift,
             preserved.drift_before);
    if (preserved.regions_off > 0)
        say("{} with a volume error above {:.0e}", counted(preserved.regions_off, "region"), kVolumeTolerance);
}

/// The faces that topology or --max-error leave are not known before the work, nor are those of standard input.
void print_memory(const ReconstructOptions& options, const Report& report) {
    const auto is_far_above = [](std::uint64_t used, std::uint64_t limit) { return used > limit + limit / 10; };
    if (options.face_budget) {
        if (is_far_above(report.peak_faces, *options.face_budget))
            say("held {} faces, more than --face-budget {}: it is below what the target, topology or --max-error leave",
                grouped(report.peak_faces), grouped(*options.face_budget));
    } else if (is_far_above(report.peak_bytes, options.memory)) {
        const bool is_held = report.stopped == StopReason::kTopology || report.stopped == StopReason::kMaxError;
        say("used more than --memory, {} MB: {}", grouped(options.memory / 1000000),
            is_held ? "the faces left by topology or --max-error are not known before the work"
                    : "this surface takes more than the plan counts for one of so many faces");
    }
}

/// For --verbose and the log.
void print_details(const Report& report) {
    const CheckReport& check = report.check;
    const SmoothReport& smoothing = report.smoothing;
    if (smoothing.vertices > 0)
        say_more("smoothing: {}, largest displacement {:.3g}", counted(smoothing.vertices, "vertex") + " moved",
                 smoothing.largest_displacement);
    say_more("topology: {} with an interface, {} inside", counted(check.region_pairs, "pair"),
             counted(check.quadruple_points_inside, "quadruple point"));
    if (report.pinned_vertices > 0)
        say_more("{} not moved: the mesh touches itself there, or more than four regions meet",
                 counted(report.pinned_vertices, "vertex"));
    std::string refused;
    for (int n = 0; n < kVerdictCount; ++n)
        if (report.verdicts[n] > 0)
            refused +=
                fmt::format("{}{} {}", refused.empty() ? "" : ", ", kVerdictNames[n], grouped(report.verdicts[n]));
    if (!refused.empty()) say_more("edges tried: {}", refused);
    std::string stages;
    for (const auto& [stage, seconds] : report.seconds)
        if (stage != "total") stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", stage, seconds);
    say_more("seconds: {}", stages);
    say_more("speed: {:.0f} k faces/s; most faces held {}",
             static_cast<double>(report.initial_faces) / 1e3 / std::max(report.seconds.at("total"), 1e-9),
             grouped(report.peak_faces));
}

/// The files of the run: "m.vtp, report r.json, page p.html".
std::string files_text(const Settings& settings) {
    std::string text = output_text(settings);
    if (!settings.report.empty()) text += ", report " + printable(settings.report);
    for (const std::string* table : {&settings.regions, &settings.interfaces, &settings.lines})
        if (!table->empty()) text += ", table " + printable(*table);
    if (!settings.html.empty()) text += ", page " + printable(settings.html);
    return text;
}

/// What needs attention first; then three lines: what was made, what was proved, where it lies.
void print_summary(const Settings& settings, const Reconstruction& made, const std::optional<double>& metres) {
    const Report& report = made.report;
    const CheckReport& check = report.check;
    print_details(report);
    print_remeshed(report);
    print_smoothed_lines(report);
    print_floor(report);
    print_improved(report);
    print_stop(settings, report);
    print_volumes(report.preserved);
    print_memory(settings.reconstruct, report);
    print_violations(check, 0);
    print_denoised(report.denoise);
    if (report.samples_in_room > 0)
        say("{} changed the label within --room", counted(report.samples_in_room, "sample"));
    say("made: {}, {}, {} (from {} faces); quality lowest {:.3f}, mean {:.3f}{}",
        counted(check.regions.size(), "region"), counted(report.final_faces, "face"),
        counted(report.final_vertices, "vertex"), grouped(report.initial_faces), check.quality.min, check.quality.mean,
        background_text(settings, made));
    print_certificate(report, metres);
    say("written: {}; {:.2f} s, {} MB of memory", files_text(settings), report.seconds.at("total"),
        grouped(report.peak_bytes / 1000000));
}

/// Says once, while there is time to stop, that the run will need more than --memory. A hard limit ends it by itself.
class MemoryWarning {
public:
    explicit MemoryWarning(const Settings& settings) : settings_(settings) {}

    void show(const Progress& progress) {
        if (is_shown_ || settings_.memory_is_hard || progress.bytes_needed == 0) return;
        is_shown_ = true;
        warn(fmt::format(
            "topology, --max-error or an input that is read only once leave more faces than --memory {} MB has room "
            "for: the run may need {} MB; raise --memory, or end such runs with --memory-limit hard",
            grouped(settings_.reconstruct.memory / 1000000), grouped(progress.bytes_needed / 1000000)));
    }

private:
    const Settings& settings_;
    bool is_shown_ = false;
};

void print_sections(const PreparedSections& made) {
    if (made.sections_moved > 0)
        say("sections: {} moved in their plane, by up to {:.1f} samples (--align)",
            counted(made.sections_moved, "section"), made.largest_shift);
    if (made.between == 0) return;
    const std::string why = made.pairs > 0 ? fmt::format(" (--between auto: of {} matching parts, {} do not overlap)",
                                                         counted(made.pairs, "pair") + " of", grouped(made.pairs_apart))
                                           : "";
    say("sections: {} put between each two of the input{}", made.between, why);
}

/// What the input says besides its samples.
struct ModelNotes {
    Described labels;
    Coordinates coordinates = {};
    PreparedSections sections = {};
};

/// Reconstructs the input, whichever kind it is of. Sets `notes` to what it says about its labels and its coordinates,
/// before the model is handed on.
Reconstruction reconstruct_input(const Settings& settings, ModelNotes& notes, const OnModel& on_model) {
    ProgressLine line(settings.quiet);
    MemoryWarning memory(settings);
    HeldWarnings warnings;  // until the input is counted
    const auto make = [&](auto& reader) {
        const std::string warned = reader.info().warning;
        LabelColours colours;
        if constexpr (requires { reader.info().colours; }) colours = reader.info().colours;
        notes.labels = describe(settings, reader.info().names, colours);
        notes.coordinates = with_units_and_space(settings, coordinates_of(reader.info()));
        warn_of_grey_scale(settings, reader);
        if constexpr (requires { reader.info().lattice; })
            warn_of_same_smoothing(settings, reader.info().lattice.spacing);
        const auto on_progress = [&](const Progress& progress) {
            if (const std::string_view stage = progress.stage; stage != "count" && stage != "denoise") warnings.show();
            memory.show(progress);
            line.show(progress);
        };
        ReconstructOptions options = settings.reconstruct;
        if constexpr (requires { reader.info().lattice; })
            options = with_free_target(settings, reader.info().lattice.spacing);
        Reconstruction made = reconstruct(reader, options, on_progress, on_model);
        if (options.free_error > 0) made.report.stopped = StopReason::kNoneAsked;
        line.clear();
        warnings.show();
        warn_of_rest(reader, warned);
        return made;
    };
    require_fit(settings, settings.inputs);
    if (!is_lattice(settings, settings.inputs)) return make(*open_unstructured(settings, settings.inputs));
    notes.sections = open_prepared_volume(settings, settings.inputs);
    print_sections(notes.sections);
    Reconstruction made = make(*notes.sections.reader);
    if (const auto overlaps = notes.sections.reader->info().overlaps) made.report.overlaps = *overlaps;
    made.report.sections_between = notes.sections.between;
    made.report.sections_moved = notes.sections.sections_moved;
    made.report.largest_section_shift = notes.sections.largest_shift;
    return made;
}

/// A sample that has another label in the model than in the input, by its number with x fastest, then y.
struct ChangedSample {
    std::uint64_t number;
    InputLabel label;
};

std::vector<ChangedSample> changed_samples(const Settings& settings) {
    const auto given = open_prepared_volume(settings, settings.inputs).reader;
    const auto modelled =
        modelled_sections(open_prepared_volume(settings, settings.inputs).reader, settings.reconstruct);
    const auto& axes = given->info().sweep.axes;
    const auto& size = given->info().lattice.size;
    const std::array<std::uint64_t, 3> steps{1, size[0], std::uint64_t{size[0]} * size[1]};
    const auto step = [&](std::size_t axis) { return steps[static_cast<std::size_t>(axes[axis])]; };
    std::vector<InputLabel> before(std::size_t{given->section_width()} * given->section_height()), after(before.size());
    std::vector<ChangedSample> changed;
    for (std::uint64_t s = 0; given->next(before) && modelled->next(after); ++s)
        for (std::uint64_t n = 0; n < before.size(); ++n)
            if (before[n] != after[n])
                changed.push_back(
                    {n % given->section_width() * step(0) + n / given->section_width() * step(1) + s * step(2),
                     after[n]});
    std::ranges::sort(changed, {}, &ChangedSample::number);
    return changed;
}

/// The volume that was modelled. It is written along z, and was changed along the sweep of the model.
void write_modelled_labels(const Settings& settings) {
    const std::vector<ChangedSample> changed = changed_samples(settings);
    Settings along_z = settings;
    along_z.volume.sweep = SweepChoice::kZ;
    const auto reader = open_prepared_volume(along_z, settings.inputs).reader;
    const VolumeInfo& info = reader->info();
    if (info.sweep.axes[2] != 2)
        throw Error(ErrorCode::kUsage,
                    "--write-labels: sections were put between others that do not lie along z; give "
                    "--between off");
    const auto writer = create_volume(settings.write_labels, info.lattice, coordinates_of(info), info.type,
                                      settings.writing, info.type == SampleType::kU64);
    std::vector<InputLabel> section(std::size_t{reader->section_width()} * reader->section_height());
    auto next = changed.begin();
    for (std::uint64_t first = 0; reader->next(section); first += section.size()) {
        for (; next != changed.end() && next->number < first + section.size(); ++next)
            section[next->number - first] = next->label;
        writer->write(section);
    }
    writer->commit();
}

}  // namespace

int run_reconstruct(const Settings& settings) {
    if (writes_blocks(settings)) return run_blocks(settings);
    if (has_other_processes())
        throw Error(ErrorCode::kUsage, "--output " + settings.output +
                                           ": processes share the blocks of a folder; name one with a / at its end, or "
                                           "give --block-size");
    require_outputs(settings);
    std::optional<MemoryWatch> watch;
    if (settings.memory_is_hard) watch.emplace(settings.reconstruct.memory);
    ModelNotes notes;
    const auto& [names, colours] = notes.labels;
    OutputFiles files(model_writing(settings));
    std::vector<std::filesystem::path> written;
    double writing = 0;
    const auto write = [&](const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background) {
        if (mesh.face_count() == 0) return;  // no region, which is refused after the check
        put_line(Audience::kLog, "write");
        const Timer timer(writing);
        written = write_model(settings, {mesh, labels, background, names, colours, notes.coordinates}, files);
    };
    Reconstruction made = reconstruct_input(settings, notes, write);
    require_regions(settings, made.report.check);
    warn_of_absent_labels(settings, made.mesh, made.labels);
    if (is_lattice(settings, settings.inputs)) warn_of_passes(settings);
    Report& report = made.report;
    report.seconds["write"] = writing;
    const Model model{made.mesh, made.labels, made.background, names, colours, notes.coordinates};
    write_report_and_page(kReconstruct, settings, report, model, files);
    files.commit();
    if (!settings.write_labels.empty()) write_modelled_labels(settings);
    print_region_files(settings, written);
    warn_of_overlaps(report.overlaps, made.labels, names);
    print_summary(settings, made, notes.coordinates.metres);
    return exit_code(report);
}

}  // namespace regionmesh::cli
