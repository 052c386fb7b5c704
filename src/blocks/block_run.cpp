#include "blocks/block_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "blocks/begin_run.h"
#include "blocks/block_size.h"
#include "blocks/cut.h"
#include "blocks/gather.h"
#include "blocks/join.h"
#include "blocks/misfit.h"
#include "blocks/own_faces.h"
#include "blocks/passes.h"
#include "blocks/quotas.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/process.h"
#include "stream/plan.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"

namespace regionmesh {
namespace fs = std::filesystem;

BlockRun::BlockRun(const OpenSections& open, const ReconstructOptions& options, const BlockOptions& blocks,
                   BlockTasks& tasks, const std::function<void(const BlockProgress&)>& on_progress)
    : open_(open),
      options_(with_filter(options, SmoothFilter::kLattice)),
      blocks_(blocks),
      tasks_(tasks),
      on_progress_(on_progress),
      folder_(blocks.folder),
      target_{options.target_faces, options.reduce, {}},
      is_decimating_(is_decimating(options)) {}

BlockReport BlockRun::run() {
    note_memory_room(MemoryRoom::kShort);  // blocks are as large as memory has room for
    {
        const Timer timer(report_.seconds);
        const auto lock = begin_run(open_, options_, blocks_, tasks_, on_progress_);
        manifest_ = read_manifest_together(folder_, tasks_);
        job_ = job_of(manifest_.identity);
        open_volume();
        if (manifest_.is_complete) {
            require_pieces(manifest_, folder_);
        } else {
            run_passes();
            if (tasks_.is_first()) complete();
            tasks_.end_phase();
            manifest_ = require_manifest(folder_);
        }
        if (tasks_.is_first()) check_result();
        tasks_.end_phase();
    }
    report_.pieces = static_cast<std::uint32_t>(manifest_.pieces.size());
    report_.block_cells = manifest_.block_cells;
    report_.initial_faces = manifest_.initial_faces;
    report_.final_faces = manifest_.faces;
    report_.final_vertices = manifest_.vertices;
    report_.stopped = manifest_.stopped;
    report_.error_bound = manifest_.error_bound;
    if (manifest_.denoise) report_.denoise = *manifest_.denoise;
    report_.peak_bytes = peak_resident_bytes();
    return report_;
}

void BlockRun::open_volume() {
    VolumeInfo info;
    info.source = manifest_.source;
    info.lattice = manifest_.lattice;
    info.sweep = manifest_.sweep;
    const bool is_smoothed = options_.smooth.passes > 0;
    labels_ = read_labels(manifest_, folder_);
    const std::vector<Label> background = dense_background(manifest_.background, labels_);
    const SourceShape shape = section_shape(info, cell_kind(options_), manifest_.scale_z);
    has_samples_ = open_boxes();
    target_.total = manifest_.initial_faces;
    const StripOptions strips{.cap = options_.cap,
                              .background = background,
                              .cells = shape.cells,
                              .cuts = is_smoothed ? QuadCuts::kCones : QuadCuts::kBestQuality};
    volume_.emplace(BlockVolume{*boxes_, shape, strips, labels_, background});
}

void BlockRun::run_passes() {
    if (manifest_.passes == 0) reconstruct_pass();
    if (!is_decimating_) return;
    if (has_target() && face_count() <= target()) return;
    if (manifest_.pieces.size() == 1) return;
    if (manifest_.passes == kSeams) seam_pass();
    if (!has_target()) return;
    while (logs_before(manifest_.passes) < kMostLogs) {
        const std::uint32_t pass = manifest_.passes;
        if (!is_log(pass))
            cut_pass(pass);
        else if (face_count() > target())
            log_pass(pass);
        else
            return;
    }
}

std::uint64_t BlockRun::face_count() const {
    return std::accumulate(manifest_.pieces.begin(), manifest_.pieces.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const PieceEntry& piece) { return sum + piece.faces; });
}

std::uint32_t BlockRun::shift(std::uint32_t pass) const { return is_shifted(pass) ? manifest_.block_cells / 2 : 0; }

BlockGrid BlockRun::grid(std::uint32_t pass) const {
    return BlockGrid(volume_->shape.lattice, manifest_.block_cells, shift(pass));
}

BlockSimplifyOptions BlockRun::simplify_options() const {
    return {.simplify = regionmesh::simplify_options(options_, volume_->shape), .threads = options_.threads};
}

fs::path BlockRun::path_of(std::uint32_t pass, std::uint32_t block) const { return piece_path(folder_, pass, block); }

std::vector<PieceHeader> BlockRun::headers() const {
    std::vector<PieceHeader> found;
    for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block)
        found.push_back(read_entry_header(manifest_, folder_, block));
    return found;
}

PieceHeader BlockRun::header_of(std::uint32_t pass, std::uint32_t block) const {
    PieceHeader header;
    header.job = job_;
    header.pass = pass;
    header.block = block;
    return header;
}

/// Whether the piece was made before, by this run or by one that was ended.
bool BlockRun::is_there(const PieceHeader& header) {
    const bool is_found = find_piece(path_of(header.pass, header.block), header, piece_limits(manifest_)).has_value();
    if (is_found) ++report_.found;
    return is_found;
}

void BlockRun::keep(Piece piece) {
    write_piece(piece, path_of(piece.header.pass, piece.header.block), blocks_.output);
    ++report_.made;
}

/// Makes the pieces that are not there, shared with other processes.
void BlockRun::run_pass(std::uint32_t pass, const char* stage, const std::vector<std::uint32_t>& blocks,
                        const MakePiece& make) {
    const auto count = static_cast<std::uint32_t>(blocks.size());
    if (on_progress_) on_progress_({stage, 0, count});
    while (const auto task = tasks_.next(count)) {
        const PieceHeader header = header_of(pass, blocks[*task]);
        if (!is_there(header)) keep(make(header));
        give_back_freed_memory();
        if (on_progress_) on_progress_({stage, *task + 1, count});
    }
    end_pass(pass, blocks);
}

/// When all processes have come here: notes the pieces of a pass in the manifest. From then on those before them are
/// not needed, nor the samples.
void BlockRun::end_pass(std::uint32_t pass, const std::vector<std::uint32_t>& blocks) {
    tasks_.end_phase();
    if (tasks_.is_first()) {
        if (pass == 0 && manifest_.is_in_place) require_samples_unchanged();
        note_pieces(pass, blocks);
    }
    tasks_.end_phase();
    manifest_ = require_manifest(folder_);
}

/// Pieces of samples that changed on the way must not be found by a run that has the first ones again.
void BlockRun::require_samples_unchanged() {
    try {
        require_unchanged(blocks_);
    } catch (const Error&) {
        remove_passes_before(1);
        throw;
    }
}

void BlockRun::note_pieces(std::uint32_t pass, const std::vector<std::uint32_t>& blocks) {
    const std::uint32_t count = grid(pass).count();
    manifest_.shift = shift(pass);
    if (manifest_.pieces.size() != count || blocks.size() == count) manifest_.pieces.assign(count, {});
    for (const std::uint32_t block : blocks) {
        const fs::path path = path_of(pass, block);
        const PieceHeader header = read_piece_header(path, piece_limits(manifest_));
        manifest_.pieces[block] = {pass, header.vertices, header.faces, read_checksum(path)};
    }
    manifest_.passes = pass + 1;
    if (is_decimating_ && has_target() && pass == 0) note_thresholds();
    if (is_log(pass)) note_cut(pass);
    write_manifest(manifest_, folder_, blocks_.output);
    remove_passes_before(pass);
}

void BlockRun::note_thresholds() {
    const std::vector<PieceHeader> pieces = headers();
    const auto at = [&](double share) { return threshold_at(pieces, share * static_cast<double>(target())); };
    manifest_.thresholds = {at(kSeamsAbove), at(kFirstLogAbove), at(kSecondLogAbove)};
}

void BlockRun::note_cut(std::uint32_t pass) {
    std::vector<fs::path> paths;
    for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block) paths.push_back(path_of(pass, block));
    const auto left = static_cast<std::uint64_t>(left_by_cut(pass) * static_cast<double>(target()));
    const std::vector<std::uint64_t> made = cut(paths, face_count(), left);
    for (std::size_t block = 0; block < made.size(); ++block) manifest_.pieces[block].collapses = made[block];
}

/// Removes parts of the survey, and pieces that the manifest does not name, of passes before this one.
void BlockRun::remove_passes_before(std::uint32_t pass) {
    std::set<std::string> used;
    for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block)
        used.insert(path_of(manifest_.pieces[block].pass, block).filename());
    std::error_code ignored;
    std::vector<fs::path> unused;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        const std::string name = entry.path().filename();
        const auto number = pass_of(name);
        const bool is_old_piece = number && *number < pass && !used.contains(name);
        if (is_old_piece || name.starts_with(kSurveyPart) || name == kLastStart || name == kCopied)
            unused.push_back(entry.path());
    }
    for (const fs::path& path : unused) fs::remove(path, ignored);
}

void BlockRun::reconstruct_pass() {
    if (!has_samples_)
        throw Error(ErrorCode::kInput, folder_.string() +
                                           ": its samples, or the hashes of those of the input, are "
                                           "missing; remove the folder, and run again");
    const BlockGrid blocks = grid(0);
    require_block_memory(manifest_.source, volume_->shape, manifest_.initial_faces, manifest_.block_cells, options_);
    const std::vector<IndexBox> sweeps = plan_sweeps(blocks, volume_->shape, manifest_.initial_faces, options_,
                                                     std::max(tasks_.processes(), parts_for_restarts(blocks.count())));
    std::vector<std::uint32_t> all(blocks.count());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::uint32_t> before{0};  // blocks of the sweeps before
    for (const IndexBox& sweep : sweeps) before.push_back(before.back() + BlockGrid::count(sweep));
    if (on_progress_) on_progress_({"reconstruct", 0, blocks.count()});
    while (const auto task = tasks_.next(static_cast<std::uint32_t>(sweeps.size())))
        sweep_blocks(blocks, sweeps[*task], before[*task]);
    end_pass(0, all);
}

/// Makes the pieces of a box of blocks that are not there; `done` blocks come before it.
void BlockRun::sweep_blocks(const BlockGrid& blocks, IndexBox sweep, std::uint32_t done) {
    // Layers of blocks that are all there need not be swept again.
    const int axis = volume_->shape.axis();
    std::set<std::uint32_t> missing;
    blocks.for_blocks(sweep, [&](std::uint32_t block) {
        if (!is_there(header_of(0, block))) missing.insert(block);
    });
    if (missing.empty()) return;
    done += BlockGrid::count(sweep);
    std::uint32_t low = sweep.high[axis], high = 0;
    for (const std::uint32_t block : missing) {
        const std::uint32_t layer = blocks.place(block)[axis];
        low = std::min(low, layer);
        high = std::max(high, layer + 1);
    }
    sweep.low[axis] = low;
    sweep.high[axis] = high;
    done -= BlockGrid::count(sweep);
    OwnFaces faces(*volume_, blocks, sweep, options_);
    Chunk own;
    while (const auto block = faces.next(own)) {
        if (missing.contains(*block)) keep(reconstructed(blocks, header_of(0, *block), std::move(own)));
        give_back_freed_memory();
        if (on_progress_) on_progress_({"reconstruct", ++done, blocks.count()});
    }
}

/// Pass 0 of a block.
Piece BlockRun::reconstructed(const BlockGrid& blocks, PieceHeader header, Chunk faces) {
    BlockChunk block{.cells = blocks.cells(header.block),
                     .lattice = volume_->shape.lattice,
                     .sweep = manifest_.sweep,
                     .chunk = std::move(faces)};
    const auto made = static_cast<double>(block.chunk.faces.size());
    if (is_decimating_) simplify_low(block, target_.share(), simplify_options());
    if (is_decimating_ && (blocks.count() == 1 || !has_target())) {
        header.stopped = simplify_to(block, has_target() ? target() : 0, simplify_options());
    } else if (is_decimating_) {
        const double left = static_cast<double>(block.chunk.faces.size()) + 1;
        const double share = target_.share() * made / left;
        header.left = try_thresholds(block, std::min(share, 1.0) * kTrialsBelow, simplify_options());
    }
    return piece_of(block, blocks, header);
}

BlockRun::PiecesBefore BlockRun::pieces_before() const {
    std::vector<PieceHeader> found = headers();
    std::vector<Box> boxes;
    for (const PieceHeader& piece : found) boxes.push_back(piece.box);
    return {std::move(found), {piece_grid(manifest_), std::move(boxes)}};
}

/// A block out of the pieces of the pass before.
Piece BlockRun::remade(const PieceHeader& header, const PiecesBefore& before, const std::vector<double>& shares,
                       const SimplifyBlock& simplify) {
    const BlockGrid blocks = grid(header.pass);
    BlockGatherer gatherer(blocks, header.block);
    before.map.for_pieces_at(blocks.reach(header.block), [&](std::uint32_t n) {
        gatherer.add(read_entry(manifest_, folder_, n), shares.empty() ? 0 : shares[n]);
    });
    BlockChunk block{
        .cells = blocks.cells(header.block), .lattice = volume_->shape.lattice, .sweep = manifest_.sweep, .chunk = {}};
    gatherer.take(block);
    if (const std::string problem = misfit_of(block.chunk, volume_->background, options_.cap); !problem.empty())
        throw Error(ErrorCode::kInput, fmt::format("{}: the pieces at block {} do not fit together: {}; remove the "
                                                   "folder, and run again",
                                                   folder_.string(), header.block, problem));
    PieceHeader own = header;
    own.stopped = simplify(block, gatherer.goal());
    return piece_of(block, blocks, own);
}

void BlockRun::seam_pass() {
    const PiecesBefore before = pieces_before();
    const BlockGrid blocks = grid(kSeams);
    // No block goes so far that all together could end below the target.
    std::vector<double> least;
    if (has_target())
        least = shares_at(before.headers, std::min(double(target() + 2 * blocks.count()), double(face_count())));
    const auto simplify = [&](BlockChunk& block, double goal) {
        if (!has_target()) return simplify_to(block, 0, simplify_options());
        simplify_up_to(block, manifest_.thresholds.seams, static_cast<std::uint64_t>(goal) + 1, simplify_options());
        return StopReason::kTarget;
    };
    run_pass(kSeams, "seams", longest_first(blocks, before.map, before.headers),
             [&](const PieceHeader& header) { return remade(header, before, least, simplify); });
}

/// Simplifies on from the pass before, seams too; the collapses stay in logs until the cut.
void BlockRun::log_pass(std::uint32_t pass) {
    const double to = threshold_of_log(manifest_.thresholds, pass);
    const PiecesBefore before = pieces_before();
    const auto simplify = [&](BlockChunk& block, double) { return simplify_and_log(block, to, simplify_options()); };
    run_pass(pass, "rims", longest_first(grid(pass), before.map, before.headers),
             [&](const PieceHeader& header) { return remade(header, before, {}, simplify); });
}

void BlockRun::cut_pass(std::uint32_t pass) {
    std::vector<std::uint32_t> all(manifest_.pieces.size());
    std::iota(all.begin(), all.end(), 0);
    run_pass(pass, "cut", all, [&](const PieceHeader& header) {
        Piece piece = read_entry(manifest_, folder_, header.block);
        const StopReason stopped = piece.header.stopped;
        piece.header = header;
        piece.header.stopped = stopped;
        make_collapses(piece, manifest_.pieces[header.block].collapses.value_or(0));
        return piece;
    });
}

/// Removes files that runs which were killed have left half-written.
void BlockRun::remove_parts() {
    std::error_code ignored;
    const std::vector<fs::directory_entry> all(fs::directory_iterator(folder_, ignored), fs::directory_iterator{});
    for (const auto& entry : all) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.') && name.find(".part-") != std::string::npos) fs::remove(entry.path(), ignored);
    }
}

void BlockRun::complete() {
    bool is_over_error = false;
    for (const PieceHeader& piece : headers()) {
        manifest_.error_bound = std::max<double>(manifest_.error_bound, piece.error_bound);
        is_over_error = is_over_error || piece.stopped == StopReason::kMaxError;
    }
    manifest_.faces = face_count();
    manifest_.vertices = count_vertices(manifest_, folder_);
    manifest_.stopped = !is_decimating_                               ? StopReason::kNoneAsked
                        : has_target() && manifest_.faces <= target() ? StopReason::kTarget
                        : is_over_error                               ? StopReason::kMaxError
                                                                      : StopReason::kTopology;
    manifest_.is_complete = true;
    remove_passes_before(manifest_.passes);
    remove_parts();
    write_manifest(manifest_, folder_, blocks_.output);
}

BlockReport reconstruct_blocks(const OpenSections& open, const ReconstructOptions& options, const BlockOptions& blocks,
                               BlockTasks& tasks, const std::function<void(const BlockProgress&)>& on_progress) {
    return BlockRun(open, options, blocks, tasks, on_progress).run();
}

}  // namespace regionmesh
