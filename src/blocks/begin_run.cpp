#include "blocks/begin_run.h"

#include <fmt/ranges.h>

#include <optional>
#include <set>
#include <span>
#include <vector>

#include "blocks/block_size.h"
#include "blocks/manifest.h"
#include "blocks/own_faces.h"
#include "blocks/survey.h"
#include "formats/input_file.h"
#include "regionmesh/error.h"
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

void require_fit(const std::string& source, const ReconstructOptions& options) {
    const auto refuse = [&](const char* what) {
        throw Error(ErrorCode::kInput,
                    source + ": " + what + " needs the whole surface at once, which blocks do not have; leave it out");
    };
    if (options.preserve_volume) refuse("--preserve-volume");
    if (options.improve) refuse("--improve");
}

/// The volume as it is asked for, and how it is surveyed. Refuses what blocks do not have.
struct Input {
    Input(const OpenSections& open, const ReconstructOptions& options) : file(open()) {
        require_in_range(options);
        if (options.room > 0) cleaned.emplace(*file, options.room, options.threads);
        info = sections().info();
        require_lattice(info.source, info.lattice);
        require_cells(info);
        require_fit(info.source, options);
        shape = section_shape(info, cell_kind(options), section_scale(info, options));
        halo_of(shape, options);  // refuses other filters
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
    manifest.space = info.space;
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

/// Leaves an empty folder behind, as if the input had been refused at once.
void require_regions(const Survey& found, const Input& input, const ReconstructOptions& options,
                     const fs::path& folder) {
    std::uint32_t background = 0;
    for (const InputLabel label : std::set(options.background.begin(), options.background.end()))
        background += found.labels.find(label).has_value();
    const bool is_empty = background == found.labels.size(), is_one = !options.cap && found.faces == 0;
    if (!is_empty && !is_one) return;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    for (const fs::path& file : files) fs::remove(file);
    throw Error(ErrorCode::kInput,
                input.info.source + ": there is no region to model: " +
                    (is_empty ? "all of it is background; give another --background, or --no-background"
                              : "it has one label only, which has no face with --boundary open; give --boundary cap"));
}

/// Makes the folder, and a manifest that says which run it belongs to.
void make_folder(const BlockOptions& blocks) {
    std::error_code error;
    if (!fs::is_directory(blocks.folder, error)) fs::create_directory(blocks.folder, error);
    if (error) throw Error(ErrorCode::kOutput, blocks.folder.string() + ": cannot be made: " + error.message());
    if (!fs::is_empty(blocks.folder, error))
        throw Error(ErrorCode::kOutput, blocks.folder.string() + ": holds other files; name an empty or a new folder");
    Manifest manifest;
    manifest.identity = blocks.identity;
    write_manifest(manifest, blocks.folder, blocks.output);
}

}  // namespace

void begin_run(const OpenSections& open, const ReconstructOptions& options, const BlockOptions& blocks,
               BlockTasks& tasks, const OnBlocks& on_progress) {
    std::optional<Input> input;
    if (tasks.is_first()) {
        const auto there = read_manifest(blocks.folder);
        // Nothing is written for an input that cannot be read.
        if (!there || !there->is_surveyed) input.emplace(open, options);
        if (there)
            require_same_run(*there, blocks.identity, blocks.folder);
        else
            make_folder(blocks);
    }
    tasks.end_phase();
    if (read_manifest_together(blocks.folder, tasks).is_surveyed) return;
    if (!input) input.emplace(open, options);
    const std::vector<IndexBox> boxes = input->boxes(options, tasks.processes());
    if (boxes.size() > 1) survey_parts(open, boxes, input->survey, blocks, tasks, on_progress);
    if (tasks.is_first()) {
        const Survey found =
            boxes.size() > 1 ? join_parts(*input, boxes, blocks.folder) : survey_whole(*input, blocks, on_progress);
        require_regions(found, *input, options, blocks.folder);
        note_survey(found, *input, options, blocks);
    }
    tasks.end_phase();
}

Manifest read_manifest_together(const fs::path& folder, BlockTasks& tasks) {
    const Manifest manifest = *read_manifest(folder);
    tasks.end_phase();
    return manifest;
}

}  // namespace regionmesh
