#include "formats/array/volume_size.h"

#include <cmath>
#include <limits>

#include "formats/input_file.h"
#include "volume/choose_sweep.h"

namespace regionmesh::formats {
namespace {

Sweep required_sweep(const VolumeInfo& info, SweepChoice choice, const std::string& remedy) {
    const std::optional<Sweep> sweep = choose_sweep(info, choice);
    if (!sweep)
        fail(info.source,
             std::string("cannot be read along ") + "xyz"[static_cast<int>(choice) - 1] + ", only along z; " + remedy);
    return *sweep;
}

}  // namespace

std::array<std::uint32_t, 3> checked_size(const std::filesystem::path& path, const std::array<std::uint64_t, 3>& size) {
    std::array<std::uint32_t, 3> checked{};
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] == 0)
            fail(path, "empty volume: " + size_text(size) + " samples; write one with at least one sample");
        if (size[axis] > kMaxAxisSamples) {
            fail(path, std::string("size along ") + "xyz"[axis] + " is " + std::to_string(size[axis]) +
                           ", more than 2^31 - 1; check the header or crop the volume");
        }
        checked[axis] = static_cast<std::uint32_t>(size[axis]);
    }
    return checked;
}

std::uint64_t volume_bytes(const std::filesystem::path& path, const std::array<std::uint32_t, 3>& size,
                           std::uint64_t sample_bytes) {
    const std::uint64_t plane = std::uint64_t{size[0]} * size[1];
    if (plane > std::numeric_limits<std::int64_t>::max() / sample_bytes / size[2]) {
        fail(path, size_text({size[0], size[1], size[2]}) + " samples are more than any file holds; check the header");
    }
    return plane * size[2] * sample_bytes;
}

VolumeInfo volume_info(const std::filesystem::path& source, const std::string& format, SampleType type,
                       const std::array<std::uint32_t, 3>& size) {
    VolumeInfo info;
    info.source = source.string();
    info.format = format;
    info.type = type;
    info.lattice.size = size;
    return info;
}

void order_reals(const ReadOptions& options, SampleFormat& format, VolumeInfo& info) {
    if (options.threshold.empty() && !options.argmax) return;
    format.is_ordered = true;
    info.has_ordered_reals = true;
    info.type = label_type(format);
}

ReadOptions without_choice(const ReadOptions& options) {
    ReadOptions rest = options;
    rest.layer.reset();
    return rest;
}

std::string size_text(const std::array<std::uint64_t, 3>& size) {
    return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
}

void apply_options(VolumeInfo& info, const ReadOptions& options, const std::string& remedy) {
    if (options.layer.value_or(0) != 0)
        fail(info.source, "has one layer, 0; --layer " + std::to_string(*options.layer) + " is none");
    if (options.spacing) {
        for (int axis = 0; axis < 3; ++axis) {
            const double spacing = (*options.spacing)[axis];
            if (!std::isfinite(spacing) || spacing <= 0) {
                fail(info.source, std::string("spacing along ") + "xyz"[axis] + " is " + std::to_string(spacing) +
                                      "; give three positive numbers");
            }
        }
        info.lattice.spacing = *options.spacing;
    }
    info.sweep = required_sweep(info, options.sweep, remedy);
    const std::uint64_t samples = section_samples(info, info.sweep);
    if (samples > kMaxSectionSamples) {
        fail(info.source, "a section has " + std::to_string(samples) + " samples, more than 2^31; crop the volume");
    }
}

}  // namespace regionmesh::formats
