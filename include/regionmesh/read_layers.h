// Drill holes as layers: surfaces between units of known age, interpolated between the holes, as labelled sections.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/limits.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/read_tetrahedra.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/select_sections.h"

namespace regionmesh {

/// How to interpolate between drill holes; all optional.
struct LayerOptions {
    std::string units = "auto";  // units from young to old, with commas; auto: as in the holes; -UNIT: not modelled
    std::optional<Vec3> spacing = {};    // spacing of the samples; none: 1/100 of the longer side, 1/200 of the height
    std::array<LengthRange, 3> box{};    // box of the model; without a bound: that of the holes, and a margin
    std::filesystem::path terrain = {};  // ESRI ASCII grid of the heights of the ground; none: between the collars
    SweepChoice sweep = SweepChoice::kAuto;
    std::uint64_t memory = kDefaultMemory;  // most bytes of the heights of all surfaces and of the terrain
    std::uint64_t max_work = kMostWork;     // samples, and evaluations of the surfaces
    std::uint32_t threads = 0;              // 0: one per core. The result does not depend on it
};

/// What open_layers() found.
struct LayerSummary {
    std::vector<std::string> units = {};  // units from young to old
    double ordered_share =
        1;  // of the logged length that lies in its unit when every hole has each unit once, in order
};

/// Samples of a model of layers on a lattice. The base of each unit is interpolated between the holes by kriging, and
/// lies nowhere above the base of the next younger unit; above the ground samples have the label 0. Units that are
/// words get labels 1, 2, ... from young to old. docs/how-to/boreholes.md describes the method.
///
/// Reads `columns` of `table`. Throws Error(kInput) that names file and row, and what to do; also where units are not
/// in the order for half of the logged length, for more than 3000 holes, and where `memory` or `max_work` do not
/// suffice: before the heights take memory.
std::unique_ptr<SectionReader> open_layers(const std::filesystem::path& path, const TetrahedraOptions& table,
                                           const LayerOptions& layers = {}, LayerSummary* summary = nullptr);

}  // namespace regionmesh
