#include "blocks/block_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "blocks/block_size.h"
#include "blocks/gather.h"
#include "blocks/join.h"
#include "blocks/own_faces.h"
#include "blocks/quotas.h"
#include "cells/label_census.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/process.h"
#include "stream/plan.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"
#include "volume/room_reader.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// The labels of the volume, while blocks are reconstructed.
constexpr const char* kLabels = "volume.labels";
/// Passes that trim the last faces, at most.
constexpr std::uint32_t kMostTrims = 8;

void require_fit(const std::string& source, const ReconstructOptions& options) {
    const auto refuse = [&](const char* what) {
        throw Error(ErrorCode::kInput,
                    source + ": " + what + " needs the whole surface at once, which blocks do not have; leave it out");
    };
    if (options.preserve_volume) refuse("--preserve-volume");
    if (options.improve) refuse("--improve");
}

}  // namespace

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
    {
        const Timer timer(report_.seconds);
        if (tasks_.is_first()) begin();
        tasks_.end_phase();
        manifest_ = *read_manifest(folder_);
        job_ = job_of(manifest_.identity);
        if (!manifest_.is_complete) {
            open_volume();
            run_passes();
            if (tasks_.is_first()) complete();
            tasks_.end_phase();
            manifest_ = *read_manifest(folder_);
        }
    }
    report_.pieces = static_cast<std::uint32_t>(manifest_.pieces.size());
    report_.block_cells = manifest_.block_cells;
    report_.initial_faces = manifest_.initial_faces;
    report_.final_faces = manifest_.faces;
    report_.final_vertices = manifest_.vertices;
    report_.stopped = manifest_.stopped;
    report_.error_bound = manifest_.error_bound;
    report_.peak_bytes = peak_resident_bytes();
    return report_;
}

void BlockRun::begin() {
    const auto there = read_manifest(folder_);
    if (there) {
        require_same_run(*there, blocks_.identity, folder_);
        manifest_ = *there;
    }
    if (manifest_.is_staged) return;
    // Nothing is written for an input that cannot be read.
    const std::unique_ptr<SectionReader> reader = open_();
    std::error_code error;
    if (!fs::is_directory(folder_, error)) fs::create_directory(folder_, error);
    if (error) throw Error(ErrorCode::kOutput, folder_.string() + ": cannot be made: " + error.message());
    if (!there && !fs::is_empty(folder_, error))
        throw Error(ErrorCode::kOutput, folder_.string() + ": holds other files; name an empty or a new folder");
    manifest_.identity = blocks_.identity;
    if (!there) write_manifest(manifest_, folder_, blocks_.output);
    stage(*reader);
}

/// Reads the input once: counts its faces and writes its labels.
void BlockRun::stage(SectionReader& reader) {
    std::optional<RoomReader> cleaned;
    if (options_.room > 0) cleaned.emplace(reader, options_.room, options_.threads);
    SectionReader& sections = cleaned ? static_cast<SectionReader&>(*cleaned) : reader;
    const VolumeInfo info = sections.info();
    require_lattice(info.source, info.lattice);
    require_fit(info.source, options_);
    const SourceShape shape = section_shape(info, cell_kind(options_), section_scale(info, options_));
    halo_of(shape, options_);  // refuses other filters before the work
    LabelTable labels = table_for(info);
    const std::vector<Label> background = dense_background(options_.background, labels);
    LabelCensus census(info.lattice, info.sweep, {.cap = options_.cap, .background = background, .cells = shape.cells});
    std::uint32_t strips = 0;
    StagedLabels::write(sections, labels, folder_ / kLabels, blocks_.output,
                        [&](std::span<const Label> low, std::span<const Label> high, bool is_last) {
                            census.add(low, high, is_last);
                            if (on_progress_) on_progress_({"read", ++strips, shape.strip_count});
                        });
    write_labels(labels, folder_, blocks_.output);
    manifest_.is_staged = true;
    manifest_.lattice = info.lattice;
    manifest_.sweep = info.sweep;
    manifest_.source = info.source;
    manifest_.is_unsigned = labels.is_unsigned();
    manifest_.label_count = labels.size();
    manifest_.space = info.space;
    manifest_.names = info.names;
    manifest_.background = options_.background;
    manifest_.scale_z = shape.scale_z;
    manifest_.initial_faces = census.face_count();
    manifest_.block_cells =
        blocks_.block_cells > 0 ? blocks_.block_cells : default_block_cells(shape, census.face_count(), options_);
    require_block_count(info, manifest_.block_cells);
    write_manifest(manifest_, folder_, blocks_.output);
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
    if (manifest_.passes == 0) staged_.emplace(folder_ / kLabels, manifest_.lattice, manifest_.sweep);
    target_.total = manifest_.initial_faces;
    static const struct NoBoxes final : LabelBoxes {
        void read(const IndexBox&, std::uint32_t, std::span<Label>) const override {}
    } none;
    const StripOptions strips{.cap = options_.cap,
                              .background = background,
                              .cells = shape.cells,
                              .cuts = is_smoothed ? QuadCuts::kCones : QuadCuts::kBestQuality};
    const LabelBoxes& boxes = staged_ ? static_cast<const LabelBoxes&>(*staged_) : none;
    volume_.emplace(BlockVolume{boxes, shape, strips, labels_, background});
}

void BlockRun::run_passes() {
    if (manifest_.passes == 0) reconstruct_pass();
    if (!is_decimating_) return;
    if (has_target() && face_count() <= target()) return;
    if (manifest_.passes == 1 && manifest_.pieces.size() > 1) {
        const std::vector<PieceHeader> before = headers();
        // Each block may end below its goal by a face or two.
        const double aim = std::min(static_cast<double>(target()) + 2.0 * grid(1).count(), double(face_count()));
        seam_pass(has_target() ? shares_at_common_threshold(before, aim) : std::vector<double>(before.size(), 0.0));
    }
    if (has_target()) trim_passes();
}

std::uint64_t BlockRun::face_count() const {
    return std::accumulate(manifest_.pieces.begin(), manifest_.pieces.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const PieceEntry& piece) { return sum + piece.faces; });
}

BlockGrid BlockRun::grid(std::uint32_t pass) const {
    const bool is_shifted = pass > 0 && manifest_.pieces.size() != 1;
    return BlockGrid(volume_->shape.lattice, manifest_.block_cells, is_shifted ? manifest_.block_cells / 2 : 0);
}

BlockSimplifyOptions BlockRun::simplify_options() const {
    return {.simplify = regionmesh::simplify_options(options_, volume_->shape), .threads = options_.threads};
}

fs::path BlockRun::path_of(std::uint32_t pass, std::uint32_t block) const { return piece_path(folder_, pass, block); }

std::vector<PieceHeader> BlockRun::headers() const {
    std::vector<PieceHeader> found;
    for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block)
        found.push_back(read_piece_header(path_of(manifest_.pieces[block].pass, block)));
    return found;
}

/// Makes the pieces that are not there, shared with other processes.
void BlockRun::run_pass(std::uint32_t pass, const char* stage, const std::vector<std::uint32_t>& blocks,
                        const MakePiece& make) {
    const auto count = static_cast<std::uint32_t>(blocks.size());
    if (on_progress_) on_progress_({stage, 0, count});
    while (const auto task = tasks_.next(count)) {
        const std::uint32_t block = blocks[*task];
        PieceHeader header;
        header.job = job_;
        header.pass = pass;
        header.block = block;
        const fs::path path = path_of(pass, block);
        if (find_piece(path, header)) {
            ++report_.found;
        } else {
            Piece piece = make(header);
            write_piece(piece, path, blocks_.output);
            ++report_.made;
        }
        give_back_freed_memory();
        if (on_progress_) on_progress_({stage, *task + 1, count});
    }
    tasks_.end_phase();
    if (tasks_.is_first()) end_pass(pass, blocks);
    tasks_.end_phase();
    manifest_ = *read_manifest(folder_);
}

/// Notes the pieces of a pass in the manifest: from then on those before them are not needed.
void BlockRun::end_pass(std::uint32_t pass, const std::vector<std::uint32_t>& blocks) {
    const std::uint32_t count = grid(pass).count();
    manifest_.shift = pass > 0 && manifest_.pieces.size() != 1 ? manifest_.block_cells / 2 : 0;
    if (manifest_.pieces.size() != count || blocks.size() == count) manifest_.pieces.assign(count, {});
    for (const std::uint32_t block : blocks) {
        const fs::path path = path_of(pass, block);
        const PieceHeader header = read_piece_header(path);
        manifest_.pieces[block] = {pass, header.vertices, header.faces, read_checksum(path)};
    }
    manifest_.passes = pass + 1;
    write_manifest(manifest_, folder_, blocks_.output);
    remove_passes_before(pass);
}

/// Removes the labels, and pieces that the manifest does not name, of passes before this one.
void BlockRun::remove_passes_before(std::uint32_t pass) {
    std::set<std::string> used;
    for (std::uint32_t block = 0; block < manifest_.pieces.size(); ++block)
        used.insert(path_of(manifest_.pieces[block].pass, block).filename());
    std::error_code ignored;
    std::vector<fs::path> unused{folder_ / kLabels};
    for (const auto& entry : fs::directory_iterator(folder_)) {
        const std::string name = entry.path().filename();
        const auto number = pass_of(name);
        if (number && *number < pass && !used.contains(name)) unused.push_back(entry.path());
    }
    for (const fs::path& path : unused) fs::remove(path, ignored);
}

void BlockRun::reconstruct_pass() {
    const BlockGrid blocks = grid(0);
    std::vector<std::uint32_t> all(blocks.count());
    std::iota(all.begin(), all.end(), 0);
    run_pass(0, "reconstruct", all, [&](PieceHeader header) {
        BlockChunk block{.cells = blocks.cells(header.block),
                         .lattice = volume_->shape.lattice,
                         .sweep = manifest_.sweep,
                         .chunk = own_faces(*volume_, blocks, header.block, options_)};
        header.initial_faces = block.chunk.faces.size();
        if (is_decimating_) simplify_low(block, target_.share(), simplify_options());
        if (is_decimating_ && (blocks.count() == 1 || !has_target())) {
            header.is_at_limit = simplify_to(block, has_target() ? target() : 0, simplify_options());
        } else if (is_decimating_) {
            const double left = static_cast<double>(block.chunk.faces.size()) + 1;
            const double share = target_.share() * static_cast<double>(header.initial_faces) / left;
            header.left = try_thresholds(block, std::min(share, 1.0) / 2, simplify_options());
        }
        return piece_of(block, blocks, header);
    });
}

/// A block out of the pieces of the pass before, simplified to `goal` faces, or else to the shares of theirs.
Piece BlockRun::remade(const PieceHeader& header, const std::vector<PieceHeader>& before,
                       const std::vector<double>& shares, std::optional<std::uint64_t> goal) {
    const BlockGrid blocks = grid(header.pass);
    BlockGatherer gatherer(blocks, header.block);
    for (std::uint32_t n = 0; n < before.size(); ++n)
        if (before[n].faces > 0 && gatherer.needs(before[n].box))
            gatherer.add(read_piece(path_of(manifest_.pieces[n].pass, n)), shares[n]);
    BlockChunk block{
        .cells = blocks.cells(header.block), .lattice = volume_->shape.lattice, .sweep = manifest_.sweep, .chunk = {}};
    gatherer.take(block);
    if (!goal) goal = static_cast<std::uint64_t>(std::llround(gatherer.goal()));
    PieceHeader own = header;
    own.is_at_limit = simplify_to(block, *goal, simplify_options());
    return piece_of(block, blocks, own);
}

void BlockRun::seam_pass(const std::vector<double>& shares) {
    const std::vector<PieceHeader> before = headers();
    const BlockGrid blocks = grid(1);
    // Blocks with many faces round them first: they take longest, and ranks then end at about the same time.
    std::vector<std::uint64_t> faces(blocks.count());
    for (std::uint32_t block = 0; block < blocks.count(); ++block) {
        const BlockGatherer gatherer(blocks, block);
        for (const PieceHeader& piece : before)
            if (piece.faces > 0 && gatherer.needs(piece.box)) faces[block] += piece.faces;
    }
    std::vector<std::uint32_t> all(blocks.count());
    std::iota(all.begin(), all.end(), 0);
    std::ranges::stable_sort(all, [&](std::uint32_t a, std::uint32_t b) { return faces[a] > faces[b]; });
    run_pass(1, "seams", all, [&](const PieceHeader& header) { return remade(header, before, shares, {}); });
}

/// Takes the last faces above the target out of some blocks, with their rims as they are.
void BlockRun::trim_passes() {
    for (std::uint32_t pass = manifest_.passes; pass < 2 + kMostTrims && face_count() > target(); ++pass) {
        const std::vector<PieceHeader> before = headers();
        std::vector<std::uint64_t> faces;
        std::vector<bool> is_at_limit;
        for (const PieceHeader& piece : before) {
            faces.push_back(piece.faces);
            is_at_limit.push_back(piece.is_at_limit != 0);
        }
        const std::vector<std::uint64_t> goals = trimmed(faces, is_at_limit, target());
        std::vector<std::uint32_t> changing;
        for (std::uint32_t block = 0; block < goals.size(); ++block)
            if (goals[block] < faces[block]) changing.push_back(block);
        if (changing.empty()) return;
        const std::vector<double> unused(before.size());
        run_pass(pass, "trim", changing,
                 [&](const PieceHeader& header) { return remade(header, before, unused, goals[header.block]); });
    }
}

/// Removes files that runs which were killed have left half-written.
void BlockRun::remove_parts() {
    std::error_code ignored;
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.') && name.find(".part-") != std::string::npos) parts.push_back(entry.path());
    }
    for (const fs::path& path : parts) fs::remove(path, ignored);
}

void BlockRun::complete() {
    const std::vector<PieceHeader> last = headers();
    bool is_at_limit = false;
    for (const PieceHeader& piece : last) {
        manifest_.error_bound = std::max<double>(manifest_.error_bound, piece.error_bound);
        is_at_limit = is_at_limit || piece.is_at_limit != 0;
    }
    manifest_.faces = face_count();
    manifest_.vertices = count_vertices(manifest_, folder_);
    manifest_.stopped = !is_decimating_                               ? "none asked"
                        : has_target() && manifest_.faces <= target() ? "target"
                        : options_.max_error && is_at_limit           ? "max_error"
                                                                      : "topology";
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
