// The last stage of a run over a folder of pieces: its model is checked, and compared with the samples.
#include <algorithm>

#include "blocks/block_run.h"
#include "blocks/join.h"
#include "cells/label_census.h"
#include "regionmesh/error.h"

namespace regionmesh {

namespace fs = std::filesystem;

/// As a run without blocks checks its model. The copy of the samples is not needed after that.
void BlockRun::check_result() {
    if (on_progress_) on_progress_({"check", 0, 1});
    CheckOptions own;
    own.boundary_is_open = !options_.cap;
    own.background = volume_->background;
    own.threads = options_.threads;
    own.label_text = [&](Label label) { return labels_.text(labels_.input(label)); };
    if (has_samples_ && options_.cap && has_room_for_section()) report_.samples = compare_samples(own.oracle.emplace());
    report_.check = check_block_folder(folder_, own);
    if (count_vertices(manifest_, folder_) != manifest_.vertices)
        throw Error(ErrorCode::kInput, manifest_path(folder_).string() + ": says " +
                                           std::to_string(manifest_.vertices) +
                                           " vertices, which is not what the pieces have; remove the folder, and run "
                                           "again");
    std::error_code ignored;
    fs::remove(folder_ / kStagedLabels, ignored);
}

/// Of labels, dense and those of the model, and the row before.
bool BlockRun::has_room_for_section() const {
    constexpr std::uint64_t kPerSample = sizeof(InputLabel) + 3 * sizeof(Label);
    const auto [u, v, w] = manifest_.sweep.axes;
    return std::uint64_t{manifest_.lattice.size[u]} * manifest_.lattice.size[v] * kPerSample <= options_.memory / 2;
}

/// Also counts what the labels say of the topology of the model.
SampleAgreement BlockRun::compare_samples(LabelOracle& oracle) {
    constexpr std::uint64_t kFaceBytes = 400, kFewest = 10'000, kMost = 4'000'000;  // faces held at once
    VolumeInfo info;
    info.source = manifest_.source;
    info.lattice = manifest_.lattice;
    info.sweep = manifest_.sweep;
    const auto sections = boxes_->open({{}, info.lattice.size});
    const auto [u, v, w] = info.sweep.axes;
    const std::uint32_t last = info.lattice.size[w] - 1;
    std::vector<Label> low(std::size_t{info.lattice.size[u]} * info.lattice.size[v]), high(low.size());
    std::vector<InputLabel> given(low.size());
    LabelCensus census(volume_->shape.lattice, info.sweep, volume_->strips);
    SampleAgreement agreement;
    std::uint32_t section = 0;
    agreement.contradictions = voxelise_block_folder(
        folder_, info, volume_->background,
        [&](std::span<const Label> found) {
            low.swap(high);
            sections->next(high);
            if (section > 0) census.add(low, high, section == last);
            ++section;
            std::ranges::transform(high, given.begin(), [&](Label label) { return labels_.input(label); });
            add_samples(agreement, labels_, volume_->background, given, found);
        },
        std::clamp(options_.memory / 4 / kFaceBytes, kFewest, kMost));
    oracle = census.oracle();
    return agreement;
}

}  // namespace regionmesh
