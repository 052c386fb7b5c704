// One run over a folder of pieces: passes over blocks, each made of the pieces of the pass before.
#pragma once

#include <optional>

#include "blocks/begin_run.h"
#include "blocks/block_faces.h"
#include "blocks/manifest.h"
#include "blocks/piece.h"
#include "blocks/piece_map.h"
#include "blocks/quotas.h"
#include "blocks/simplify_block.h"
#include "regionmesh/blocks.h"
#include "stream/target.h"

namespace regionmesh {

/// Pass 0 reconstructs the blocks and simplifies each up to a low threshold, its rim locked. Pass 1 simplifies blocks
/// shifted by half a block, up to the threshold at which all keep a little more than the target. Pass 2 simplifies the
/// blocks of pass 0 again and logs the collapses; pass 3 makes those that lead to a little more than the target. Passes
/// 4 and 5 repeat this in shifted blocks: the log goes beyond the target, the cut ends at it. So what lies at the walls
/// of pass 2 is simplified as far as all else. Where more than the target is left, such pairs follow, up to higher
/// thresholds. Without a target the run ends after pass 1; one block needs pass 0 alone. A pass is complete when all of
/// its pieces are; then the manifest says so, and the pieces before it go.
class BlockRun {
public:
    BlockRun(const OpenSections& open, const ReconstructOptions& options, const BlockOptions& blocks, BlockTasks& tasks,
             const OnBlocks& on_progress);

    BlockReport run();

private:
    /// What a pass makes of a block.
    using MakePiece = std::function<Piece(const PieceHeader&)>;
    /// What it does to the faces of a block. `goal` is the sum of the shares of their pieces, 0 without shares. Returns
    /// whether topology, quality or the largest error ended it.
    using SimplifyBlock = std::function<StopReason(BlockChunk&, double goal)>;

    /// What a pass makes its pieces of.
    struct PiecesBefore {
        std::vector<PieceHeader> headers;
        PieceMap map;
    };

    void open_volume();
    bool open_boxes();
    void run_passes();
    void run_pass(std::uint32_t pass, const char* stage, const std::vector<std::uint32_t>& blocks,
                  const MakePiece& make);
    PieceHeader header_of(std::uint32_t pass, std::uint32_t block) const;
    bool is_there(const PieceHeader& header);
    void keep(Piece piece);
    void note_thresholds();
    void note_cut(std::uint32_t pass);
    void note_pieces(std::uint32_t pass, const std::vector<std::uint32_t>& blocks);
    void end_pass(std::uint32_t pass, const std::vector<std::uint32_t>& blocks);
    void require_samples_unchanged();
    void remove_passes_before(std::uint32_t pass);
    std::uint32_t parts_for_restarts(std::uint32_t blocks) const;
    void reconstruct_pass();
    void sweep_blocks(const BlockGrid& blocks, IndexBox sweep, std::uint32_t done);
    Piece reconstructed(const BlockGrid& blocks, PieceHeader header, Chunk faces);
    void seam_pass();
    void log_pass(std::uint32_t pass);
    void cut_pass(std::uint32_t pass);
    void complete();
    void check_result();
    bool has_room_for_section() const;
    SampleAgreement compare_samples(LabelOracle& oracle);

    bool has_target() const { return target_.faces || target_.reduce; }
    std::uint64_t target() const { return target_.of(manifest_.initial_faces); }
    std::uint64_t face_count() const;
    std::uint32_t shift(std::uint32_t pass) const;
    BlockGrid grid(std::uint32_t pass) const;
    BlockSimplifyOptions simplify_options() const;
    std::vector<PieceHeader> headers() const;
    std::filesystem::path path_of(std::uint32_t pass, std::uint32_t block) const;
    PiecesBefore pieces_before() const;
    Piece remade(const PieceHeader& header, const PiecesBefore& before, const std::vector<double>& shares,
                 const SimplifyBlock& simplify);
    void remove_parts();

    const OpenSections& open_;
    ReconstructOptions options_;
    const BlockOptions& blocks_;
    BlockTasks& tasks_;
    const OnBlocks& on_progress_;
    std::filesystem::path folder_;
    std::uint64_t job_ = 0;
    Manifest manifest_;
    Target target_;
    bool is_decimating_;
    LabelTable labels_;
    bool has_samples_ = false;
    std::unique_ptr<LabelBoxes> given_, boxes_;  // those of the input or of the copy; compared with hashes
    std::optional<BlockVolume> volume_;
    BlockReport report_;
};

}  // namespace regionmesh
