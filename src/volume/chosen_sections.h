// Readers that change the sections of another reader. Each reads as many of its sections as it needs for the next one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "regionmesh/section_reader.h"

namespace regionmesh {

using ReaderPointer = std::unique_ptr<SectionReader>;

/// The samples of a box; reads the others, too, where the reader cannot leave them out (SectionReader::crop()).
/// Requires a box within the volume that is not empty.
ReaderPointer crop_sections(ReaderPointer reader, const IndexBox& box);

/// Labels replaced by `new_label(old)`, which is called once for each label.
ReaderPointer relabel_sections(ReaderPointer reader, std::function<InputLabel(InputLabel)> new_label);

/// A volume with one sample along one axis, repeated along it: a plate, one spacing thick. Others as they are.
ReaderPointer as_plate(ReaderPointer reader);

/// The lattice in another space: turned about z where the volume says that it is in the other one.
ReaderPointer turn_sections(ReaderPointer reader, Space space);

/// Blocks of samples as one sample: see Selection::downsample. Requires factors of 1 or more.
ReaderPointer downsample_sections(ReaderPointer reader, const std::array<std::uint32_t, 3>& factors, InputLabel rest);

/// Small regions given to neighbours: see Selection::min_region. Reads the volume twice at once.
ReaderPointer merge_small_regions(ReaderPointer reader, std::uint64_t min_samples);

/// Specks given to the neighbour with the largest interface: parts of a label of few samples, connected as in the mesh,
/// where the label has a part kLargerPart times as large. Cavities of a region are parts of another label.
inline constexpr std::uint64_t kLargerPart = 20, kMostFoundSpeck = 16;
struct SpeckSize {
    std::uint64_t most = 0;  // samples of a speck; 0: from the histogram of sizes, up to kMostFoundSpeck
};
struct SpeckCounts {
    std::uint64_t specks = 0, samples = 0;
    std::uint64_t largest = 0;  // samples of a speck
};
class SpecklessSections : public SectionReader {
public:
    virtual const SpeckCounts& counts() const = 0;
    /// Samples of the last section that were in specks, in order.
    virtual std::span<const std::uint32_t> changed() const = 0;
};
/// Holds a reference to the reader, which can be rewound. Reads the volume twice at once.
std::unique_ptr<SpecklessSections> merge_specks(SectionReader& reader, const SpeckSize& size);

}  // namespace regionmesh
