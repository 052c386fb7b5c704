#include "blocks/begin_run.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "base/fingerprint.h"
#include "blocks/block_size.h"
#include "blocks/manifest.h"
#include "blocks/own_faces.h"
#include "blocks/survey.h"
#include "formats/input_file.h"
#include "formats/part_files.h"
#include "regionmesh/error.h"
#include "stream/plan.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"
#include "volume/room_reader.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// Sections of an input that has no name by which a run that goes on could tell it from another.
class FingerprintedSections final : public SectionReader {
public:
    explicit FingerprintedSections(std::unique_ptr<SectionReader> reader) : reader_(std::move(reader)) {}
    const VolumeInfo& info() const override { return reader_->info(); }
    bool next(std::span<InputLabel> section) override {
        if (!reader_->next(section)) return false;
        for (const InputLabel label : section) fingerprint_.add(static_cast<std::uint64_t>(label));
        return true;
    }
    void rewind() override {
        reader_->rewind();
        fingerprint_ = {};
    }
    /// Of the sections read so far.
    std::uint64_t fingerprint() const { return fingerprint_.value(); }

private:
    std::unique_ptr<SectionReader> reader_;
    Fingerprint fingerprint_;
};

/// Labels of the input and dense ones of two sections, and the row of a reader.
constexpr std::uint64_t kSurveyBytesPerSample = 2 * sizeof(InputLabel) + 2 * sizeof(Label);

/// The volume as it is asked for, and how it is surveyed. Refuses what blocks do not have.
struct Input {
    Input(const OpenSections& open, const ReconstructOptions& options) : file(open()) {
        if (!file) throw Error(ErrorCode::kUsage, "the function that opens the volume gives no reader");
        require_in_range(options);
        require_block_options(options);
        if (!file->info().can_rewind) {
            auto stream = std::make_unique<FingerprintedSections>(std::move(file));
            samples = stream.get();
            file = std::move(stream);
        }
        if (options.room > 0) cleaned.emplace(*file, options.room, options.threads);
        info = sections().info();
        require_lattice(info.source, info.lattice);
        require_cells(info);
        shape = section_shape(info, cell_kind(options), section_scale(info, options));
        is_in_place = can_crop(sections());
        survey.strips.cap = options.cap;
        survey.strips.cells = shape.cells;
        survey.background = options.background;
    }

    SectionReader& sections() { return cleaned ? static_cast<SectionReader&>(*cleaned) : *file; }

    /// Parts that are surveyed by themselves: for memory, and to share the work.
    std::vector<IndexBox> boxes(const ReconstructOptions& options, std::uint32_t processes) const {
        constexpr std::uint32_t kPartsPerProcess = 4;
        if (!is_in_place) return {};
        return survey_boxes(info, options.memory / 2 / kSurveyBytesPerSample,
                            processes > 1 ? processes * kPartsPerProcess : 1);
    }

    std::unique_ptr<SectionReader> file;
    const FingerprintedSections* samples = nullptr;  // `file`, where it is read in one pass
    std::optional<RoomReader> cleaned = {};
    VolumeInfo info = {};
    SourceShape shape = {};
    bool is_in_place = false;
    SurveyOptions survey = {};
};

/// A part of a survey on its way from the process that made it to the first: numbers of 64 bits. Its name says which
/// samples: a run that goes on may have another number of processes, or other --memory.
fs::path part_path(const fs::path& folder, const IndexBox& box) {
    return folder / fmt::format("{}{}-{}.part", kSurveyPart, fmt::join(box.low, "-"), fmt::join(box.high, "-"));
}

void write_part(const PartSurvey& part, const fs::path& path, const OutputOptions& options) {
    OutputFile file(path, options);
    file.write({reinterpret_cast<const char*>(&part.faces), sizeof part.faces});
    file.write({reinterpret_cast<const char*>(part.labels.data()), part.labels.size() * sizeof part.labels[0]});
    file.commit();
}

PartSurvey read_part(const fs::path& path) {
    const formats::InputFile file(path);
    PartSurvey part;
    if (file.size() < sizeof part.faces) formats::fail(path, "the file ends early; remove the folder, and run again");
    part.labels.resize((file.size() - sizeof part.faces) / sizeof part.labels[0]);
    const auto labels = std::as_writable_bytes(std::span(part.labels));
    if (file.read(0, std::as_writable_bytes(std::span(&part.faces, 1))) != sizeof part.faces ||
        file.read(sizeof part.faces, labels) != labels.size())
        formats::fail(path, "the file ends early; remove the folder, and run again");
    return part;
}

/// Surveys the boxes whose parts are not there, shared with other processes.
void survey_parts(const OpenSections& open, const std::vector<IndexBox>& boxes, const SurveyOptions& survey,
                  const BlockOptions& blocks, BlockTasks& tasks, const OnBlocks& on_progress) {
    const auto count = static_cast<std::uint32_t>(boxes.size());
    while (const auto task = tasks.next(count)) {
        const fs::path path = part_path(blocks.folder, boxes[*task]);
        if (!fs::exists(path)) write_part(survey_part(open, boxes[*task], survey), path, blocks.output);
        if (on_progress) on_progress({"read", *task + 1, count});
    }
    tasks.end_phase();
}

Survey join_parts(const Input& input, const std::vector<IndexBox>& boxes, const fs::path& folder) {
    std::vector<PartSurvey> parts;
    for (const IndexBox& box : boxes) parts.push_back(read_part(part_path(folder, box)));
    return join_surveys(input.info, input.survey.background, parts);
}

/// Reads the input from one end to the other, and copies what cannot be read in any order.
Survey survey_whole(Input& input, const BlockOptions& blocks, const OnBlocks& on_progress) {
    SurveyOptions survey = input.survey;
    survey.on_strip = [&](std::uint32_t done, std::uint32_t count) {
        if (on_progress) on_progress({"read", done, count});
    };
    if (input.is_in_place) return survey_sections(input.sections(), survey, nullptr);
    StagingFile copy(blocks.folder / kStagedLabels, blocks.output);
    Survey found = survey_sections(input.sections(), survey, &copy);
    copy.commit();
    return found;
}

void note_survey(const Survey& found, const Input& input, const ReconstructOptions& options,
                 const BlockOptions& blocks) {
    const VolumeInfo& info = input.info;
    Manifest manifest;
    manifest.identity = blocks.identity;
    manifest.is_surveyed = true;
    manifest.is_in_place = input.is_in_place;
    manifest.lattice = info.lattice;
    manifest.sweep = info.sweep;
    manifest.source = info.source;
    manifest.is_unsigned = found.labels.is_unsigned();
    manifest.label_count = found.labels.size();
    manifest.labels_hash = hash_of(found.labels);
    if (input.samples) manifest.samples_hash = input.samples->fingerprint();
    manifest.space = info.space;
    manifest.metres = info.metres;
    manifest.names = info.names;
    manifest.colours = info.colours;
    manifest.background = options.background;
    manifest.scale_z = input.shape.scale_z;
    manifest.initial_faces = found.faces;
    manifest.block_cells =
        blocks.block_cells > 0 ? blocks.block_cells : default_block_cells(input.shape, found.faces, options);
    require_block_count(info, manifest.block_cells);
    require_block_memory(info.source, input.shape, found.faces, manifest.block_cells, options);
    write_labels(found.labels, blocks.folder, blocks.output);
    write_manifest(manifest, blocks.folder, blocks.output);
}

void require_regions(const Survey& found, const Input& input, const ReconstructOptions& options) {
    std::uint32_t background = 0;
    for (const InputLabel label : std::set(options.background.begin(), options.background.end()))
        background += found.labels.find(label).has_value();
    const bool is_empty = background == found.labels.size(), is_one = !options.cap && found.faces == 0;
    if (!is_empty && !is_one) return;
    throw Error(ErrorCode::kInput,
                input.info.source + ": there is no region to model: " +
                    (is_empty ? "all of it is background; give another --background, or --no-background"
                              : "it has one label only, which has no face with --boundary open; give --boundary cap"));
}

/// Removes what a run writes before it makes pieces; the manifest last, so that nobody takes the rest for another's.
void remove_survey(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const std::string name = entry.path().filename(); name == kStagedLabels || name.starts_with(kSurveyPart))
            files.push_back(entry.path());
    files.push_back(manifest_path(folder));
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove(file, ignored);
}

/// Writes a manifest that says which run the folder belongs to.
void take_folder(const BlockOptions& blocks) {
    // A run that was killed here has left a part of its manifest.
    formats::remove_stale_parts(manifest_path(blocks.folder), false);
    const std::string part = formats::part_prefix(manifest_path(blocks.folder));
    for (const auto& entry : fs::directory_iterator(blocks.folder)) {
        if (entry.path().filename().string().starts_with(part)) continue;
        throw Error(ErrorCode::kOutput, blocks.folder.string() + ": holds other files; name an empty or a new folder");
    }
    Manifest manifest;
    manifest.identity = blocks.identity;
    write_manifest(manifest, blocks.folder, blocks.output);
}

/// Where a run goes on whose samples came in one pass: reads them once more.
void require_same_samples(Input& input, const Manifest& there, const fs::path& folder) {
    std::vector<InputLabel> section(std::size_t{input.file->section_width()} * input.file->section_height());
    for (std::uint32_t n = 0; n < input.file->section_count(); ++n)
        require_section(input.file->next(section), input.info, n);
    if (input.samples->fingerprint() != there.samples_hash)
        throw Error(ErrorCode::kInput, folder.string() + ": was begun with other samples than those of " +
                                           input.info.source + "; give what it was begun with, or another folder");
}

/// Takes the folder for this run, or finds that it belongs to it. Writes nothing for an input that cannot be read.
std::unique_ptr<FolderLock> enter_folder(const OpenSections& open, const ReconstructOptions& options,
                                         const BlockOptions& blocks, std::optional<Input>& input) {
    std::error_code missing;
    if (!fs::is_directory(blocks.folder, missing)) {
        input.emplace(open, options);
        make_folder(blocks.folder);
    }
    auto lock = std::make_unique<FolderLock>(blocks.folder);
    const auto there = read_manifest(blocks.folder);
    const bool is_surveyed = there && there->is_surveyed;
    if (!input && (!is_surveyed || there->samples_hash)) input.emplace(open, options);
    if (there)
        require_same_run(*there, blocks.identity, blocks.folder);
    else
        take_folder(blocks);
    if (is_surveyed && there->samples_hash) require_same_samples(*input, *there, blocks.folder);
    return lock;
}

}  // namespace

void require_block_options(const ReconstructOptions& options) {
    for (const auto& [is_given, name] :
         {std::pair{options.preserve_volume, "preserve-volume"}, std::pair{options.improve, "improve"},
          std::pair{options.smooth_lines, "smooth-lines"}})
        if (is_given)
            throw Error(ErrorCode::kUsage,
                        fmt::format("--{}: needs the whole surface at once, which a folder of pieces has not; leave it "
                                    "out, or name a file in --output",
                                    name));
    if (options.smooth.passes > 0 && !is_lattice(options.smooth.filter))
        throw Error(
            ErrorCode::kUsage,
            "--smooth-filter: blocks are smoothed inside the lattice or not at all; leave it out, or give none");
}

std::unique_ptr<FolderLock> begin_run(const OpenSections& open, const ReconstructOptions& options,
                                      const BlockOptions& blocks, BlockTasks& tasks, const OnBlocks& on_progress) {
    std::unique_ptr<FolderLock> lock;
    std::optional<Input> input;
    if (tasks.is_first()) lock = enter_folder(open, options, blocks, input);
    tasks.end_phase();
    if (read_manifest_together(blocks.folder, tasks).is_surveyed) return lock;
    if (!input) input.emplace(open, options);
    const std::vector<IndexBox> boxes = input->boxes(options, tasks.processes());
    bool others_write = boxes.size() > 1 && tasks.processes() > 1;  // parts of the survey
    try {
        if (boxes.size() > 1) survey_parts(open, boxes, input->survey, blocks, tasks, on_progress);
        others_write = false;
        if (tasks.is_first()) {
            const Survey found =
                boxes.size() > 1 ? join_parts(*input, boxes, blocks.folder) : survey_whole(*input, blocks, on_progress);
            require_regions(found, *input, options);
            require_unchanged(blocks);
            note_survey(found, *input, options, blocks);
        }
    } catch (const Error& error) {
        // As if the input had been refused at once: another run may want the folder for other options.
        if (tasks.is_first() && !others_write && error.code() != ErrorCode::kOutput) remove_survey(blocks.folder);
        throw;
    }
    tasks.end_phase();
    return lock;
}

void require_unchanged(const BlockOptions& blocks) {
    if (!blocks.find_identity) return;
    const RunIdentity now = blocks.find_identity();
    const auto [was, is] = std::ranges::mismatch(blocks.identity, now);
    if (was == blocks.identity.end() && is == now.end()) return;
    const std::string& name = was != blocks.identity.end() ? was->first : is->first;
    throw Error(ErrorCode::kInput, blocks.folder.string() + ": " + name +
                                       " changed while it was read; run again when nothing writes to it");
}

Manifest read_manifest_together(const fs::path& folder, BlockTasks& tasks) {
    const Manifest manifest = require_manifest(folder);
    tasks.end_phase();
    return manifest;
}

}  // namespace regionmesh
