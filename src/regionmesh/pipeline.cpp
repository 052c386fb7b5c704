#include "regionmesh/pipeline.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/base/error.h"
#include "regionmesh/base/process.h"
#include "regionmesh/decimate/decimate.h"
#include "regionmesh/stream/section_window.h"
#include "regionmesh/stream/weld.h"
#include "regionmesh/tets/label_census.h"
#include "regionmesh/tets/strip_mesher.h"
#include "regionmesh/tile/tiles.h"

namespace regionmesh {
namespace {

/// Collapses that cost less than this, in units of spacing^4, are made in tiles already (docs/tiles.md says why this
/// much). But a tile keeps so many times the share of faces that the target leaves.
constexpr double kTileCostLevel = 3e-2;
constexpr double kTileMargin = 1.25;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint32_t>::max();

/// Positions are index times spacing; an origin is added at once where no direction matrix comes between.
Lattice meshing_lattice(const Lattice& lattice) {
    Lattice result = lattice;
    if (!lattice.is_axis_aligned()) result.origin = {};
    return result;
}

/// Background labels known before reading get the first dense numbers.
std::vector<Label> dense_background(const ReconstructOptions& options, LabelTable& labels) {
    std::vector<Label> background;
    for (InputLabel label : options.background) background.push_back(labels.dense(label));
    return background;
}

LabelTable table_for(const VolumeInfo& volume) { return LabelTable(volume.type == SampleType::kU64); }

/// One run: its state, and the steps in the order of reconstruct() below.
class Run {
public:
    Run(SectionReader& reader, const ReconstructOptions& options,
        const std::function<void(const Progress&)>& on_progress)
        : reader_(reader), options_(options), on_progress_(on_progress), lattice_(reader.info().lattice) {
        result_.labels = table_for(reader.info());
        result_.background = dense_background(options, result_.labels);
        progress_.section_count = reader.section_count();
    }

    void plan();
    void build();
    void bring_to_target();
    void place_in_space();
    void prove();
    Reconstruction finish();

private:
    bool is_decimating() const {
        return options_.decimate && (options_.target_faces || options_.reduce || options_.max_error);
    }
    bool read(SectionWindow& window);
    void note_strip(const SectionWindow& window, const FaceBatch& batch);
    void decimate_run(FaceBatch& run, const std::vector<BatchVertex>& carried, std::uint32_t first_strip,
                      const TilePlan& plan);
    DecimateOptions decimate_options() const;
    void add_verdicts(const VerdictCounts& counts);
    double target_share() const;
    std::uint64_t target_for(std::uint64_t initial_faces) const;
    std::uint64_t target_so_far() const;
    void keep_within_budget(Weld& weld, std::uint64_t run_faces);
    void decimate_to(std::uint64_t faces, bool is_last);
    void note_bytes(std::uint64_t faces, std::size_t bytes);
    void tell(const char* stage);
    double& seconds(const char* stage) { return result_.report.seconds[stage]; }

    SectionReader& reader_;
    const ReconstructOptions& options_;
    const std::function<void(const Progress&)>& on_progress_;
    Lattice lattice_;
    Reconstruction result_;
    Progress progress_;
    std::optional<std::uint64_t> total_faces_;  // of the unsimplified model, where a first pass counted them
    std::uint64_t budget_ = kNoLimit;
    LabelOracle oracle_;
    std::size_t most_bytes_ = 0;  // of model and decimation together, so far
    StopReason stopped_ = StopReason::kTarget;
};

/// A first pass over the sections, where the target needs the total; and the face budget.
void Run::plan() {
    if (options_.face_budget)
        budget_ = *options_.face_budget;
    else
        budget_ = face_budget_for(options_.memory, reader_.info());
    if (!is_decimating() || !(options_.reduce || options_.target_faces) || !reader_.info().can_rewind) return;
    tell("count");
    const Timer timer(seconds("count"));
    total_faces_ = count_labels(reader_, options_).face_count;
    reader_.rewind();
}

/// Strips become faces; runs of strips are decimated tile by tile up to a low cost level and welded to the model, which
/// is kept within its budget (P 3.1-3.5).
void Run::build() {
    SectionWindow window(reader_, result_.labels);
    const StripOptions strip_options{.cap = options_.cap, .background = result_.background};
    StripMesher mesher(meshing_lattice(lattice_), reader_.info().sweep, strip_options);
    LabelCensus census(lattice_, reader_.info().sweep, strip_options);
    const TilePlan plan = plan_tiles(meshing_lattice(lattice_), reader_.info().sweep);
    const std::uint32_t run_strips = is_decimating() ? plan.run_strips : options_.strips_per_batch;
    Weld weld(result_.model);
    FaceBatch batch, run;
    while (read(window)) {
        {
            const Timer timer(seconds("reconstruct"));
            census.add(window.low(), window.high(), window.is_last());
            batch.clear();
            mesher.mesh(window.low(), window.high(), batch);
            run.append(batch);
        }
        note_strip(window, batch);
        const std::uint32_t strips = window.sections_read() - 1;
        if (strips % run_strips != 0 && !window.is_last()) continue;
        if (is_decimating()) decimate_run(run, weld.front(), (strips - 1) / run_strips * run_strips, plan);
        {
            const Timer timer(seconds("reconstruct"));
            weld.add(run);
        }
        const std::uint64_t run_faces = run.faces.size();
        run.clear();
        note_bytes(result_.model.face_count(), result_.model.bytes());
        if (!window.is_last()) keep_within_budget(weld, run_faces);
    }
    oracle_ = census.oracle();
}

bool Run::read(SectionWindow& window) {
    const Timer timer(seconds("read"));
    return window.advance();
}

void Run::note_strip(const SectionWindow& window, const FaceBatch& batch) {
    result_.report.initial_faces += batch.faces.size();
    result_.report.initial_vertices += batch.vertices.size();
    progress_.sections_read = window.sections_read();
    progress_.faces_read = result_.report.initial_faces;
    tell("reconstruct");
}

/// First stage: in tiles, up to the cost level, and never below what the target will leave.
void Run::decimate_run(FaceBatch& run, const std::vector<BatchVertex>& carried, std::uint32_t first_strip,
                       const TilePlan& plan) {
    const double share = target_share();
    if (share * kTileMargin >= 1) return;
    const Timer timer(seconds("decimate tiles"));
    TileOptions tile_options{.cost_level = kTileCostLevel,
                             .keep_share = share * kTileMargin,
                             .threads = options_.threads,
                             .decimate = decimate_options()};
    const TileResult done = decimate_tiles(run, carried, first_strip, plan, tile_options);
    add_verdicts(done.verdicts);
}

/// Share of the faces that the target leaves; 1 while nobody knows the total, 0 where only the error bounds.
double Run::target_share() const {
    if (options_.reduce) return 1 - *options_.reduce;
    if (!options_.target_faces) return 0;
    return total_faces_ ? static_cast<double>(*options_.target_faces) /
                              static_cast<double>(std::max<std::uint64_t>(*total_faces_, 1))
                        : 1;
}

std::uint64_t Run::target_for(std::uint64_t initial_faces) const {
    if (options_.target_faces) return *options_.target_faces;
    if (options_.reduce)
        return static_cast<std::uint64_t>(std::llround(static_cast<double>(initial_faces) * (1 - *options_.reduce)));
    return 0;
}

/// The share of the target that belongs to what has been read: decimating the first sections further than the last ones
/// would make the model uneven.
std::uint64_t Run::target_so_far() const {
    const std::uint64_t read = result_.report.initial_faces;
    if (!total_faces_) return target_for(read);
    return target_for(*total_faces_) * read / std::max<std::uint64_t>(*total_faces_, 1);
}

void Run::keep_within_budget(Weld& weld, std::uint64_t run_faces) {
    // The next run comes on top of what is held.
    const std::uint64_t room = budget_ - std::min(budget_, run_faces);
    if (!is_decimating() || result_.model.face_count() <= room) return;
    // Down by a good part, so that the heap need not be built anew after every run.
    const std::uint64_t goal = std::max(target_so_far(), std::min(room, budget_ * 6 / 10));
    if (result_.model.face_count() > goal) {
        weld.renumber(result_.model.sort_spatially());
        decimate_to(goal, false);
    }
    // Where topology, the largest error or the target forbid more, the model goes on growing.
    if (result_.model.face_count() > budget_) budget_ = std::uint64_t{result_.model.face_count()} * 3 / 2;
}

DecimateOptions Run::decimate_options() const {
    DecimateOptions own;
    if (options_.max_error) own.max_error = *options_.max_error;
    own.min_quality = options_.min_quality;
    own.perturbation = options_.perturbation;
    own.scale = std::cbrt(lattice_.spacing.x * lattice_.spacing.y * lattice_.spacing.z);
    own.intersect_check = options_.intersect_check;
    return own;
}

void Run::add_verdicts(const VerdictCounts& counts) {
    for (int n = 0; n < kVerdictCount; ++n) result_.report.verdicts[n] += counts[n];
}

void Run::decimate_to(std::uint64_t faces, bool is_last) {
    const Timer timer(seconds("decimate"));
    DecimateOptions own = decimate_options();
    own.target_faces = static_cast<std::uint32_t>(std::min(faces, kNoLimit));
    own.refresh = is_last;
    if (!is_last) {
        // What comes later lies at or beyond the last section read.
        const int axis = reader_.info().sweep.axes[2];
        own.limits.high[axis] =
            meshing_lattice(lattice_).origin[axis] + (progress_.sections_read - 1) * lattice_.spacing[axis];
    }
    const char* stage = is_last ? "decimate" : "reconstruct";
    own.on_progress = [&] { tell(stage); };
    const std::uint64_t held = result_.model.face_count();
    const std::size_t model_bytes = result_.model.bytes();
    const DecimateResult done = decimate(result_.model, own);
    add_verdicts(done.verdicts);
    result_.report.refreshes += done.refreshes;
    stopped_ = done.stopped;
    note_bytes(held, model_bytes + done.bytes);
}

void Run::bring_to_target() {
    if (!is_decimating()) {
        result_.report.stopped = "none asked";
        return;
    }
    tell("decimate");
    result_.model.sort_spatially();
    decimate_to(target_for(result_.report.initial_faces), true);
    result_.report.stopped = stopped_ == StopReason::kTarget     ? "target"
                             : stopped_ == StopReason::kMaxError ? "max_error"
                                                                 : "topology";
}

/// Applies the direction of the lattice, so that what is checked is what is written.
void Run::place_in_space() {
    if (lattice_.is_axis_aligned()) return;
    const auto& d = lattice_.direction;
    Model& model = result_.model;
    for (std::uint32_t n = 0; n < model.vertex_end(); ++n) {
        if (!model.is_alive(VertexId{n})) continue;
        Vec3& p = model[VertexId{n}].position;
        p = lattice_.origin + Vec3{d[0] * p.x + d[1] * p.y + d[2] * p.z, d[3] * p.x + d[4] * p.y + d[5] * p.z,
                                   d[6] * p.x + d[7] * p.y + d[8] * p.z};
    }
    const double determinant =
        d[0] * (d[4] * d[8] - d[5] * d[7]) - d[1] * (d[3] * d[8] - d[5] * d[6]) + d[2] * (d[3] * d[7] - d[4] * d[6]);
    if (determinant < 0) model.flip_faces();
}

void Run::prove() {
    tell("check");
    const Timer timer(seconds("check"));
    CheckOptions check_options;
    check_options.boundary_is_open = !options_.cap;
    check_options.background = result_.background;
    check_options.oracle = std::move(oracle_);
    check_options.crossing = options_.intersect_check;
    check_options.threads = options_.threads;
    check_options.label_text = [this](Label label) { return result_.labels.text(result_.labels.input(label)); };
    result_.report.check = check(result_.model, check_options);
}

Reconstruction Run::finish() {
    result_.report.final_faces = result_.model.face_count();
    result_.report.final_vertices = result_.model.vertex_count();
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
    progress_.faces_held = result_.model.face_count();
    on_progress_(progress_);
}

}  // namespace

Reconstruction reconstruct(SectionReader& reader, const ReconstructOptions& options,
                           const std::function<void(const Progress&)>& on_progress) {
    double total = 0;
    Reconstruction result;
    {
        const Timer timer(total);
        Run run(reader, options, on_progress);
        run.plan();
        run.build();
        run.bring_to_target();
        run.place_in_space();
        run.prove();
        result = run.finish();
    }
    result.report.seconds["total"] = total;
    return result;
}

std::uint64_t reading_bytes(const VolumeInfo& volume) {
    const std::uint64_t width = volume.lattice.size[volume.sweep.axes[0]],
                        height = volume.lattice.size[volume.sweep.axes[1]];
    // The section as read, two with dense labels, two planes of six vertex numbers, and what the reader holds; and the
    // faces and vertices of a run, at one face a sample.
    const std::uint64_t run = plan_tiles(volume.lattice, volume.sweep).run_strips;
    return width * height * (8 + 2 * 4 + 2 * 24 + 8 + run * (sizeof(BatchFace) + sizeof(BatchVertex) / 2)) +
           (std::uint64_t{16} << 20);
}

std::uint64_t face_budget_for(std::uint64_t memory, const VolumeInfo& volume) {
    const std::uint64_t reading = reading_bytes(volume);
    if (memory < reading + (std::uint64_t{1} << 20))
        throw Error(ErrorCode::kInput, "--memory " + std::to_string(memory >> 20) + " MiB: sections of " +
                                           volume.source + " alone take " + std::to_string((reading >> 20) + 1) +
                                           " MiB; give more, or another --sweep");
    return std::min((memory - reading) / kBytesPerFace, kNoLimit);
}

Census count_labels(SectionReader& reader, const ReconstructOptions& options) {
    Census census{.labels = table_for(reader.info()), .samples = {}, .oracle = {}};
    const std::vector<Label> background = dense_background(options, census.labels);
    SectionWindow window(reader, census.labels);
    LabelCensus counter(reader.info().lattice, reader.info().sweep, {.cap = options.cap, .background = background});
    const auto add_samples = [&](std::span<const Label> section) {
        census.samples.resize(census.labels.size(), 0);
        for (Label label : section) ++census.samples[label];
    };
    while (window.advance()) {
        if (window.sections_read() == 2) add_samples(window.low());
        add_samples(window.high());
        counter.add(window.low(), window.high(), window.is_last());
    }
    census.face_count = counter.face_count();
    census.oracle = counter.oracle();
    return census;
}

}  // namespace regionmesh
