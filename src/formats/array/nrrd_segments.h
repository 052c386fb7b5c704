// Segments in the header of a .seg.nrrd file, as 3D Slicer writes them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/array/array_file.h"
#include "formats/array/header_fields.h"

namespace regionmesh::formats {

/// A segment; `label` is its value in its layer.
struct NrrdSegment {
    std::uint64_t number = 0;
    std::string name = {};
    InputLabel label = 1;
    std::uint32_t layer = 0;
    std::optional<std::uint32_t> colour = {};
};

/// By number. Segments of versions that wrote no label values are layers of their own, with label 1.
std::vector<NrrdSegment> segments_of(const HeaderFields& values);

/// Adds the names and colours of the segments in a layer.
void take_segments(const std::vector<NrrdSegment>& segments, std::uint32_t in_layer, ArrayFile& array);

/// All segments of a file with several layers as one volume. Each keeps its label if all labels differ, and otherwise
/// has its rank, from 1. `priority`: of join_layers(). `array` describes the file.
std::unique_ptr<SectionReader> join_segments(
    const std::vector<NrrdSegment>& segments, std::uint64_t layers, const ArrayFile& array,
    const std::function<std::unique_ptr<SectionReader>(std::uint32_t layer)>& open_layer,
    const std::vector<std::string>& priority);

}  // namespace regionmesh::formats
