// The whole story: from sections, or tetrahedra, to a checked mesh. Each stage has a header of its own.
//
//   read -> cells -> smooth -> tiles -> merge -> simplify -> (remesh) -> (smooth lines) -> (improve) -> check
#include "stream/pipeline.h"

#include <optional>
#include <string>

#include "base/parallel_invoke.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/process.h"
#include "regionmesh/select_sections.h"
#include "stream/chunk_volumes.h"
#include "stream/finish.h"
#include "stream/footprint.h"
#include "stream/gatherer.h"
#include "stream/plan.h"
#include "stream/read_ahead.h"
#include "stream/section_faces.h"
#include "stream/simplify_stage.h"
#include "stream/stage_options.h"
#include "stream/strips.h"
#include "stream/tetrahedron_faces.h"
#include "stream/tile_stage.h"
#include "stream/tuning.h"
#include "volume/room_reader.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

/// A first pass over the input, where it can be read twice.
std::optional<FaceCount> count_faces(FaceSource& source, RunLog& log) {
    log.note_strip_count(source.shape().strip_count);
    log.report_progress("count");
    const StageTimer timer = log.time("count");
    std::optional<FaceCount> counted = source.count([&](std::uint32_t strips) { log.note_strips_counted(strips); });
    log.note_strip_count(source.shape().strip_count);
    log.advance(WorkStage::kCount, 1);
    return counted;
}

/// One pass over the input for the model. Strips are smoothed some strips behind; chunks of several strips are
/// decimated in tiles up to a low cost and merged into the model, which is kept within its budget (P 3.1-3.5). Returns
/// the strip at which smoothing was stuck, if it was.
std::optional<std::uint32_t> build(Strips& strips, SimplifyStage& simplify, const Plan& plan, MemoryRoom room,
                                   const ReconstructOptions& options, RunLog& log) {
    Gatherer gatherer(strips, plan.budget.chunk_strips, log);
    TileStage tiles(plan, options, strips.source().shape(), log);
    std::vector<double>& volumes = log.report().unsmoothed_volumes;
    std::optional<Vec3> apex;  // of the cones that are summed to volumes
    const bool may_gather_ahead = options.threads != 1 && tiles.is_on();
    GatheredStrips now, next;
    for (bool is_more = gatherer.next(now); is_more; std::swap(now, next)) {
        if (!strips.is_smoothing() && options.preserve_volume) add_volumes(now.chunk, now.carried, volumes, apex);
        const std::uint64_t initial_faces = now.chunk.faces.size();
        const auto gather = [&] {
            is_more = gatherer.next(next);
            give_back_freed_memory();  // smoothing leaves it in pieces, which tiles would make resident again
        };
        const bool is_ahead = may_gather_ahead && simplify.has_room_ahead();
        Chunk left;
        const auto simplify_tiles = [&] { left = tiles.run(now); };
        if (is_ahead)
            parallel_invoke(options.threads, simplify_tiles, gather);
        else
            simplify_tiles();
        // The next chunk is gathered in the same arrays, unless that would raise the peak.
        if (room != MemoryRoom::kAmple) now.chunk = {};
        simplify.merge(std::move(left), initial_faces);
        if (!now.is_last) simplify.keep_within_budget(now.safe_high);
        if (!is_ahead) gather();
    }
    if (strips.is_smoothing()) {
        log.report().smoothing = strips.smooth_report();
        volumes = strips.smooth_report().volume_before;
    }
    return strips.stuck_strip();
}

/// Leaves out of the progress what this run does not do.
void plan_progress(RunLog& log, const Plan& plan, const ReconstructOptions& options, bool can_compare) {
    if (options.smooth.passes == 0) log.leave_out(WorkStage::kSmooth);
    if (!plan.is_decimating)
        for (const WorkStage stage : {WorkStage::kTiles, WorkStage::kPasses, WorkStage::kTrim}) log.leave_out(stage);
    if (!options.edge_length) log.leave_out(WorkStage::kRemesh);
    if (!options.smooth_lines) log.leave_out(WorkStage::kLines);
    if (!options.improve) log.leave_out(WorkStage::kImprove);
    if (!options.preserve_volume) log.leave_out(WorkStage::kVolumes);
    if (!can_compare) log.leave_out(WorkStage::kSamples);
}

/// True if the model can be written while it is checked.
bool has_room_to_write(const Mesh& mesh, const ReconstructOptions& options) {
    constexpr std::uint64_t kBytes = kMeshBytesPerFace + kCheckBytesPerFace + kWriteBytesPerFace;
    return kProcessBytes + mesh.face_count() * kBytes <= options.memory;
}

/// How freely memory may be spent while strips are gathered. The window of smoothing leaves less.
MemoryRoom room_while_gathering(const Budget& budget, bool is_smoothing) {
    if (budget.is_short()) return MemoryRoom::kShort;
    return is_smoothing && !budget.is_largest_in_the_end ? MemoryRoom::kSome : MemoryRoom::kAmple;
}

/// The result of a run, or the strip at which smoothing was stuck.
struct Attempt {
    Reconstruction result;
    std::optional<std::uint32_t> stuck_strip = {};
};

/// Runs all stages; smoothing holds `extra` strips more than it seems to need.
Attempt attempt(FaceSource& source, const ReconstructOptions& options, std::uint32_t extra,
                const OnProgress& on_progress, const OnModel& on_model) {
    Attempt run;
    Reconstruction& result = run.result;
    RunLog log(result, on_progress);
    require_room_to_read(source.shape(), options);
    std::optional<FaceCount> counted = count_faces(source, log);
    const SourceShape& shape = source.shape();
    const SmoothOptions smooth = smooth_options(options, shape.scale);
    const ChunkOrder order = strip_order(shape, extra);
    Plan plan = make_plan(shape, std::move(counted), window_strips(smooth, order), options);
    const MemoryRoom room = room_while_gathering(plan.budget, smooth.passes > 0);
    note_memory_room(room, plan.budget.in_the_end);

    plan_progress(log, plan, options, source.can_compare());
    SimplifyStage simplify(result.mesh, plan, options, shape, log);
    {
        Strips strips(source, smooth, order, log);
        run.stuck_strip = build(strips, simplify, plan, room, options, log);
    }
    if (run.stuck_strip) return run;
    // The window of smoothing is gone.
    if (room != MemoryRoom::kShort) note_memory_room(MemoryRoom::kAmple, plan.budget.in_the_end);
    result.labels = source.labels();
    result.background = source.background();
    if (!plan.oracle) plan.oracle = source.oracle();

    simplify.bring_to_target();
    log.advance(WorkStage::kTrim, 1);
    if (plan.is_decimating || options.edge_length)
        result.report.quality_bound = quality_bound(options, ground_of(shape));
    remesh_faces(result, options, shape, log);
    log.advance(WorkStage::kRemesh, 1);
    smooth_lines(result, options, shape, log);
    log.advance(WorkStage::kLines, 1);
    improve_faces(result, options, shape, log);
    log.advance(WorkStage::kImprove, 1);
    restore_volumes(result, options, shape, log);
    log.advance(WorkStage::kVolumes, 1);
    give_back_freed_memory();
    result.report.pinned_vertices = release_all(result.mesh);
    source.place(result.mesh);
    for (double& volume : result.report.unsmoothed_volumes) volume *= source.volume_factor();
    result.report.smoothing.scale_volumes(source.volume_factor());
    result.mesh.compact();  // so that ids in the report are the numbers of points and faces in the written file
    const auto check = [&] { check_result(result, source, std::move(plan.oracle), options, log); };
    const auto hand_on = [&] {
        if (on_model) on_model(result.mesh, result.labels, result.background);
    };
    parallel_invoke(has_room_to_write(result.mesh, options) ? options.threads : 1, hand_on, check);
    result.report.final_faces = result.mesh.face_count();
    result.report.final_vertices = result.mesh.vertex_count();
    result.report.peak_bytes = peak_resident_bytes();
    return run;
}

}  // namespace

/// Runs until smoothing holds enough strips. In the end it holds all, and cannot be stuck.
Reconstruction reconstruct(FaceSource& source, const ReconstructOptions& options, const OnProgress& on_progress,
                           const OnModel& on_model) {
    double total = 0;
    for (std::uint32_t extra = 0;; extra = 2 * extra + stream::kExtraStrips) {
        Attempt run;
        {
            const Timer timer(total);
            run = attempt(source, options, extra, on_progress, on_model);
        }
        if (!run.stuck_strip) {
            run.result.report.seconds["total"] = total;
            return std::move(run.result);
        }
        if (!source.rewind())
            throw Error(ErrorCode::kInput, "smoothing: strip " + std::to_string(*run.stuck_strip) +
                                               " cannot be made valid without strips that were released, and the input "
                                               "cannot be read again; smooth with fewer passes");
    }
}

namespace {

Reconstruction reconstruct_sections(SectionReader& reader, const ReconstructOptions& options,
                                    const OnProgress& on_progress, const OnModel& on_model) {
    const bool is_lattice = options.smooth.passes > 0 && options.smooth.filter == SmoothFilter::kLattice;
    std::optional<ReadAhead> ahead;
    const std::uint64_t samples = std::uint64_t{reader.section_width()} * reader.section_height();
    if (options.threads != 1 && samples >= stream::kFewestReadAhead) ahead.emplace(reader);
    const CensusOptions census{
        .cap = options.cap, .background = options.background, .cells = cell_kind(options), .threads = options.threads};
    SectionFaces source(ahead ? *ahead : reader, census, is_lattice ? QuadCuts::kCones : QuadCuts::kBestQuality,
                        section_scale(reader.info(), options));
    return reconstruct(source, options, on_progress, on_model);
}

Reconstruction reconstruct_denoised(SectionReader& reader, const ReconstructOptions& options,
                                    const OnProgress& on_progress, const OnModel& on_model) {
    if (on_progress) on_progress({.stage = "denoise"});
    double seconds = 0;
    std::optional<DenoisedSections> denoised;
    {
        const Timer timer(seconds);
        denoised.emplace(reader, denoise_options(options));
    }
    // Labels that nothing changes are read as they are: the plan then needs no memory for more.
    const bool is_changed = denoised->report().has_changes() || !reader.info().can_rewind;
    if (!is_changed) reader.rewind();
    SectionReader& sections = is_changed ? static_cast<SectionReader&>(*denoised) : reader;
    Reconstruction result = reconstruct_sections(sections, options, on_progress, on_model);
    result.report.denoise = denoised->report();
    result.report.seconds["denoise"] = seconds;
    result.report.seconds["total"] += seconds;
    return result;
}

}  // namespace

std::unique_ptr<SectionReader> modelled_sections(std::unique_ptr<SectionReader> reader,
                                                 const ReconstructOptions& options) {
    if (options.room > 0) return clean_sections(std::move(reader), options.room, options.threads);
    return denoise_sections(std::move(reader), denoise_options(options));
}

std::uint64_t least_memory(const VolumeInfo& volume, const Census& census, const ReconstructOptions& given) {
    const ReconstructOptions options = with_filter(given, SmoothFilter::kLattice);
    const SourceShape shape = section_shape(volume, cell_kind(options), section_scale(volume, options));
    const std::uint32_t window = window_strips(smooth_options(options, shape.scale), strip_order(shape, 0));
    return least_memory(shape, volume.can_rewind ? census.strip_faces : std::vector<std::uint64_t>(), window, options);
}

Reconstruction reconstruct(SectionReader& reader, const ReconstructOptions& given, const OnProgress& on_progress,
                           const OnModel& on_model) {
    require_in_range(given);
    require_sweep(reader.info().source, reader.info().sweep);
    require_lattice(reader.info().source, reader.info().lattice);
    require_cells(reader.info());
    const ReconstructOptions options = with_filter(given, SmoothFilter::kLattice);
    if (options.room == 0 && options.denoise.distance != 0) {
        // What cannot be read within the memory is refused before labels are looked at.
        const VolumeInfo& info = reader.info();
        require_room_to_read(section_shape(info, cell_kind(options), section_scale(info, options)), options);
        return reconstruct_denoised(reader, options, on_progress, on_model);
    }
    if (options.room == 0) return reconstruct_sections(reader, options, on_progress, on_model);
    RoomReader cleaned(reader, options.room, options.threads);
    Reconstruction result = reconstruct_sections(cleaned, options, on_progress, on_model);
    result.report.samples_in_room = cleaned.changed();
    return result;
}

Reconstruction reconstruct(TetrahedronReader& reader, const ReconstructOptions& given, const OnProgress& on_progress,
                           const OnModel& on_model) {
    require_in_range(given);
    const ReconstructOptions options = with_filter(given, SmoothFilter::kTaubin);
    require_no_lattice(options.smooth);
    TetrahedronFaces source(reader, {.cap = options.cap,
                                     .background = options.background,
                                     .sweep = options.sweep,
                                     .for_smoothing = options.smooth.passes > 0,
                                     .memory = options.memory});
    return reconstruct(source, options, on_progress, on_model);
}

}  // namespace regionmesh
