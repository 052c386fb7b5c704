// DICOM segmentations: https://dicom.nema.org/medical/dicom/current/output/chtml/part03/sect_A.51.html
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "formats/array/numbered_sections.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/dicom/dicom_file.h"
#include "formats/dicom/dicom_grid.h"
#include "formats/dicom/dicom_samples.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSegmentation = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr double kMostSegments = 65535;
constexpr const char* kLabelMap = "1.2.840.10008.5.1.4.1.1.66.7";

/// Memory that regionmesh-dicom takes for the functional groups of a frame: 100 MB for 50,000 frames of 100 segments.
constexpr std::uint64_t kGroupBytes = 2048;

/// A frame in its section; `label` for the samples in it, of a binary segmentation.
struct PlacedFrame {
    std::uint32_t section;
    std::uint32_t frame;
    std::uint16_t label;
};

void require_segmentation(const fs::path& path, const DicomObject& object) {
    if (object.sop_class != kSegmentation && object.sop_class != kLabelMap) {
        fail(path,
             fmt::format("is a DICOM object of modality {}, not a segmentation; segment the images, in 3D Slicer for "
                         "example, and name the file of the segmentation",
                         object.modality.empty() ? "unknown" : object.modality));
    }
    const bool is_binary = object.kind == "BINARY", is_map = object.kind == "LABELMAP";
    if (object.kind == "FRACTIONAL") {
        fail(path,
             "is a fractional segmentation, whose samples are probabilities or shares; threshold it to a binary "
             "segmentation, in 3D Slicer for example");
    }
    if (!is_binary && !is_map)
        fail(path, fmt::format("its segmentation type is '{}'; write BINARY or LABELMAP", object.kind));
    if (!(is_binary ? object.bits == 1 : object.bits == 8 || object.bits == 16)) {
        fail(path, fmt::format("its samples have {} bits; {} segmentations have {}; export it again", object.bits,
                               object.kind, is_binary ? "1" : "8 or 16"));
    }
    if (!object.obstacle.empty()) fail(path, object.obstacle);
}

/// Ordered by section, then by segment: where segments overlap, the highest number is written last.
std::vector<PlacedFrame> place_frames(const fs::path& path, bool is_binary, std::span<const DicomFrame> frames,
                                      const std::vector<std::uint32_t>& sections) {
    std::vector<PlacedFrame> placed(frames.size());
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        const double segment = is_binary ? frames[i].segment : 0;
        if (is_binary && !(segment >= 1 && segment <= kMostSegments))
            fail(path, fmt::format("frame {}: has no number of a segment (ReferencedSegmentNumber); export the "
                                   "segmentation again",
                                   i + 1));
        placed[i] = {sections[i], i, static_cast<std::uint16_t>(segment)};
    }
    const auto key = [](const PlacedFrame& frame) { return std::pair(frame.section, frame.label); };
    std::ranges::stable_sort(placed, {}, key);
    const auto twice = std::ranges::adjacent_find(placed, {}, key);
    if (twice != placed.end()) {
        fail_section(path, twice->section,
                     fmt::format("frames {} and {} both hold {}; write one frame of a segment for each section",
                                 twice->frame + 1, std::next(twice)->frame + 1,
                                 is_binary ? fmt::format("segment {}", twice->label) : "its labels"));
    }
    return placed;
}

class DicomSections final : public NumberedSections {
public:
    DicomSections(std::unique_ptr<DicomFile> file, VolumeInfo info, const DicomObject& object,
                  std::vector<PlacedFrame> frames)
        : NumberedSections(std::move(info)),
          file_(std::move(file)),
          bits_(object.bits),
          padding_(object.padding),
          nothing_(object.names.contains(0) && padding_ > 0 ? padding_ : 0),
          frame_bytes_((std::uint64_t{object.rows} * object.columns * object.bits + 7) / 8),
          frames_(std::move(frames)) {}

    /// Samples in several segments. Reads the sections with several frames.
    std::uint64_t count_overlaps() {
        std::uint64_t count = 0;
        Bytes held;
        for (std::size_t i = 0; i + 1 < frames_.size(); ++i) {
            if (frames_[i].section != frames_[i + 1].section) continue;
            held = samples(frames_[i]);
            Bytes twice(held.size());
            for (; i + 1 < frames_.size() && frames_[i].section == frames_[i + 1].section; ++i) {
                const Bytes next = samples(frames_[i + 1]);
                for (std::size_t b = 0; b < held.size(); ++b) {
                    twice[b] |= held[b] & next[b];
                    held[b] |= next[b];
                }
            }
            for (const std::byte bits : twice) count += std::popcount(std::to_integer<unsigned>(bits));
        }
        return count;
    }

    void warn(std::string text) { info_.warning = std::move(text); }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        std::ranges::fill(section, nothing_);
        auto frame = std::ranges::lower_bound(frames_, number, {}, &PlacedFrame::section);
        for (; frame != frames_.end() && frame->section == number; ++frame) {
            const Bytes stored = samples(*frame);
            if (bits_ == 1)
                set_label(stored, frame->label, section);
            else
                copy_labels(stored, bits_, section);
            if (bits_ > 1 && padding_ > 0) std::ranges::replace(section, padding_, nothing_);
        }
    }

    Bytes samples(const PlacedFrame& frame) {
        Bytes stored = file_->samples(frame.frame);
        if (stored.size() != frame_bytes_)
            fail_section(info_.source, frame.section, "changed while it was read; start again");
        return stored;
    }

    std::unique_ptr<DicomFile> file_;
    std::uint32_t bits_;
    std::int64_t padding_;
    InputLabel nothing_;  // label of no segment: 0, unless that is the number of a segment of a label map
    std::uint64_t frame_bytes_;
    std::vector<PlacedFrame> frames_;
};

}  // namespace

std::unique_ptr<SectionReader> open_dicom(const fs::path& path, const ReadOptions& options) {
    auto file = std::make_unique<DicomFile>(path);
    const DicomObject object = file->object();
    require_segmentation(path, object);
    const std::vector<DicomFrame> frames = file->take_frames();
    if (frames.size() != object.frames) {
        fail(path,
             fmt::format("has {} frames, but describes {} (PerFrameFunctionalGroupsSequence); export the segmentation "
                         "again",
                         object.frames, frames.size()));
    }
    if (frames.empty()) fail(path, "holds no frame; export a segmentation with at least one segment");
    const DicomGrid grid = find_grid(path, object, frames, options.spacing);
    VolumeInfo info =
        volume_info(path, "dicom", object.bits == 8 ? SampleType::kU8 : SampleType::kU16, grid.lattice.size);
    info.lattice = grid.lattice;
    info.space = Space::kLps;
    info.metres = 1e-3;
    info.names = object.names;
    info.colours = object.colours;
    apply_options(info, options);
    const std::uint64_t samples = std::uint64_t{object.rows} * object.columns;
    info.held_bytes = 3 * (samples * object.bits / 8 + 1)  // here, in the socket and in regionmesh-dicom
                      + frames.size() * (sizeof(PlacedFrame) + kGroupBytes) + object.held_bytes;
    const bool is_binary = object.bits == 1;
    auto reader = std::make_unique<DicomSections>(std::move(file), std::move(info), object,
                                                  place_frames(path, is_binary, frames, grid.sections));
    if (const std::uint64_t count = is_binary ? reader->count_overlaps() : 0) {
        reader->warn(fmt::format(
            "{} samples are in several segments; they have the label of the highest segment number", count));
    }
    return reader;
}

}  // namespace regionmesh::formats
