#include "formats/dicom/dicom_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/array/affine.h"
#include "formats/array/volume_size.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

constexpr double kMostOff = 0.05;  // of a spacing: a frame off the grid
constexpr double kMostDifference =
    1e-4;  // share, between numbers of frames that mean the same: less than kMostOff at sample 500
constexpr double kSameSection = 0.01;  // of the smallest distance that the file says: frames of one section
constexpr double kMostDrift = 1e-3;    // of the distance, over all sections, by which a rounded number may differ
constexpr double kRounding = 1e-12;
constexpr const char* kResample = "; resample the segmentation to one regular grid, in 3D Slicer for example";

/// Frames count from 1, as in DICOM.
[[noreturn]] void fail_frame(const std::string& source, std::size_t frame, const std::string& text) {
    fail(source, fmt::format("frame {}: {}", frame + 1, text));
}

/// Numbers that are there, and whose differences and products are finite.
template <std::size_t kCount>
bool are_usable(const std::array<double, kCount>& numbers) {
    return std::ranges::all_of(numbers, [](double number) { return std::abs(number) < 1e30; });
}

Vec3 position_of(const DicomFrame& frame) { return {frame.position[0], frame.position[1], frame.position[2]}; }

template <std::size_t kCount>
bool differ(const std::array<double, kCount>& a, const std::array<double, kCount>& b, double of) {
    for (std::size_t i = 0; i < kCount; ++i)
        if (!(std::abs(a[i] - b[i]) <= kMostDifference * of)) return true;
    return false;
}

void require_frame(const std::string& source, std::span<const DicomFrame> frames, std::size_t number) {
    const DicomFrame& frame = frames[number];
    const DicomFrame& first = frames.front();
    const auto require = [&](bool has, const char* what) {
        if (!has)
            fail_frame(source, number,
                       fmt::format("has no {}; export the segmentation with its place in the patient", what));
    };
    require(are_usable(frame.position), "position (ImagePositionPatient)");
    require(are_usable(frame.orientation), "orientation (ImageOrientationPatient)");
    require(are_usable(frame.pixel_spacing), "distance of samples (PixelSpacing)");
    if (differ(first.orientation, frame.orientation, 1))
        fail_frame(source, number,
                   fmt::format("its orientation ({}) is not that of frame 1 ({}){}", fmt::join(frame.orientation, ", "),
                               fmt::join(first.orientation, ", "), kResample));
    if (differ(first.pixel_spacing, frame.pixel_spacing, std::abs(first.pixel_spacing[0])))
        fail_frame(source, number,
                   fmt::format("its pixel spacing ({}) is not that of frame 1 ({}){}",
                               fmt::join(frame.pixel_spacing, ", "), fmt::join(first.pixel_spacing, ", "), kResample));
}

/// As it is where only rounding keeps it from length 1.
Vec3 unit(Vec3 v) {
    const double size = length(v);
    return std::abs(size - 1) < kRounding ? v : v / size;
}

/// Unit vectors along a row, a column and the sections.
Columns directions(const std::string& source, const DicomFrame& frame) {
    const auto& o = frame.orientation;
    const Vec3 row{o[0], o[1], o[2]}, column{o[3], o[4], o[5]};
    const auto is_unit = [](Vec3 v) { return std::abs(length(v) - 1) < kMostOff; };
    if (!is_unit(row) || !is_unit(column) || std::abs(dot(row, column)) > 1e-3) {
        fail_frame(
            source, 0,
            fmt::format("its orientation ({}) is not two perpendicular unit vectors; export the segmentation again",
                        fmt::join(o, ", ")));
    }
    return {unit(row), unit(column), unit(cross(row, column))};
}

bool is_distance(double number) { return std::isfinite(number) && number > 0; }

/// Heights along the normal at which frames lie, lowest first, each once.
std::vector<double> distinct_heights(std::vector<double> heights, double finest) {
    std::ranges::sort(heights);
    std::vector<double> distinct{heights.front()};
    for (const double height : heights)
        if (height - distinct.back() > kSameSection * finest) distinct.push_back(height);
    return distinct;
}

/// Number of distances of about `expected` between the lowest and the highest frame.
double count_distances(const std::vector<double>& heights, double expected) {
    double count = 0;
    for (std::size_t i = 1; i < heights.size(); ++i)
        count += std::max(1.0, std::round((heights[i] - heights[i - 1]) / expected));
    return count;
}

bool are_multiples(const std::vector<double>& heights, double distance) {
    return std::ranges::all_of(heights, [&](double height) {
        const double place = (height - heights.front()) / distance;
        return std::abs(place - std::round(place)) <= kMostOff;
    });
}

/// The mean distance, or the number in the file that it is but for rounding. If heights are no multiples of either,
/// that of the file.
double distance_of_sections(const DicomFrame& frame, const std::vector<double>& heights) {
    const double range = heights.back() - heights.front();
    double smallest = range;
    for (std::size_t i = 1; i < heights.size(); ++i) smallest = std::min(smallest, heights[i] - heights[i - 1]);
    double first = 0;
    for (const double expected : {frame.between_slices, smallest}) {
        if (!is_distance(expected)) continue;
        const double count = count_distances(heights, expected), mean = range / count;
        if (count > double{kMaxAxisSamples}) continue;
        if (first == 0) first = expected;
        if (std::abs(mean - expected) > kMostOff * expected || !are_multiples(heights, mean)) continue;
        for (const double said : {frame.between_slices, frame.thickness})
            if (is_distance(said) && std::abs(range - count * said) <= kMostDrift * said) return said;
        return mean;
    }
    return first > 0 ? first : smallest;
}

/// By frame; `columns` are perpendicular. Refuses a frame that is off the grid.
std::vector<std::uint32_t> sections_of(const std::string& source, std::span<const DicomFrame> frames,
                                       const Columns& columns, Vec3 origin) {
    std::vector<std::uint32_t> sections(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Vec3 off = position_of(frames[i]) - origin;
        std::array<double, 3> places;  // in spacings
        for (int axis = 0; axis < 3; ++axis) places[axis] = dot(off, columns[axis]) / length2(columns[axis]);
        const double section = std::round(places[2]);
        const double most = std::max({std::abs(places[0]), std::abs(places[1]), std::abs(places[2] - section)});
        if (!(most <= kMostOff)) {
            fail_frame(source, i,
                       fmt::format("its position ({}) is {:.2f} spacings off the grid of the others{}",
                                   fmt::join(frames[i].position, ", "), most, kResample));
        }
        sections[i] = static_cast<std::uint32_t>(section);
    }
    return sections;
}

}  // namespace

DicomGrid find_grid(const std::string& source, const DicomObject& object, std::span<const DicomFrame> frames,
                    const std::optional<Vec3>& spacing) {
    for (std::size_t i = 0; i < frames.size(); ++i) require_frame(source, frames, i);
    const DicomFrame& first = frames.front();
    const Columns along = directions(source, first);
    const auto [between_rows, between_columns] = first.pixel_spacing;
    if (!is_distance(between_rows) || !is_distance(between_columns))
        fail_frame(source, 0,
                   fmt::format("its pixel spacing is {} and {}; give two positive numbers, in mm", between_rows,
                               between_columns));

    std::vector<double> heights(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
        heights[i] = dot(position_of(frames[i]) - position_of(first), along[2]);
    double distance = is_distance(first.between_slices) ? first.between_slices
                      : is_distance(first.thickness)    ? first.thickness
                      : spacing                         ? spacing->z
                                                        : 0;
    double finest = std::min(between_rows, between_columns);
    for (const double said : {first.between_slices, first.thickness})
        if (is_distance(said)) finest = std::min(finest, said);
    const std::vector<double> distinct = distinct_heights(heights, finest);
    if (distinct.size() > 1) distance = distance_of_sections(first, distinct);
    if (!is_distance(distance))
        fail(source, "has one section, and no SpacingBetweenSlices or SliceThickness; give --spacing X,Y,Z");

    const auto lowest = static_cast<std::size_t>(std::ranges::min_element(heights) - heights.begin());
    const double last = std::round((distinct.back() - distinct.front()) / distance);
    if (!(last < static_cast<double>(kMaxAxisSamples)))
        fail(source, fmt::format("its frames lie {} mm apart, {} sections; check the positions of the frames",
                                 distinct.back() - distinct.front(), last));
    const Vec3 origin = position_of(frames[lowest]);
    const Columns columns{along[0] * between_columns, along[1] * between_rows, along[2] * distance};
    DicomGrid grid;
    grid.lattice.size = checked_size(source, {object.columns, object.rows, static_cast<std::uint64_t>(last) + 1});
    set_affine(source, "place of its frames", "export the segmentation again", columns, origin, grid.lattice);
    grid.sections = sections_of(source, frames, columns, origin);
    return grid;
}

}  // namespace regionmesh::formats
