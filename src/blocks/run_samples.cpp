// What a run over a folder of pieces reads: the samples, and how far it was when it was last started.
#include <algorithm>
#include <span>

#include "blocks/block_run.h"
#include "blocks/sample_hashes.h"
#include "blocks/staged_labels.h"
#include "formats/input_file.h"

namespace regionmesh {

namespace fs = std::filesystem;

namespace {

/// The boxes of a volume whose blocks are all there.
struct NoBoxes final : LabelBoxes {
    std::unique_ptr<BoxSections> open(const IndexBox&) const override { return nullptr; }
};

}  // namespace

/// The samples that the run was begun with, and no others; false where they are no longer there.
bool BlockRun::open_boxes() {
    boxes_ = std::make_unique<NoBoxes>();
    const fs::path staged = folder_ / kStagedLabels;
    if (!manifest_.hashes_hash || (!manifest_.is_in_place && !fs::exists(staged))) return false;
    if (manifest_.is_in_place)
        given_ = std::make_unique<LabelsInPlace>(open_, labels_);
    else
        given_ = std::make_unique<StagedLabels>(staged, manifest_.lattice, manifest_.sweep);
    boxes_ = std::make_unique<ComparedLabels>(
        *given_, labels_,
        ComparedLabels::Run{.folder = folder_,
                            .source = manifest_.is_in_place ? manifest_.source : staged.string(),
                            .lattice = manifest_.lattice,
                            .sweep = manifest_.sweep,
                            .fingerprint = *manifest_.hashes_hash});
    return true;
}

/// In how many parts a single process sweeps the volume: twice as many after each start that made no piece before it
/// was ended, so that a run that is ended again and again comes to its end.
std::uint32_t BlockRun::parts_for_restarts(std::uint32_t blocks) const {
    if (tasks_.processes() > 1) return 1;
    struct Start {
        std::uint32_t pieces = 0, parts = 1;
    };
    std::uint32_t pieces = 0;
    for (std::uint32_t block = 0; block < blocks; ++block) pieces += fs::exists(path_of(0, block));
    const fs::path path = folder_ / kLastStart;
    Start last;
    bool is_first = true;
    if (std::error_code missing; fs::file_size(path, missing) == sizeof last && !missing) {
        const formats::InputFile file(path);
        is_first = file.read(0, std::as_writable_bytes(std::span(&last, 1))) != sizeof last;
    }
    Start now{pieces, is_first ? 1 : std::clamp(last.parts, 1u, blocks)};
    if (!is_first && pieces == last.pieces) now.parts = std::min(2 * now.parts, blocks);
    OutputFile file(path, blocks_.output);
    file.write({reinterpret_cast<const char*>(&now), sizeof now});
    file.commit();
    return now.parts;
}

}  // namespace regionmesh
