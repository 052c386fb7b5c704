#include "blocks.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "memory_watch.h"
#include "messages.h"
#include "output.h"
#include "printable.h"
#include "progress_line.h"

namespace regionmesh::cli {
namespace {

namespace fs = std::filesystem;

BlockTasks* shared_tasks = nullptr;

std::vector<fs::path> made;  // see made_folders()

/// Options that do not change the model: a run may go on with others.
constexpr std::array<std::string_view, 13> kFree{"input",   "output",     "threads",        "memory", "memory-limit",
                                                 "log",     "quiet",      "verbose",        "config", "force",
                                                 "no-sync", "no-sandbox", "require-sandbox"};

/// Options of a model in one file.
constexpr std::array<std::string_view, 9> kOneFile{"report",     "html",        "regions", "interfaces",   "lines",
                                                   "per-region", "face-budget", "units",   "preview-faces"};

/// Options of convert that need the whole model, or change it.
constexpr std::array<std::string_view, 9> kOfWholeModels{
    "regions", "interfaces", "lines", "per-region", "background", "no-background", "weld", "orient", "space"};

/// The folder that --output names, without a / at its end.
fs::path folder_of(const std::string& output) {
    const fs::path path = output;
    return path.has_filename() ? path : path.parent_path();
}

/// FNV-1a: the same in every build.
std::uint64_t hash_of(std::string_view text) {
    std::uint64_t hash = 0xCBF29CE484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
    return hash;
}

/// "82131 bytes, changed 2023-11-14 22:13:20.500000000 UTC": a file that differs is another input. Of what is in a
/// folder, `own` is left out: the canonical paths of what the run writes.
std::string state_of(const fs::path& path, const std::vector<fs::path>& own = {}) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return "missing";
    if (!S_ISDIR(status.st_mode))
        return fmt::format("{} bytes, changed {:%F %T}.{:09} UTC", status.st_size, fmt::gmtime(status.st_mtim.tv_sec),
                           status.st_mtim.tv_nsec);
    std::uint64_t files = 0, bytes = 0, states = 0;
    std::error_code ignored;
    const fs::path root = own.empty() ? path : fs::weakly_canonical(path, ignored);
    for (fs::recursive_directory_iterator at(root, ignored), end; at != end; at.increment(ignored)) {
        const bool is_own = std::ranges::find(own, at->path()) != own.end();
        if (is_own) at.disable_recursion_pending();
        if (is_own || !at->is_regular_file(ignored)) continue;
        ++files;
        bytes += at->file_size(ignored);
        states += hash_of(at->path().lexically_relative(root).string() + ' ' + state_of(at->path()));
    }
    return fmt::format("{} files, {} bytes, state {:016x}", files, bytes, states);
}

/// A hash of what is in a file, up to a size that takes no time to read: a header, a table. Empty for others.
std::string content_of(const fs::path& path) {
    constexpr std::uintmax_t kMostBytes = 1 << 20;
    std::error_code missing;
    if (!fs::is_regular_file(path, missing) || fs::file_size(path, missing) > kMostBytes || missing) return {};
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return fmt::format(", content {:016x}", hash_of(text));
}

/// What a volume in files says besides its samples; some of it comes from files beside or above its own.
std::optional<VolumeInfo> info_of_volume(const Settings& settings) {
    if (kind_of_input(settings.inputs) != kVolumeInput || settings.inputs.front() == "-") return {};
    Settings whole = settings;
    whole.volume.select = {};  // which may read samples
    whole.volume.merge_table.clear();
    return open_lattice(whole, whole.inputs)->info();
}

std::string lattice_text(const VolumeInfo& info) {
    const Lattice& lattice = info.lattice;
    const auto text = [](const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
    return fmt::format("{} samples, spacing {}, origin {}, axes {}, space '{}', {} m a unit, sweep {}",
                       fmt::join(lattice.size, " x "), text(lattice.spacing), text(lattice.origin),
                       fmt::join(lattice.direction, " "), space_name(info.space), info.metres.value_or(0),
                       fmt::join(info.sweep.axes, " "));
}

std::string text_of(const LabelNames& names, const LabelColours& colours) {
    std::string all;
    for (const auto& [label, name] : names) all += fmt::format("{}={}\n", label, name);
    for (const auto& [label, colour] : colours) all += fmt::format("{}#{:06x}\n", label, colour);
    return fmt::format("{}, {}, state {:016x}", counted(names.size(), "name"), counted(colours.size(), "colour"),
                       hash_of(all));
}

/// What must stay the same: the states of inputs, of the files of samples that they name, and of files that options
/// name; the lattice; the names of labels, unless an option gives them; the values of other options.
RunIdentity identity_of(const Settings& settings) {
    RunIdentity identity{{"version", REGIONMESH_VERSION}};
    std::error_code ignored;
    std::vector<fs::path> own{fs::weakly_canonical(folder_of(settings.output), ignored)};
    if (!settings.log.empty()) own.push_back(fs::weakly_canonical(settings.log, ignored));
    const auto add = [&](const std::string& name, const fs::path& path, const std::string& inside = "") {
        identity.emplace_back(
            name, fmt::format("{}{}, {}{}", path.filename().string(), inside, state_of(path, own), content_of(path)));
    };
    for (std::size_t n = 0; n < settings.inputs.size(); ++n) {
        const fs::path file = file_of_input(settings.inputs[n]);
        add(fmt::format("input {}", n + 1), file, settings.inputs[n].substr(file.string().size()));
    }
    if (const auto info = info_of_volume(settings)) {
        for (std::size_t n = 0; n < info->files.size(); ++n) add(fmt::format("samples {}", n + 1), info->files[n]);
        identity.emplace_back("lattice", lattice_text(*info));
        if (settings.names.empty())
            identity.emplace_back("names in or beside the input", text_of(info->names, info->colours));
    }
    for (const auto& [name, text] : settings.given) {
        if (std::ranges::find(kFree, name) != kFree.end()) continue;
        if (find_option(name)->kind == OptionKind::kFile && fs::exists(text))
            add("--" + name, text);
        else
            identity.emplace_back("--" + name, text);
    }
    return identity;
}

/// A folder that is not there yet and would be called model.vtp is not what was meant.
void require_folder_name(const std::string& output) {
    std::error_code missing;
    if (output.ends_with('/') || !has_extension(output, writable_extensions()) || fs::is_directory(output, missing))
        return;
    throw Error(ErrorCode::kUsage, "--output " + output +
                                       ": blocks are written into a folder; name one, put a / at its end, or leave out "
                                       "--block-size");
}

void require_fit_of_blocks(const Settings& settings) {
    refuse_options(settings, kOneFile,
                   "is for a model in one file, and --output is a folder of pieces; leave it out, and give the folder "
                   "to regionmesh convert or check");
    require_block_options(settings.reconstruct);
    refuse_prepared_blocks(settings);
    if (settings.inputs.front() == "-" && shared_tasks && shared_tasks->processes() > 1)
        throw Error(ErrorCode::kUsage, "standard input: one process alone can read it; name a file");
    require_fit(settings, settings.inputs);
    if (!is_lattice(settings, settings.inputs))
        throw Error(ErrorCode::kUsage,
                    settings.inputs.front() + ": blocks are for sections; name a file for the model in --output");
}

void note_missing(const std::vector<fs::path>& folders) {
    std::error_code missing;
    for (const fs::path& folder : folders)
        if (!fs::exists(folder, missing)) made.push_back(folder);
}

/// The volume, with the names that --names gives.
std::unique_ptr<SectionReader> open_described(const Settings& settings) {
    auto reader = open_volume(settings, settings.inputs);
    VolumeInfo info = reader->info();
    auto [names, colours] = describe(settings, info.names, info.colours);
    info.names = std::move(names);
    info.colours = std::move(colours);
    return describe_sections(std::move(reader), std::move(info));
}

void print_summary(const Settings& settings, const BlockReport& report) {
    if (report.stopped == StopReason::kTopology || report.stopped == StopReason::kMaxError)
        say("decimation ended by {}, with {}",
            report.stopped == StopReason::kTopology ? "topology or quality" : "--max-error",
            counted(report.final_faces, "face"));
    say("made: {}, {} (from {} faces), in {} of up to {} cells; {} made{} and {} found complete",
        counted(report.final_faces, "face"), counted(report.final_vertices, "vertex"), grouped(report.initial_faces),
        counted(report.pieces, "piece"), report.block_cells, counted(report.made, "block"),
        has_other_processes() ? " by this process" : "", report.found);
    Report checked;
    checked.check = report.check;
    checked.samples = report.samples;
    checked.samples_in_room = settings.reconstruct.room > 0;
    checked.denoise = report.denoise;
    print_violations(report.check, 0);
    print_denoised(report.denoise);
    print_certificate(checked, std::nullopt);
    if (!report.samples && settings.reconstruct.cap)
        say("samples not compared: they are no longer there, or a section does not fit in --memory; regionmesh check "
            "--sections does it");
    say("written: {}; {:.2f} s, {} MB of memory", printable(settings.output), report.seconds,
        grouped(report.peak_bytes / 1000000));
}

}  // namespace

bool writes_blocks(const Settings& settings) {
    return settings.block_cells || settings.output.ends_with('/') || is_block_folder(settings.output);
}

bool is_written_in_pieces(const Settings& settings) {
    return folder_of(settings.output).extension() == ".pvtp" ||
           (is_precomputed(settings.output) && is_block_folder(settings.models.front()));
}

bool is_precomputed(const std::string& output) { return folder_of(output).extension() == ".precomputed"; }

void require_fit_of_pieces(const Settings& settings) {
    const std::string& folder = settings.models.front();
    if (!is_block_folder(folder))
        throw Error(ErrorCode::kUsage, settings.output + ": is written from a folder of pieces, and " + folder +
                                           " is none; name a model such as model.vtp");
    refuse_options(settings, kOfWholeModels,
                   "is not for " + settings.output +
                       ", which is written piece by piece; leave it out, or name a model such as model.vtp");
}

void make_block_folder(const Settings& settings, std::uint32_t command) {
    if (settings.output.empty()) return;
    const fs::path folder = folder_of(settings.output);
    const bool is_model = !settings.inputs.empty() && writes_blocks(settings);
    const bool is_for_viewer = command == kConvert && is_precomputed(settings.output);
    if (!is_model && !is_for_viewer) return;
    if (is_model) require_fit_of_blocks(settings);
    for (const std::vector<std::string>* files : {&settings.inputs, &settings.models})
        for (const std::string& file : *files)
            if (std::error_code missing;
                !(file == "-" && is_model) && file.find(':') == std::string::npos && !fs::exists(file, missing))
                return;  // the command says so, and leaves nothing behind
    if (is_for_viewer) {
        const std::string& model = settings.models.front();
        if (is_written_in_pieces(settings))
            require_fit_of_pieces(settings);
        else if (!fs::is_directory(model) && !has_extension(model, readable_extensions()))
            return;
        note_missing({folder, folder / "names"});
        return make_precomputed_folder(folder);
    }
    require_folder_name(settings.output);
    note_missing({folder});
    make_folder(folder);
}

const std::vector<fs::path>& made_folders() { return made; }

void remove_empty_folders() {
    std::error_code ignored;  // of those that are not empty
    for (auto folder = made.rbegin(); folder != made.rend(); ++folder) fs::remove(*folder, ignored);
}

void share_blocks(BlockTasks& tasks) { shared_tasks = &tasks; }

bool has_other_processes() { return shared_tasks != nullptr; }

void silence_others(Settings& settings) {
    if (!shared_tasks || shared_tasks->is_first()) return;
    settings.quiet = true;
    settings.verbose = false;
    settings.log.clear();
}

int run_blocks(const Settings& settings) {
    BlockTasks alone;
    BlockTasks& tasks = shared_tasks ? *shared_tasks : alone;
    std::optional<MemoryWatch> watch;
    if (settings.memory_is_hard) watch.emplace(settings.reconstruct.memory, true);
    const BlockOptions blocks{.folder = folder_of(settings.output),
                              .block_cells = settings.block_cells.value_or(0),
                              .identity = identity_of(settings),
                              .find_identity = [&] { return identity_of(settings); },
                              .output = settings.writing};
    ProgressLine line(settings.quiet || !tasks.is_first());
    const BlockReport report = reconstruct_blocks(
        [&] { return open_described(settings); }, settings.reconstruct, blocks, tasks,
        [&](const BlockProgress& progress) {
            Progress shown;
            shown.stage = progress.stage;
            shown.strips_read = progress.done;
            shown.strip_count = progress.count;
            shown.share = progress.count > 0 ? static_cast<double>(progress.done) / progress.count : 0;
            line.show(shown);
        });
    line.clear();
    if (!tasks.is_first()) return kGood;
    warn_of_passes(settings);
    const std::optional<VolumeInfo> info = info_of_volume(settings);
    if (!settings.prepare.between && info && far_axis(info->lattice))
        say_more("sections: none put between others (--between auto): blocks are made of the sections as they are");
    print_summary(settings, report);
    const bool has_lost = settings.reconstruct.keep_samples && report.samples && report.samples->wrong > 0;
    return has_lost ? kViolations : exit_code(report.check);
}

}  // namespace regionmesh::cli
