#include "regionmesh/select_sections.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "regionmesh/error.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

[[noreturn]] void refuse(const VolumeInfo& volume, const std::string& text) {
    throw Error(ErrorCode::kInput, volume.source + ": " + text);
}

/// The range along one axis; a range without samples or outside the volume is refused.
std::pair<std::uint32_t, std::uint32_t> samples_along(const VolumeInfo& volume, const SampleRange& range, int axis) {
    const std::uint32_t size = volume.lattice.size[axis], end = range.end == 0 ? size : range.end;
    if (range.first < end && end <= size) return {range.first, end};
    refuse(volume, "--roi " + std::to_string(range.first) + ":" + std::to_string(end) + " along " + "xyz"[axis] +
                       " is not within the " + std::to_string(size) +
                       " samples; give a part of 0:" + std::to_string(size));
}

/// Indices along the axes of the lattice, not whole, of a place.
Vec3 index_of(const Lattice& lattice, Vec3 place) {
    const Vec3 along = IntoAxes(lattice)(place);
    return {along.x / lattice.spacing.x, along.y / lattice.spacing.y, along.z / lattice.spacing.z};
}

Vec3 corner_of(const Vec3& low, const Vec3& high, int corner) {
    return {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z};
}

/// Whether each axis of the lattice lies along one of the coordinates, in either direction.
bool lies_along_axes(const Lattice& lattice) {
    constexpr double kRounding = 1e-6;
    return std::ranges::all_of(
        lattice.direction, [](double d) { return std::abs(d) < kRounding || std::abs(std::abs(d) - 1) < kRounding; });
}

/// Makes `samples` smaller: the samples in `box`, or, in an oblique lattice, the smallest block that encloses it. An
/// index within 1e-4 of a whole number counts as that number: headers of NIfTI files have places in single precision.
void cut_to_box(const VolumeInfo& volume, const std::array<LengthRange, 3>& box, IndexBox& samples) {
    constexpr double kRounding = 1e-4;
    const Box extent = volume.lattice.extent();
    Vec3 low = extent.low, high = extent.high;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::max(low[axis], box[axis].low);
        high[axis] = std::min(high[axis], box[axis].high);
        if (!(low[axis] <= high[axis]))
            refuse(volume, std::string("--box holds no sample: along ") + "xyz"[axis] + " the samples lie from " +
                               std::to_string(extent.low[axis]) + " to " + std::to_string(extent.high[axis]));
    }
    Box indices;
    for (int corner = 0; corner < 8; ++corner) indices.add(index_of(volume.lattice, corner_of(low, high, corner)));
    const bool is_inside = lies_along_axes(volume.lattice);
    for (int axis = 0; axis < 3; ++axis) {
        const double low_index = indices.low[axis], high_index = indices.high[axis],
                     first = is_inside ? std::ceil(low_index - kRounding) : std::floor(low_index + kRounding),
                     last = is_inside ? std::floor(high_index + kRounding) : std::ceil(high_index - kRounding);
        const double begin = std::max<double>(first, samples.low[axis]),
                     end = std::min<double>(last + 1, samples.high[axis]);
        if (begin >= end) refuse(volume, "--box holds no sample; give a larger one, or leave out --roi");
        samples.low[axis] = static_cast<std::uint32_t>(begin);
        samples.high[axis] = static_cast<std::uint32_t>(end);
    }
}

ReaderPointer cropped(ReaderPointer reader, const Selection& selection) {
    const VolumeInfo& volume = reader->info();
    IndexBox samples;
    for (int axis = 0; axis < 3; ++axis)
        std::tie(samples.low[axis], samples.high[axis]) = samples_along(volume, selection.roi[axis], axis);
    const bool has_box = std::ranges::any_of(
        selection.box, [](const LengthRange& range) { return std::isfinite(range.low) || std::isfinite(range.high); });
    if (has_box) cut_to_box(volume, selection.box, samples);
    if (samples.low == std::array<std::uint32_t, 3>{} && samples.high == volume.lattice.size) return reader;
    return crop_sections(std::move(reader), samples);
}

bool is_in(InputLabel label, const LabelRange& range, bool is_unsigned) {
    const InputLabelOrder less{is_unsigned};
    return !less(label, range.first) && !less(range.last, label);
}

/// Ranges that no volume has.
void require_ranges(const VolumeInfo& volume, const Selection& selection) {
    for (const std::uint32_t samples : selection.downsample)
        if (samples == 0) refuse(volume, "--downsample 0: no samples that become one; give 1 or more");
    for (const LengthRange& range : selection.box)
        if (!(range.low <= range.high)) refuse(volume, "--box ends before it begins; give LOW:HIGH");
    const bool is_unsigned = volume.type == SampleType::kU64;
    for (const LabelRange& range : selection.labels)
        if (!is_in(range.first, range, is_unsigned))
            refuse(volume, "--labels " + std::to_string(range.first) + "-" + std::to_string(range.last) +
                               " ends before it begins; give the smaller label first");
}

ReaderPointer relabelled(ReaderPointer reader, const Selection& selection) {
    if (selection.merge.empty() && selection.labels.empty()) return reader;
    const bool is_unsigned = reader->info().type == SampleType::kU64;
    return relabel_sections(std::move(reader), [selection, is_unsigned](InputLabel label) {
        const auto merged = selection.merge.find(label);
        if (merged != selection.merge.end()) label = merged->second;
        const bool is_kept =
            selection.labels.empty() || std::ranges::any_of(selection.labels, [&](const LabelRange& range) {
                return is_in(label, range, is_unsigned);
            });
        return is_kept ? label : selection.rest;
    });
}

}  // namespace

std::unique_ptr<SectionReader> select_sections(std::unique_ptr<SectionReader> reader, const Selection& selection) {
    if (!reader) throw Error(ErrorCode::kUsage, "select_sections: no reader; give one");
    require_ranges(reader->info(), selection);
    reader = relabelled(cropped(std::move(reader), selection), selection);
    if (selection.downsample != std::array<std::uint32_t, 3>{1, 1, 1})
        reader = downsample_sections(std::move(reader), selection.downsample, selection.rest);
    if (selection.min_region > 1) reader = merge_small_regions(std::move(reader), selection.min_region);
    if (selection.names.empty() && selection.merge.empty()) return reader;
    VolumeInfo info = reader->info();
    if (info.type != SampleType::kU64 && !selection.merge.empty()) info.type = SampleType::kI64;  // holds any new label
    for (const auto& [label, name] : selection.names) info.names[label] = name;
    return describe_sections(std::move(reader), std::move(info));
}

}  // namespace regionmesh
