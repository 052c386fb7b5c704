// Chooses what to model: part of a volume, some of its labels, joined labels, fewer samples, no small regions.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Samples from `first` to `end` - 1 along an axis. An `end` of 0 stands for the number of samples.
struct SampleRange {
    std::uint32_t first = 0, end = 0;
};

/// Coordinates along an axis of the model, both ends included, in the unit of the spacing.
struct LengthRange {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

/// Labels from `first` to `last`, both included.
struct LabelRange {
    InputLabel first = 0, last = 0;
};

/// What to do with a volume before anything else, in the order of the members.
struct Selection {
    std::array<SampleRange, 3> roi{};          // samples to keep along x, y, z
    std::array<LengthRange, 3> box{};          // and their positions; not along the axes: the samples that enclose it
    std::map<InputLabel, InputLabel> merge{};  // old label to new label
    LabelNames names{};                        // of new labels; replaces the names in the file
    std::vector<LabelRange> labels{};          // labels to keep, as they are after `merge`; none: all
    InputLabel rest = 0;                       // label of samples whose label is not kept
    std::array<std::uint32_t, 3> downsample{1, 1, 1};  // samples along x, y, z that become one
    std::uint64_t min_region = 0;                      // connected regions of fewer samples join a neighbour
};

/// Sections of the part of the volume that `selection` chooses; `reader` itself where it chooses all. Section by
/// section: holds at most downsample[sweep] sections more.
///
/// `downsample` takes the label of the most samples in a block. Of labels with equally many it takes one other than
/// `rest`, then the smallest. Blocks at the high sides may have fewer samples. The new sample lies in the middle of a
/// whole block.
///
/// `min_region` counts the samples of connected regions, `rest` included. Samples are connected as in the mesh: along
/// edges, and along the diagonals of the cells that Kuhn's tetrahedra have. The smallest region is first; it takes the
/// label with which its interface has the largest area, the smallest of several. It reads the volume three times, and
/// needs 12 bytes for each run of samples that starts a region, then about 300 bytes for each small region.
///
/// Throws Error(kInput) for ranges outside the volume, a range without samples, and `min_region` of a volume that can
/// be read once only; and whatever the reader throws.
std::unique_ptr<SectionReader> select_sections(std::unique_ptr<SectionReader> reader, const Selection& selection);

/// The same sections with another description, which differs from the reader's in names, colours and place alone.
std::unique_ptr<SectionReader> describe_sections(std::unique_ptr<SectionReader> reader, VolumeInfo info);

/// Sections with the labels that ReconstructOptions::room gives to samples near the boundaries of regions; `reader`
/// itself for a `room` of 0. For what is compared with such a model. `threads`: 0 for one per core.
std::unique_ptr<SectionReader> clean_sections(std::unique_ptr<SectionReader> reader, double room,
                                              std::uint32_t threads = 0);

}  // namespace regionmesh
