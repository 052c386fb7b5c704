// Hashes of the samples that a run was begun with: a run that goes on reads no others.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "blocks/label_boxes.h"
#include "formats/input_file.h"
#include "regionmesh/label_table.h"
#include "regionmesh/output_file.h"

namespace regionmesh {

/// Sums of hashes of samples, each of its label in the input and its place in the volume, over tiles of kTile x kTile
/// samples of one section. Boxes that share the samples of a volume have sums that add up to those of the whole, so it
/// does not matter how they share them. Changes by chance are noticed; the hash is not cryptographic.
class SampleHashes {
public:
    static constexpr std::uint32_t kTile = 64;

    /// Of the samples of a box, none of which is added yet.
    SampleHashes(const std::array<std::uint32_t, 3>& volume, const Sweep& sweep, const IndexBox& box);

    /// Adds samples of a section of the volume: `section` has those of the box; those beyond `end` along the axes are
    /// left out.
    void add(std::uint32_t number, std::span<const Label> section, const LabelTable& labels,
             const std::array<std::uint32_t, 3>& end);
    void add(std::uint32_t number, std::span<const Label> section, const LabelTable& labels) {
        add(number, section, labels, box_.high);
    }
    /// Adds the sums of a box inside of this one.
    void add(const SampleHashes& part);

    /// Section by section up to the last one that was added.
    std::vector<std::uint64_t>& sums() { return sums_; }
    std::span<const std::uint64_t> sums() const { return sums_; }
    /// Their number once all sections of the box have been added.
    std::uint64_t count() const { return offset(tiles_.high[2]); }
    /// Tiles along the rows of a section and across them.
    std::uint32_t width() const { return tiles_.high[0] - tiles_.low[0]; }
    std::uint32_t height() const { return tiles_.high[1] - tiles_.low[1]; }

private:
    std::size_t section_tiles() const { return std::size_t{width()} * height(); }
    std::size_t offset(std::uint32_t number) const { return (number - tiles_.low[2]) * section_tiles(); }
    void grow_to(std::uint32_t number);

    std::array<std::uint32_t, 3> volume_;
    Sweep sweep_;
    IndexBox box_;
    IndexBox tiles_;  // along rows, across them, in sections
    std::vector<std::uint64_t> sums_;
};

/// The samples of other boxes, each section compared with the hashes in a file before it is used.
class ComparedLabels final : public LabelBoxes {
public:
    struct Run {
        std::filesystem::path folder;
        std::string source;  // of the samples
        Lattice lattice;
        Sweep sweep;
        std::uint64_t fingerprint;  // of all hashes
    };
    /// All must outlive it. Throws Error(kInput) where the file is missing or not the one of the run.
    ComparedLabels(const LabelBoxes& boxes, const LabelTable& labels, const Run& run);

    /// Throws Error(kInput) that names samples that differ. Reads whole tiles.
    std::unique_ptr<BoxSections> open(const IndexBox& box) const override;

private:
    const LabelBoxes& boxes_;
    const LabelTable& labels_;
    Run run_;
    formats::InputFile file_;
};

/// The file of the hashes, in the folder of pieces.
inline constexpr const char* kSampleHashes = "samples.hashes";

/// Writes the hashes of a whole volume into a folder of pieces. Returns their fingerprint.
std::uint64_t write_sample_hashes(const SampleHashes& hashes, const std::filesystem::path& folder,
                                  const OutputOptions& options);

}  // namespace regionmesh
