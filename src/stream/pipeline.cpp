#include <algorithm>
#include <cmath>

#include "regionmesh/preserve_volume.h"
#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/simplify.h"
#include "simplify/raise_level.h"
#include "simplify/tiles.h"
#include "stream/batch_volumes.h"
#include "stream/memory_demand.h"
#include "stream/read_ahead.h"
#include "stream/run_until_held.h"
#include "stream/section_faces.h"
#include "stream/smoothing.h"
#include "stream/stage_options.h"
#include "stream/target.h"
#include "stream/tetrahedron_faces.h"
#include "stream/weld.h"

namespace regionmesh {
namespace {

/// Collapses that cost less than this, in units of spacing^4, are made in tiles already (docs/tiles.md says why this
/// much).
constexpr double kTileCostLevel = 3e-2;

/// One run: its state, and the steps in the order of reconstruct() below.
class Run {
public:
    Run(FaceSource& source, const ReconstructOptions& options, const std::function<void(const Progress&)>& on_progress)
        : source_(source),
          options_(options),
          on_progress_(on_progress),
          target_{options.target_faces, options.reduce, {}} {}

    void plan();
    void build();
    void bring_to_target();
    void preserve_volumes();
    void prove();
    Reconstruction finish();

private:
    bool is_decimating() const { return regionmesh::is_decimating(options_); }
    bool read();
    void note_strip(const Chunk& batch);
    SmoothOptions smooth_options() const { return regionmesh::smooth_options(options_, source_.shape().scale); }
    int sweep_axis() const { return source_.shape().axis(); }
    void smooth_strip(Chunk& batch);
    void add_strip(const Chunk& batch);
    void end_run();
    void decimate_run();
    bool is_at_end() const { return strips_ == source_.shape().strip_count; }
    double floor() const { return smoothing_ ? smoothing_->floor() : source_.plane_of(strips_); }
    DecimateOptions decimate_options() const { return regionmesh::decimate_options(options_, source_.shape().scale); }
    void add_verdicts(const VerdictCounts& counts);
    void keep_within_budget(std::uint64_t run_faces);
    void raise_to(std::uint64_t faces, double high);
    void decimate_to(std::uint64_t faces, bool is_last);
    void note_bytes(std::uint64_t faces, std::size_t bytes);
    void tell(const char* stage);
    double& seconds(const char* stage) { return result_.report.seconds[stage]; }

    FaceSource& source_;
    const ReconstructOptions& options_;
    const std::function<void(const Progress&)>& on_progress_;
    Reconstruction result_;
    Progress progress_;
    Target target_;
    TilePlan plan_;
    std::optional<Smoothing> smoothing_;
    Chunk run_;  // strips since the last weld
    Weld weld_{result_.mesh};
    std::uint32_t strips_ = 0;    // added to runs so far
    double ceiling_ = -HUGE_VAL;  // as far as faces of earlier runs reach along the sweep
    MemoryPlan memory_;
    std::uint64_t joined_faces_ = 0;  // unsimplified, of the runs that have joined the model
    std::optional<LabelOracle> oracle_;
    std::size_t most_bytes_ = 0;  // of model and decimation together, so far
    StopReason stopped_ = StopReason::kTarget;
};

/// A first pass over the input, where it can be read twice; and what memory is for.
void Run::plan() {
    std::optional<FaceCount> counted;
    {
        progress_.strip_count = source_.shape().strip_count;
        tell("count");
        const Timer timer(seconds("count"));
        counted = source_.count();
    }
    const SourceShape& shape = source_.shape();
    progress_.strip_count = shape.strip_count;
    result_.background = source_.background();
    plan_ = plan_tiles(shape.lattice, shape.sweep);
    if (options_.smooth.passes > 0)
        smoothing_.emplace(
            smooth_options(),
            LayerOrder{.axis = shape.axis(), .thickness = shape.strip_thickness, .overlap = shape.strip_overlap});
    const std::uint64_t cells = std::max(shape.lattice.size[shape.axis()], 2u) - 1;
    const auto tile_strips = static_cast<std::uint32_t>(std::uint64_t{plan_.run_strips} * shape.strip_count / cells);
    RunSize size{.shape = shape,
                 .strip_faces = {},
                 .window_strips = smoothing_ ? smoothing_->most_strips() : 0,
                 .run_strips = is_decimating() ? std::max(tile_strips, 1u) : options_.strips_per_batch};
    if (counted) {
        target_.total = counted->face_count;
        oracle_ = std::move(counted->oracle);
        size.strip_faces = std::move(counted->strip_faces);
    }
    const MemoryDemand demand = memory_demand(options_, target_, std::move(size));
    memory_ = plan_memory(options_.memory, demand);
    require_memory(memory_, demand);
    plan_.run_strips = memory_.run_strips;
}

/// Strips become faces, which are smoothed some strips behind; runs of strips are decimated tile by tile up to a low
/// cost level and welded to the model, which is kept within its budget (P 3.1-3.5).
void Run::build() {
    Chunk batch;
    while (read()) {
        {
            const Timer timer(seconds("reconstruct"));
            source_.make_faces(batch);
        }
        note_strip(batch);
        if (smoothing_)
            smooth_strip(batch);
        else
            add_strip(batch);
    }
    if (smoothing_) {
        result_.report.smoothing = smoothing_->report();
        result_.report.unsmoothed_volumes = smoothing_->report().volume_before;
    }
    smoothing_.reset();
    result_.labels = source_.labels();
    if (!oracle_) oracle_ = source_.oracle();
}

bool Run::read() {
    const Timer timer(seconds("read"));
    return source_.advance();
}

void Run::note_strip(const Chunk& batch) {
    result_.report.initial_faces += batch.faces.size();
    result_.report.initial_vertices += batch.vertices.size();
    progress_.strips_read = source_.strips_read();
    progress_.faces_read = result_.report.initial_faces;
    tell("reconstruct");
}

void Run::smooth_strip(Chunk& batch) {
    {
        const Timer timer(seconds("smooth"));
        smoothing_->add(batch, source_.is_last(), source_.plane_of(source_.strips_read()));
    }
    for (;;) {
        {
            const Timer timer(seconds("smooth"));
            if (!smoothing_->next(batch)) return;
        }
        add_strip(batch);
    }
}

void Run::add_strip(const Chunk& batch) {
    {
        const Timer timer(seconds("reconstruct"));
        run_.append(batch);
    }
    ++strips_;
    if (strips_ % plan_.run_strips == 0 || is_at_end()) end_run();
}

void Run::end_run() {
    double ceiling = ceiling_;
    for (const ChunkVertex& vertex : run_.vertices) ceiling = std::max(ceiling, vertex.position[sweep_axis()]);
    if (!smoothing_ && options_.preserve_volume) add_volumes(run_, weld_.front(), result_.report.unsmoothed_volumes);
    joined_faces_ += run_.faces.size();
    if (is_decimating()) decimate_run();
    {
        const Timer timer(seconds("reconstruct"));
        weld_.add(run_);
    }
    ceiling_ = ceiling;
    const std::uint64_t run_faces = run_.faces.size();
    run_ = {};
    give_back_freed_memory();
    note_bytes(result_.mesh.face_count(), result_.mesh.bytes());
    if (!is_at_end()) keep_within_budget(run_faces);
}

/// First stage: in tiles, up to the cost level, and never below what the target will leave.
void Run::decimate_run() {
    const double share = target_.share();
    if (share * kFreeMargin >= 1) return;
    const Timer timer(seconds("decimate tiles"));
    TileOptions tile_options{.cost_level = kTileCostLevel,
                             .keep_share = std::min(share * kTileMargin, 1.0),
                             .free_share = share > kFreeFrom ? share * kFreeMargin : 1,
                             .threads = options_.threads,
                             .in_flight = memory_.in_flight,
                             .decimate = decimate_options()};
    const std::uint32_t first = (strips_ - 1) / plan_.run_strips * plan_.run_strips;
    // Faces of earlier runs may reach up to the ceiling, those of later ones down to the floor.
    const RunExtent extent{std::max(source_.plane_of(first), ceiling_), std::min(source_.plane_of(strips_), floor())};
    add_verdicts(decimate_tiles(run_, weld_.front(), extent, plan_, tile_options));
}

void Run::keep_within_budget(std::uint64_t run_faces) {
    // The next run comes on top of what is held.
    const std::uint32_t next = strips_ / plan_.run_strips;
    const std::uint64_t budget = memory_.face_budget(next),
                        room = memory_.room_before(next, memory_.expected_faces(next, run_faces));
    if (!is_decimating() || result_.mesh.face_count() <= room) return;
    // Down by a good part, so that the heap need not be built anew after every run.
    const std::uint64_t goal = std::max(target_.so_far(joined_faces_), std::min(room, budget * 6 / 10));
    if (result_.mesh.face_count() <= goal) return;
    raise_to(goal, floor());
    stopped_ = StopReason::kTarget;
    if (result_.mesh.face_count() > room) {
        weld_.renumber(result_.mesh.sort_spatially());
        give_back_freed_memory();
        decimate_to(goal, false);
        give_back_freed_memory();
    }
    // Where topology or the largest error forbid more, the model goes on growing.
    if (stopped_ != StopReason::kTarget && result_.mesh.face_count() > room)
        memory_.asked_budget = std::uint64_t{result_.mesh.face_count()} * 3 / 2;
}

void Run::add_verdicts(const VerdictCounts& counts) {
    for (int n = 0; n < kVerdictCount; ++n) result_.report.verdicts[n] += counts[n];
}

/// Second stage: the whole model near so many faces, in tiles. Nothing that comes later reaches below `high`.
void Run::raise_to(std::uint64_t faces, double high) {
    const Timer timer(seconds("raise level"));
    const TileOptions tile_options{.cost_level = 0,
                                   .keep_share = 0,
                                   .threads = options_.threads,
                                   .in_flight = memory_.in_flight,
                                   .decimate = decimate_options()};
    const std::size_t held = result_.mesh.face_count(), mesh_bytes = result_.mesh.bytes();
    Chunk whole = weld_.take_apart();
    note_bytes(held, mesh_bytes + whole.vertices.size() * sizeof(ChunkVertex) + held * sizeof(ChunkFace));
    give_back_freed_memory();
    const RaiseResult done = raise_level(whole, plan_, {.goal_faces = faces, .high = high, .tiles = tile_options});
    add_verdicts(done.verdicts);
    weld_.add(whole);
    give_back_freed_memory();
}

void Run::decimate_to(std::uint64_t faces, bool is_last) {
    const Timer timer(seconds("decimate"));
    DecimateOptions own = decimate_options();
    own.target_faces = static_cast<std::uint32_t>(std::min(faces, kMostFaces));
    own.refresh = is_last;
    if (!is_last) {
        // What comes later lies at or beyond the end of the last strip, or as far back as smoothing took it.
        own.limits.high[sweep_axis()] = floor();
    }
    const char* stage = is_last ? "decimate" : "reconstruct";
    own.on_progress = [&] { tell(stage); };
    const std::uint64_t held = result_.mesh.face_count();
    const std::size_t mesh_bytes = result_.mesh.bytes();
    const DecimateResult done = decimate(result_.mesh, own);
    add_verdicts(done.verdicts);
    result_.report.refreshes += done.refreshes;
    stopped_ = done.stopped;
    note_bytes(held, mesh_bytes + done.bytes);
}

void Run::bring_to_target() {
    if (!is_decimating()) {
        result_.report.stopped = "none asked";
        return;
    }
    tell("decimate");
    const std::uint64_t target = target_.of(result_.report.initial_faces);
    raise_to(target, HUGE_VAL);
    result_.mesh.sort_spatially();
    decimate_to(target, true);
    result_.report.stopped = to_string(stopped_);
}

/// Gives the regions the volumes that they had before smoothing and decimation.
void Run::preserve_volumes() {
    if (!options_.preserve_volume) return;
    const Timer timer(seconds("preserve volume"));
    SmoothOptions own = smooth_options();
    const std::vector<double>& before = result_.report.unsmoothed_volumes;
    WantedVolumes wanted(before.begin(), before.end());
    for (Label label : result_.background)
        if (label < wanted.size()) wanted[label].reset();
    result_.report.preserved = regionmesh::preserve_volumes(result_.mesh, wanted, own);
}

/// Checks what will be written, where it will lie.
void Run::prove() {
    give_back_freed_memory();
    result_.report.pinned_vertices = weld_.release_all();
    source_.place(result_.mesh);
    tell("check");
    const Timer timer(seconds("check"));
    CheckOptions check_options;
    check_options.boundary_is_open = !options_.cap;
    check_options.background = result_.background;
    check_options.oracle = std::move(oracle_);
    check_options.crossing = options_.intersect_check;
    check_options.threads = options_.threads;
    check_options.label_text = [this](Label label) { return result_.labels.text(result_.labels.input(label)); };
    result_.report.check = check(result_.mesh, check_options);
}

Reconstruction Run::finish() {
    result_.report.final_faces = result_.mesh.face_count();
    result_.report.final_vertices = result_.mesh.vertex_count();
    result_.report.peak_bytes = peak_resident_bytes();
    return std::move(result_);
}

void Run::note_bytes(std::uint64_t faces, std::size_t bytes) {
    Report& report = result_.report;
    if (faces == 0 || bytes < most_bytes_) return;
    most_bytes_ = bytes;
    report.peak_faces = std::max(report.peak_faces, faces);
    report.bytes_per_face = static_cast<double>(bytes) / static_cast<double>(faces);
}

void Run::tell(const char* stage) {
    if (!on_progress_) return;
    progress_.stage = stage;
    progress_.faces_held = result_.mesh.face_count();
    on_progress_(progress_);
}

Reconstruction run_once(FaceSource& source, const ReconstructOptions& options,
                        const std::function<void(const Progress&)>& on_progress) {
    Run run(source, options, on_progress);
    run.plan();
    run.build();
    run.bring_to_target();
    run.preserve_volumes();
    run.prove();
    return run.finish();
}

}  // namespace

Reconstruction reconstruct(SectionReader& reader, const ReconstructOptions& options,
                           const std::function<void(const Progress&)>& on_progress) {
    const auto once = [&](const ReconstructOptions& own) {
        std::optional<ReadAhead> ahead;
        if (own.threads != 1) ahead.emplace(reader);
        SectionFaces source(ahead ? *ahead : reader, {.cap = own.cap, .background = own.background});
        return run_once(source, own, on_progress);
    };
    return run_until_held(options, once, [&] {
        if (reader.info().can_rewind) reader.rewind();
        return reader.info().can_rewind;
    });
}

Reconstruction reconstruct(TetrahedronReader& reader, const ReconstructOptions& options,
                           const std::function<void(const Progress&)>& on_progress) {
    TetrahedronFaces source(reader, {.cap = options.cap,
                                     .background = options.background,
                                     .sweep = options.sweep,
                                     .in_layers = options.smooth.passes > 0,
                                     .memory = options.memory});
    const auto once = [&](const ReconstructOptions& own) { return run_once(source, own, on_progress); };
    return run_until_held(options, once, [&] {
        source.rewind();
        return true;
    });
}

}  // namespace regionmesh
