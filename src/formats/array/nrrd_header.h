// The header of NRRD files: https://teem.sourceforge.net/nrrd/format.html
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/chunked/stored_samples.h"
#include "formats/input_file.h"
#include "regionmesh/label_names.h"
#include "regionmesh/lattice.h"

namespace regionmesh::formats {

/// Names of segments in one layer, as 3D Slicer writes them.
using SegmentNames = std::map<std::uint32_t, LabelNames>;

struct NrrdHeader {
    StoredSamples samples;  // of layer 0; the others are `layer_count` components or blocks
    Lattice lattice;
    std::uint32_t layer_count = 1;
    std::string layer_kind;  // "list", "RGB-color", or nothing where the header does not say
    bool has_layers_first = true;
    SegmentNames names;
};

/// Throws Error(kInput) naming the file for what is no label volume: reals, more or fewer than two or three axes in
/// space, encodings other than raw, gzip and text, a singular map.
NrrdHeader read_nrrd_header(const InputFile& file);

}  // namespace regionmesh::formats
