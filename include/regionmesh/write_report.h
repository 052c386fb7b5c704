// Reports as JSON: of a run, of a check, and of a comparison.
#pragma once

#include <filesystem>
#include <string>

#include "regionmesh/compare.h"
#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/report.h"
#include "regionmesh/voxelise.h"

namespace regionmesh {

// All functions return JSON text with an indent of two spaces and a newline at the end. Numbers that are not finite are
// null. Labels are numbers in the signedness of the input.

/// The report of a run. `regions[]` are sorted by `label`; a region with a name has `name`.
std::string report_json(const Report& report, const LabelTable& labels, const LabelNames& names = {});

/// The part of a check alone (`check --json`): quality, regions, region_pairs, quadruple_points_inside, violations and
/// violation_counts. With `samples` also samples, samples_wrong, samples_contradicting, dice and dice_of_regions[].
std::string check_json(const CheckReport& report, const LabelTable& labels, const LabelNames& names = {},
                       const SampleAgreement* samples = nullptr);

/// A comparison; docs/compare.md lists the keys. Regions, interfaces and lines are sorted by label; the exterior is
/// labels.exterior_label() and comes last in a list. Measures of a part that one model lacks are null, and so are its
/// distances; `only_in_a` and `only_in_b` name these parts.
std::string compare_json(const CompareReport& report);

/// Writes `text` under a temporary name in the folder of `path` and renames the file; writes a device or pipe in place.
/// Throws Error(kOutput).
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace regionmesh
