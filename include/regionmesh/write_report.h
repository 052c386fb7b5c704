// The JSON report of a run.
#pragma once

#include <filesystem>
#include <string>

#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/report.h"
#include "regionmesh/voxelise.h"

namespace regionmesh {

/// JSON text, two spaces of indent, a newline at the end; a number that is not finite is null. `regions[]` stand in
/// order of `label`, a number in the signedness of the input; those with a name have it.
std::string report_json(const Report& report, const LabelTable& labels, const LabelNames& names = {});

/// The check part alone (`check --json`): quality, regions, region_pairs, quadruple_points_inside, violations and
/// violation_counts. With `samples` also samples, samples_wrong, samples_contradicting, dice and
/// dice_of_regions[].
std::string check_json(const CheckReport& report, const LabelTable& labels, const LabelNames& names = {},
                       const SampleAgreement* samples = nullptr);

/// Writes `text` under a temporary name beside `path`, then renames; writes a device or pipe in place. Throws
/// Error(kOutput).
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace regionmesh
