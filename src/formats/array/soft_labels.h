// Labels made of reals: of one grey volume by thresholds, of several shares or distances by the largest.
#pragma once

#include <memory>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// The number of thresholds that a sample reaches; 0 for NaN. Requires rising thresholds. Volumes whose reader knows
/// integers alone are compared as such (VolumeInfo::has_ordered_reals).
std::unique_ptr<SectionReader> threshold_sections(std::unique_ptr<SectionReader> reader,
                                                  std::vector<double> thresholds);

/// The label of the volume with the largest sample, the first of equal ones: its rank from 0, or from 1 with
/// `has_background`. Where no sample reaches `least`, 0. `info` describes the whole: its lattice and its sweep become
/// those of the volumes. Throws Error(kInput) for volumes of different lattices.
std::unique_ptr<SectionReader> argmax_sections(std::vector<std::unique_ptr<SectionReader>> readers, VolumeInfo info,
                                               double least, bool has_background);

}  // namespace regionmesh::formats
