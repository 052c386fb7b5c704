// Files of parts of a survey.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "blocks/survey.h"
#include "regionmesh/output_file.h"

namespace regionmesh {

/// A hash of numbers.
std::uint64_t fingerprint_of(std::span<const std::uint64_t> numbers);

/// A part of a survey on its way from the process that made it to the first: numbers of 64 bits. Its name says which
/// samples: a run that goes on may have another number of processes, or other --memory.
std::filesystem::path part_path(const std::filesystem::path& folder, const IndexBox& box);

void write_part(const PartSurvey& part, const std::filesystem::path& path, const OutputOptions& options);

/// Nothing for a file that is not there, or is damaged.
std::optional<PartSurvey> find_part(const std::filesystem::path& path, const VolumeInfo& volume, const IndexBox& box);

}  // namespace regionmesh
