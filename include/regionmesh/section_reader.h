// Labelled sections, pulled one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/lattice.h"

namespace regionmesh {

enum class SampleType { kU1, kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64 };

/// Samples that several regions claim, by pairs of labels, the smaller first. A sample of three regions is in two
/// pairs.
struct Overlaps {
    std::map<std::pair<InputLabel, InputLabel>, std::uint64_t> samples = {};

    std::uint64_t total() const {
        std::uint64_t sum = 0;
        for (const auto& [pair, count] : samples) sum += count;
        return sum;
    }
};

/// What a reader knows before the first section is read.
struct VolumeInfo {
    std::string source = {};  // path as given, for messages
    std::string format = {};  // "npy", "nifti", "png", "tiff", "raw", "array"
    SampleType type = SampleType::kU8;
    Lattice lattice = {};                               // axes of the file, independent of the sweep
    Sweep sweep = {};                                   // order in which sections are read
    bool can_rewind = true;                             // sections can be read again from the start
    std::uint64_t held_bytes = 0;                       // memory for reading ahead; 0: about one section
    std::array<bool, 3> can_sweep{false, false, true};  // axes along which sections can be read
    Space space = Space::kUnknown;                      // of the lattice
    std::optional<double> metres = {};                  // in its unit of length, where the file says it
    LabelNames names = {};                              // given by the file, or by a table next to it
    LabelColours colours = {};                          // likewise
    std::vector<std::filesystem::path> files = {};      // of samples, where `source` is a header that names them
    std::shared_ptr<const Overlaps> overlaps = {};      // of masks, as far as sections were read; of other volumes none
    std::uint32_t layer_count = 1;                      // of the file, one of which is read: volumes, channels or times
    bool has_ordered_reals = false;  // labels stand for reals in their order, as ReadOptions::threshold needs them
    std::string warning = {};        // what the reader decided that the user may not expect: a line, or empty
};

/// What a model made of the volume says of its coordinates.
inline Coordinates coordinates_of(const VolumeInfo& info) { return {info.space, info.metres, info.lattice.spacing}; }

/// Pull interface of every volume. A reader of files holds a bounded number of sections, never the whole volume.
class SectionReader {
public:
    virtual ~SectionReader() = default;

    virtual const VolumeInfo& info() const = 0;

    /// Fills `section` with the next section: size[axes[0]] * size[axes[1]] samples, axes[0] fastest. Returns false
    /// after all size[axes[2]] sections, not before. Throws Error(kInput) naming file and section.
    virtual bool next(std::span<InputLabel> section) = 0;

    /// Returns to the first section. Requires info().can_rewind.
    virtual void rewind() = 0;

    /// Makes the box the whole volume, with the lattice cropped(), if the samples round it need not be read: those of
    /// an array that is not compressed, or in chunks or tiles. The next section is the first. Returns false, and
    /// changes nothing, where it cannot. Requires a box within the volume that is not empty.
    virtual bool crop(const IndexBox&) { return false; }

    std::uint32_t section_width() const { return samples_along(info().sweep.axes[0]); }
    std::uint32_t section_height() const { return samples_along(info().sweep.axes[1]); }
    std::uint32_t section_count() const { return samples_along(info().sweep.axes[2]); }

private:
    std::uint32_t samples_along(int axis) const { return info().lattice.size[static_cast<std::size_t>(axis)]; }
};

/// Throws Error(kInput) where a reader ends before its last section: `is_there` is what next() returned for `section`.
void require_section(bool is_there, const VolumeInfo& info, std::uint32_t section);

/// Throws Error(kUsage) unless a section of width x height samples is given room for as many labels; `what` names the
/// source.
void require_section_size(const std::string& what, std::size_t labels, std::uint32_t width, std::uint32_t height);

}  // namespace regionmesh
