// A volume that is held whole, for formats whose samples come in any order.
#pragma once

#include <memory>
#include <vector>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// `labels` are those of all samples, x fastest, then y. Requires info.source, format, type and lattice; the options
/// give the spacing and the sweep.
std::unique_ptr<SectionReader> open_held(std::vector<InputLabel> labels, VolumeInfo info, const ReadOptions& options);

}  // namespace regionmesh::formats
