// Labels of the fine samples by the smooth surface of the coarse ones.
#pragma once

#include <array>
#include <cstdint>

#include "denoise/candidates.h"
#include "denoise/coarse_lattice.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Meshes the coarse sections and smooths the surface in its lattice, strip by strip. Each fine sample that lies on
/// another side of this surface than the coarse sample that it was copied from is a candidate. Labels are those of
/// `labels`. Memory: the window of the lattice filter (docs/explanation/memory.md) for the coarse sections.
void find_candidates(SectionReader& coarse, const std::array<CoarseAxis, 3>& axes, LabelTable& labels,
                     std::uint32_t threads, ItemsBySection<Candidate>& candidates);

}  // namespace regionmesh
