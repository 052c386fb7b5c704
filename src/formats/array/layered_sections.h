// A volume whose regions come in layers that may overlap: masks, a file each, or the segments of one file.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// Regions that do not overlap one another, as a volume of its own. All layers have one lattice.
struct Layer {
    std::unique_ptr<SectionReader> reader;
    std::map<InputLabel, std::uint32_t> regions = {};  // by stored label, which is not 0: index among all regions
    std::optional<std::uint32_t> only = {};            // or the region of all samples other than 0, which are alike
};

/// Where several regions claim a sample, it gets the last, or the first of those that `priority` names, by name or by
/// label; VolumeInfo::overlaps counts such samples. `info` describes the whole: its lattice and its sweep become those
/// of the layers. `labels` has the label of each region. Throws Error(kInput) naming the file for layers of another
/// lattice and a `priority` that names no region, and while it reads for labels of no region.
std::unique_ptr<SectionReader> join_layers(std::vector<Layer> layers, VolumeInfo info, std::vector<InputLabel> labels,
                                           const std::vector<std::string>& priority);

/// Gives `info` the lattice, the sweep and the place in space that the parts have in common, and the memory of all.
/// Throws Error(kInput) naming the file where they have not.
void take_lattice(const std::vector<const VolumeInfo*>& parts, VolumeInfo& info);

/// The ranks of regions with these labels, from 1: the later the higher, above them those in `priority`, its first the
/// highest. A word of it is a label or a name in `info`, capitals or not; throws Error(kInput) for one that is neither.
std::vector<std::uint32_t> ranks_of(const VolumeInfo& info, const std::vector<InputLabel>& labels,
                                    const std::vector<std::string>& priority);

/// The smallest unsigned type of the labels, or kI64.
SampleType label_type_of(const std::vector<InputLabel>& labels);

}  // namespace regionmesh::formats
