#include "blocks/begin_run.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "base/megabytes.h"
#include "blocks/block_size.h"
#include "blocks/fingerprinted_sections.h"
#include "blocks/manifest.h"
#include "blocks/own_faces.h"
#include "blocks/survey.h"
#include "blocks/survey_parts.h"
#include "formats/input_file.h"
#include "formats/part_files.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "stream/footprint.h"
#include "stream/plan.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"
#include "volume/room_reader.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

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
        clean(options);
        info = sections().info();
        require_lattice(info.source, info.lattice);
        require_cells(info);
        shape = section_shape(info, cell_kind(options), section_scale(info, options));
        is_in_place = can_crop(sections());
        require_room_for_section(options);
        survey.strips.cap = options.cap;
        survey.strips.cells = shape.cells;
        survey.background = options.background;
    }

    SectionReader& sections() { return cleaned ? *cleaned : *file; }

    /// Labels that nothing changes are read in place. An input that can be read only once keeps its labels, and so does
    /// one whose sections do not fit in memory.
    void clean(const ReconstructOptions& options) {
        if (options.room > 0) {
            cleaned = std::make_unique<RoomReader>(*file, options.room, options.threads);
        } else if (options.denoise.distance != 0) {
            denoise.emplace();
            if (bytes_for_section(file->info()) > options.memory) {
                denoise->refused = "a section does not fit in --memory";
                return;
            }
            auto denoised = std::make_unique<DenoisedSections>(*file, denoise_options(options));
            *denoise = denoised->report();
            if (denoise->has_changes()) cleaned = std::move(denoised);
        }
    }

    /// Two sections, and what their reader holds.
    static std::uint64_t bytes_for_section(const VolumeInfo& volume) {
        const auto [u, v, w] = volume.sweep.axes;
        const std::uint64_t section = std::uint64_t{volume.lattice.size[u]} * volume.lattice.size[v];
        return kProcessBytes + volume.held_bytes + section * kSurveyBytesPerSample;
    }

    void require_room_for_section(const ReconstructOptions& options) const {
        if (is_in_place) return;
        const std::uint64_t needed = bytes_for_section(info);
        if (needed > options.memory)
            throw Error(ErrorCode::kInput, memory_limit_text(options.memory) + ": " + info.source + " needs at least " +
                                               megabytes(needed) + " to be read; raise --memory, or change --sweep");
    }

    /// Parts that are surveyed by themselves: for memory, to share the work, and so that a run that was ended goes on
    /// with the part that it was at.
    std::vector<IndexBox> parts(const ReconstructOptions& options, std::uint32_t processes) const {
        constexpr std::uint32_t kPartsPerProcess = 4;
        constexpr double kPartSamples = 1 << 22;  // a second or less
        constexpr double kMostParts = 1000;
        const auto& size = info.lattice.size;
        const double parts = std::min(double(size[0]) * size[1] * size[2] / kPartSamples, kMostParts);
        return survey_boxes(
            info, options.memory / 2 / kSurveyBytesPerSample,
            std::max(processes > 1 ? processes * kPartsPerProcess : 1, static_cast<std::uint32_t>(parts)));
    }

    std::unique_ptr<SectionReader> file;
    const FingerprintedSections* samples = nullptr;  // `file`, where it is read in one pass
    std::unique_ptr<SectionReader> cleaned = {};     // of `file`; none: as it is
    std::optional<DenoiseReport> denoise = {};       // none: labels were not looked at
    VolumeInfo info = {};
    SourceShape shape = {};
    bool is_in_place = false;
    SurveyOptions survey = {};
};

/// Surveys the boxes whose parts are not there, shared with other processes.
void survey_parts(const OpenSections& open, const Input& input, const std::vector<IndexBox>& boxes,
                  const BlockOptions& blocks, BlockTasks& tasks, const OnBlocks& on_progress) {
    const SurveyOptions& survey = input.survey;
    const VolumeInfo& volume = input.info;
    const auto count = static_cast<std::uint32_t>(boxes.size());
    while (const auto task = tasks.next(count)) {
        const fs::path path = part_path(blocks.folder, boxes[*task]);
        if (!find_part(path, volume, boxes[*task]))
            write_part(survey_part(open, boxes[*task], survey), path, blocks.output);
        if (on_progress) on_progress({"read", *task + 1, count});
    }
    tasks.end_phase();
}

Survey join_parts(const Input& input, const std::vector<IndexBox>& boxes, const fs::path& folder) {
    std::vector<PartSurvey> parts;
    for (const IndexBox& box : boxes) {
        const fs::path path = part_path(folder, box);
        auto part = find_part(path, input.info, box);
        if (!part) formats::fail(path, "is missing or damaged; remove the folder, and run again");
        parts.push_back(std::move(*part));
    }
    return join_surveys(input.info, input.survey.background, parts);
}

/// A copy of the samples of an input that cannot be read in place: in the folder, with its labels and hashes.
struct CopiedVolume {
    LabelTable labels;
    std::uint64_t hashes;  // fingerprint
};

/// Says that the copy is complete, until all blocks are reconstructed.
fs::path copied_path(const fs::path& folder) { return folder / kCopied; }

/// The copy that an earlier start of the run has made; nothing where there is none.
std::optional<CopiedVolume> find_copy(const Input& input, const fs::path& folder) {
    std::array<std::uint64_t, 4> said{};
    if (input.samples || !fs::exists(copied_path(folder)) || !fs::exists(folder / kStagedLabels)) return {};
    const formats::InputFile file(copied_path(folder));
    if (file.read(0, std::as_writable_bytes(std::span(said))) != sizeof said) return {};
    if (fingerprint_of(std::span(said).first(said.size() - 1)) != said.back()) return {};
    Manifest manifest;
    manifest.is_unsigned = table_for(input.info).is_unsigned();
    manifest.label_count = said[0];
    manifest.labels_hash = said[1];
    return CopiedVolume{read_labels(manifest, folder), said[2]};
}

CopiedVolume copy_volume(Input& input, const BlockOptions& blocks, const OnBlocks& on_progress) {
    SectionReader& reader = input.sections();
    StagingFile copy(blocks.folder / kStagedLabels, blocks.output);
    LabelTable labels = table_for(input.info);
    dense_background(input.survey.background, labels);
    SampleHashes hashes = hashes_of_part(input.info, {{}, input.info.lattice.size});
    const std::uint32_t count = reader.section_count();
    std::vector<InputLabel> section(std::size_t{reader.section_width()} * reader.section_height());
    std::vector<Label> dense(section.size());
    for (std::uint32_t n = 0; n < count; ++n) {
        require_section(reader.next(section), input.info, n);
        labels.dense(section, dense);
        copy.write(dense);
        hashes.add(n, dense, labels);
        if (on_progress) on_progress({"read", n + 1, count});
    }
    copy.commit();
    write_labels(labels, blocks.folder, blocks.output);
    std::array<std::uint64_t, 4> said{labels.size(), hash_of(labels), fingerprint_of(hashes.sums()), 0};
    said.back() = fingerprint_of(std::span(said).first(said.size() - 1));
    OutputFile file(copied_path(blocks.folder), blocks.output);
    file.write({reinterpret_cast<const char*>(said.data()), sizeof said});
    file.commit();
    return {std::move(labels), said[2]};
}

/// Copies the samples, unless that was done, and surveys the copy.
Survey survey_copy(Input& input, const ReconstructOptions& options, const BlockOptions& blocks,
                   const OnBlocks& on_progress) {
    std::optional<CopiedVolume> copied = find_copy(input, blocks.folder);
    if (!copied) copied = copy_volume(input, blocks, on_progress);
    const StagedLabels staged(blocks.folder / kStagedLabels, input.info.lattice, input.info.sweep);
    const OpenSections open = [&] { return std::make_unique<StagedReader>(staged, copied->labels, input.info); };
    const std::vector<IndexBox> boxes = input.parts(options, 1);
    BlockTasks alone;
    if (boxes.size() > 1) survey_parts(open, input, boxes, blocks, alone, on_progress);
    Survey found =
        boxes.size() > 1 ? join_parts(input, boxes, blocks.folder) : survey_sections(*open(), input.survey, nullptr);
    if (fingerprint_of(found.hashes.sums()) != copied->hashes)
        formats::fail(staged.path(), "is not the copy that the run made; remove the folder, and run again");
    found.labels = std::move(copied->labels);
    return found;
}

/// Reads the input from one end to the other; copies what cannot be read in any order.
Survey survey_whole(Input& input, const ReconstructOptions& options, const BlockOptions& blocks,
                    const OnBlocks& on_progress) {
    if (!input.is_in_place) return survey_copy(input, options, blocks, on_progress);
    SurveyOptions survey = input.survey;
    survey.on_strip = [&](std::uint32_t done, std::uint32_t count) {
        if (on_progress) on_progress({"read", done, count});
    };
    return survey_sections(input.sections(), survey, nullptr);
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
    manifest.hashes_hash = write_sample_hashes(found.hashes, blocks.folder, blocks.output);
    if (input.samples) manifest.samples_hash = input.samples->fingerprint();
    manifest.space = info.space;
    manifest.metres = info.metres;
    manifest.names = info.names;
    manifest.colours = info.colours;
    manifest.denoise = input.denoise;
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
        if (const std::string name = entry.path().filename(); name == kStagedLabels || name == kCopied ||
                                                              name == kLabels || name == kSampleHashes ||
                                                              name.starts_with(kSurveyPart))
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
          std::pair{options.smooth_lines, "smooth-lines"}, std::pair{options.edge_length.has_value(), "edge-length"}})
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
    std::vector<IndexBox> boxes;
    if (input->is_in_place) boxes = input->parts(options, tasks.processes());
    bool others_write = boxes.size() > 1 && tasks.processes() > 1;  // parts of the survey
    try {
        if (boxes.size() > 1) survey_parts(open, *input, boxes, blocks, tasks, on_progress);
        others_write = false;
        if (tasks.is_first()) {
            const Survey found = boxes.size() > 1 ? join_parts(*input, boxes, blocks.folder)
                                                  : survey_whole(*input, options, blocks, on_progress);
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
