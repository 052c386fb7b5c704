#include "blocks/begin_run.h"

#include <optional>

#include "blocks/block_size.h"
#include "blocks/manifest.h"
#include "blocks/own_faces.h"
#include "blocks/survey.h"
#include "regionmesh/error.h"
#include "stream/plan.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"
#include "volume/room_reader.h"

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

/// Reads the input once: finds its labels and counts its faces, and copies what cannot be read in any order.
Manifest survey(const OpenSections& open, SectionReader& reader, const ReconstructOptions& options,
                const BlockOptions& blocks, const OnBlocks& on_progress) {
    const VolumeInfo info = reader.info();
    require_lattice(info.source, info.lattice);
    require_fit(info.source, options);
    const SourceShape shape = section_shape(info, cell_kind(options), section_scale(info, options));
    halo_of(shape, options);  // refuses other filters before the work
    const SurveyOptions how{.strips = {.cap = options.cap, .cells = shape.cells},
                            .background = options.background,
                            .on_strip = [&](std::uint32_t done, std::uint32_t count) {
                                if (on_progress) on_progress({"read", done, count});
                            }};
    Manifest manifest{.identity = blocks.identity};
    manifest.is_in_place = can_crop(reader);
    const std::uint64_t samples = std::uint64_t{reader.section_width()} * reader.section_height();
    const std::uint64_t most = options.memory / 2 / kSurveyBytesPerSample;
    Survey found;
    if (manifest.is_in_place) {
        found = samples > most ? survey_columns(open, most, how) : survey_sections(reader, how, nullptr);
    } else {
        StagingFile copy(blocks.folder / kStagedLabels, blocks.output);
        found = survey_sections(reader, how, &copy);
        copy.commit();
    }
    write_labels(found.labels, blocks.folder, blocks.output);
    manifest.is_surveyed = true;
    manifest.lattice = info.lattice;
    manifest.sweep = info.sweep;
    manifest.source = info.source;
    manifest.is_unsigned = found.labels.is_unsigned();
    manifest.label_count = found.labels.size();
    manifest.space = info.space;
    manifest.names = info.names;
    manifest.background = options.background;
    manifest.scale_z = shape.scale_z;
    manifest.initial_faces = found.faces;
    manifest.block_cells =
        blocks.block_cells > 0 ? blocks.block_cells : default_block_cells(shape, found.faces, options);
    require_block_count(info, manifest.block_cells);
    return manifest;
}

}  // namespace

void begin_run(const OpenSections& open, const ReconstructOptions& options, const BlockOptions& blocks,
               const OnBlocks& on_progress) {
    const auto there = read_manifest(blocks.folder);
    if (there) require_same_run(*there, blocks.identity, blocks.folder);
    if (there && there->is_surveyed) return;
    // Nothing is written for an input that cannot be read.
    const std::unique_ptr<SectionReader> reader = open();
    std::error_code error;
    if (!fs::is_directory(blocks.folder, error)) fs::create_directory(blocks.folder, error);
    if (error) throw Error(ErrorCode::kOutput, blocks.folder.string() + ": cannot be made: " + error.message());
    if (!there && !fs::is_empty(blocks.folder, error))
        throw Error(ErrorCode::kOutput, blocks.folder.string() + ": holds other files; name an empty or a new folder");
    if (!there) write_manifest({.identity = blocks.identity}, blocks.folder, blocks.output);
    std::optional<RoomReader> cleaned;
    if (options.room > 0) cleaned.emplace(*reader, options.room, options.threads);
    SectionReader& sections = cleaned ? static_cast<SectionReader&>(*cleaned) : *reader;
    write_manifest(survey(open, sections, options, blocks, on_progress), blocks.folder, blocks.output);
}

}  // namespace regionmesh
