// What is done to sections before they are meshed: misaligned ones are moved, and gaps between far ones are filled.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// How sections are moved in their plane.
enum class AlignKind { kOff, kTranslate, kRigid };

/// Most sections that can be put between two.
inline constexpr std::uint32_t kMostBetween = 63;

struct PrepareOptions {
    std::optional<std::uint32_t> between = 0;  // sections put between each two; none: as many as make samples about as
                                               // far apart across sections as in them, where parts do not overlap from
                                               // section to section (docs/explanation/between.md), else 0
    AlignKind align = AlignKind::kOff;
    std::uint32_t threads = 0;  // 0: one per core; the result does not depend on it
    std::uint64_t memory = 0;   // bytes; where a section needs more, none are put between unless asked for; 0: no bound
};

/// How a section lies against its neighbours, in samples along the axes of the section; the angle is in radians, about
/// its middle.
struct SectionShift {
    double x = 0, y = 0, angle = 0;
};

/// What was done, and why.
struct PreparedSections {
    std::unique_ptr<SectionReader> reader;
    std::uint32_t between = 0;                 // sections put between each two
    std::uint64_t pairs = 0, pairs_apart = 0;  // of parts of neighbouring sections; those that do not overlap: 0, 0 if
                                               // they were not counted
    std::uint32_t sections_moved = 0;
    double largest_shift = 0;  // in samples
};

/// Opens the volume with its sections along an axis.
using OpenAlong = std::function<std::unique_ptr<SectionReader>(SweepChoice)>;

/// Opens a volume so that a section is what was cut: along `choice`, or, for kAuto, along far_axis(), else z. Along the
/// axis that `open` chooses where it cannot be read otherwise.
std::unique_ptr<SectionReader> open_as_cut(const OpenAlong& open, SweepChoice choice);

/// Opens the volume as it was cut, and prepares it; as `open` does by itself where nothing is to be done. May open the
/// volume three times, but once only if it cannot be rewound. Throws Error(kUsage) for options out of range or a volume
/// too large for them, Error(kInput) if aligning needs to read a volume twice that can be read once; and whatever
/// `open` throws.
///
/// Without alignment every sample of the volume keeps its label and its place: its lattice is part of the new one.
PreparedSections prepare_sections(const OpenAlong& open, SweepChoice choice, const PrepareOptions& options);

/// Pairs of parts of neighbouring sections, connected over sides and corners: those that overlap, and those that do
/// not, but lie near each other and are of a like size. Reads all sections, from the start. Requires can_rewind.
struct PartPairs {
    std::uint64_t overlapping = 0, apart = 0;
};
PartPairs count_part_pairs(SectionReader& reader);

/// How far each section lies off the trend of its neighbours. Shifts between neighbours are those with which most
/// samples agree; a slope that lasts over nine sections is trend. Reads all sections, from the start. Requires
/// can_rewind.
std::vector<SectionShift> find_jitter(SectionReader& reader, AlignKind kind);

/// Root mean square of x and y together, and the section that lies farthest off.
struct JitterSum {
    double rms = 0, largest = 0;
    std::uint32_t section = 0;
};
JitterSum summed(const std::vector<SectionShift>& jitter);

/// The sections between each two with which a model was made, if its samples have this spacing, and the axis across
/// them; none where the spacing is that of the input, or does not go into it.
struct BetweenAlong {
    std::uint32_t between;
    int axis;
};
std::optional<BetweenAlong> between_of_model(const Lattice& input, Vec3 spacing);

/// The axis along which samples are at least 1.5 times as far apart as along both others; none if there is none.
std::optional<int> far_axis(const Lattice& lattice);

}  // namespace regionmesh
