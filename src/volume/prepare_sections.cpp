#include "regionmesh/prepare_sections.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regionmesh/error.h"
#include "volume/align_reader.h"
#include "volume/between_reader.h"
#include "volume/section_parts.h"
#include "volume/section_shift.h"

namespace regionmesh {
namespace {

using ReaderPointer = std::unique_ptr<SectionReader>;

constexpr std::uint64_t kBytesPerSample = 64;  // of two sections and what lies between them
constexpr double kFar = 1.5;                   // times the larger of the other spacings
constexpr double kApartShare = 0.2;  // of the pairs of parts: with fewer, the surface fits better without help
constexpr SweepChoice kChoices[] = {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};

/// Spacing across sections over the larger one in them.
double ratio_of(const VolumeInfo& info) {
    const auto [u, v, w] = info.sweep.axes;
    const Vec3& spacing = info.lattice.spacing;
    return spacing[w] / std::max(spacing[u], spacing[v]);
}

/// Sections that make samples about as far apart across sections as in them; 0 where they are.
std::uint32_t between_of(const VolumeInfo& info) {
    const auto steps = std::lround(std::min(ratio_of(info), kMostBetween + 1.0));
    return steps >= 2 ? static_cast<std::uint32_t>(steps - 1) : 0;
}

/// Calls visit(section, next) for neighbours, from the start.
template <class Visit>
void visit_neighbours(SectionReader& reader, Visit&& visit) {
    reader.rewind();
    std::vector<InputLabel> low(std::size_t{reader.section_width()} * reader.section_height()), high(low.size());
    for (std::uint32_t n = 0; n < reader.section_count(); ++n, std::swap(low, high)) {
        require_section(reader.next(high), reader.info(), n);
        if (n > 0) visit(low, high);
    }
    reader.rewind();
}

ReaderPointer aligned(ReaderPointer reader, AlignKind kind, PreparedSections& made) {
    if (!reader->info().can_rewind)
        throw Error(ErrorCode::kInput, reader->info().source +
                                           ": --align reads the sections twice, and this input can be read once; name "
                                           "a file");
    std::vector<SectionShift> jitter = find_jitter(*reader, kind);
    auto moved = std::make_unique<AlignReader>(std::move(reader), std::move(jitter));
    made.sections_moved = moved->moved();
    made.largest_shift = moved->largest();
    return moved;
}

std::uint32_t find_between(SectionReader& reader, const PrepareOptions& options, PreparedSections& made) {
    if (options.between) return *options.between;
    const VolumeInfo& info = reader.info();
    const std::uint32_t between = between_of(info);
    if (between == 0 || !info.can_rewind || far_axis(info.lattice) != info.sweep.axes[2]) return 0;
    // Such a section is refused before it is read, or comes in blocks.
    const std::uint64_t samples = std::uint64_t{reader.section_width()} * reader.section_height();
    if (options.memory > 0 && samples > options.memory / kBytesPerSample) return 0;
    const PartPairs pairs = count_part_pairs(reader);
    made.pairs = pairs.overlapping + pairs.apart;
    made.pairs_apart = pairs.apart;
    const bool is_apart = static_cast<double>(pairs.apart) > kApartShare * static_cast<double>(made.pairs);
    return is_apart ? between : 0;
}

}  // namespace

std::optional<int> far_axis(const Lattice& lattice) {
    for (int axis = 0; axis < 3; ++axis) {
        const double others = std::max(lattice.spacing[(axis + 1) % 3], lattice.spacing[(axis + 2) % 3]);
        if (lattice.spacing[axis] >= kFar * others) return axis;
    }
    return {};
}

std::optional<BetweenAlong> between_of_model(const Lattice& input, Vec3 spacing) {
    constexpr double kRounding = 1e-9;
    for (int axis = 0; axis < 3; ++axis) {
        const double steps = input.spacing[axis] / spacing[axis], whole = std::round(steps);
        if (whole >= 2 && whole <= kMostBetween + 1 && std::abs(steps - whole) < kRounding * whole)
            return BetweenAlong{static_cast<std::uint32_t>(whole) - 1, axis};
    }
    return {};
}

PartPairs count_part_pairs(SectionReader& reader) {
    const Gap gap = gap_of(reader.info(), 1);
    PartPairs pairs;
    visit_neighbours(reader, [&](const auto& low, const auto& high) {
        const PartMatch match =
            match_parts(find_parts(low, gap.width), find_parts(high, gap.width), match_options(gap));
        pairs.overlapping += match.overlaps;
        pairs.apart += match.apart;
    });
    return pairs;
}

std::vector<SectionShift> find_jitter(SectionReader& reader, AlignKind kind) {
    std::vector<SectionShift> shifts;
    visit_neighbours(reader, [&](const auto& low, const auto& high) {
        shifts.push_back(estimate_shift(low, high, static_cast<std::int32_t>(reader.section_width()), kind));
    });
    return without_trend(shifts);
}

JitterSum summed(const std::vector<SectionShift>& jitter) {
    JitterSum sum;
    for (std::uint32_t n = 0; n < jitter.size(); ++n) {
        const double far = std::hypot(jitter[n].x, jitter[n].y);
        sum.rms += far * far / static_cast<double>(jitter.size());
        if (far > sum.largest) sum.largest = far, sum.section = n;
    }
    sum.rms = std::sqrt(sum.rms);
    return sum;
}

std::unique_ptr<SectionReader> open_as_cut(const OpenAlong& open, SweepChoice choice) {
    ReaderPointer reader = open(choice);
    const VolumeInfo& info = reader->info();
    const auto axis = static_cast<std::size_t>(far_axis(info.lattice).value_or(2));
    const bool is_cut_so = choice != SweepChoice::kAuto || int(axis) == info.sweep.axes[2];
    if (is_cut_so || !info.can_rewind || !info.can_sweep[axis]) return reader;
    return open(kChoices[axis]);
}

PreparedSections prepare_sections(const OpenAlong& open, SweepChoice choice, const PrepareOptions& options) {
    if (options.between && *options.between > kMostBetween)
        throw Error(ErrorCode::kUsage, "--between " + std::to_string(*options.between) + ": give auto, off, or 1 to " +
                                           std::to_string(kMostBetween));
    PreparedSections made;
    if (options.between == 0u && options.align == AlignKind::kOff) {
        made.reader = open(choice);
        return made;
    }
    ReaderPointer reader = open_as_cut(open, choice);
    if (options.align != AlignKind::kOff) reader = aligned(std::move(reader), options.align, made);
    made.between = reader->section_count() > 1 ? find_between(*reader, options, made) : 0;
    if (made.between > 0) reader = std::make_unique<BetweenReader>(std::move(reader), made.between, options.threads);
    const bool is_changed = made.between > 0 || options.align != AlignKind::kOff;
    made.reader = is_changed || !reader->info().can_rewind ? std::move(reader) : open(choice);
    return made;
}

}  // namespace regionmesh
