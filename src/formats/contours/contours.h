// Planar polygons round regions, section by section.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// A closed polygon; its last point need not repeat the first.
struct Contour {
    std::uint32_t region = 0;
    double z = 0;
    std::vector<std::array<double, 2>> points = {};
};

/// Contours of a region in one section add up by the even-odd rule: one within another is a hole, and one within the
/// hole an island.
struct ContourSet {
    std::vector<InputLabel> labels = {};  // of the regions
    LabelNames names = {};
    std::optional<double> metres = {};  // in the unit of the points
    std::vector<Contour> contours = {};
};

/// Whether the first row of a table has columns for label, contour, x, y and z. False for a file that cannot be read.
bool holds_contours(const std::filesystem::path& path);

/// Throws Error(kInput) naming file and row, or region and contour.
ContourSet read_contour_table(const std::filesystem::path& path);
ContourSet read_contour_json(const std::filesystem::path& path);

/// The samples inside contours, on a lattice with a margin of one sample that is empty. Sections lie at those of the
/// contours where they are equally far apart; otherwise at the smallest distance, each as the nearest of the file is.
std::unique_ptr<SectionReader> contour_sections(const std::filesystem::path& path, ContourSet set,
                                                const ReadOptions& options);

}  // namespace regionmesh::formats
