#include "judge/verdict/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "judge/verdict/verdicts.h"
#include "mesh/sample_lines.h"

namespace regionmesh {
namespace {

/// Indices within this distance of the box of a triangle are looked at, for rounding; the exact test decides.
constexpr double kDoubt = 1e-6;

/// A face comes no nearer to a sample than this share of the spacing.
constexpr double kNear = 1e-6;

/// The lines of a lattice along one axis, axes permuted cyclically, so that no permutation mirrors.
struct Lines {
    std::array<int, 3> axes;
    SampleLines samples;
    std::array<std::uint32_t, 3> first, end;  // indices in the box of the star

    Lines(const Lattice& lattice, const Box& box, int axis)
        : axes{axis, (axis + 1) % 3, (axis + 2) % 3}, samples(lattice, axes) {
        const Vec3 low = permuted(box.low), high = permuted(box.high);
        for (int n = 0; n < 3; ++n) {
            first[n] = first_from(n, low[n]);
            end[n] = end_up_to(n, high[n]);
        }
    }
    Vec3 permuted(Vec3 p) const { return {p[axes[0]], p[axes[1]], p[axes[2]]}; }
    std::uint32_t first_from(int axis, double coordinate) const {
        return clamped(std::ceil(samples.index_of(axis, coordinate) - kDoubt), axis);
    }
    std::uint32_t end_up_to(int axis, double coordinate) const {
        return clamped(std::floor(samples.index_of(axis, coordinate) + kDoubt) + 1, axis);
    }
    std::uint32_t clamped(double index, int axis) const {
        return static_cast<std::uint32_t>(std::clamp(index, 0.0, static_cast<double>(samples.size(axis))));
    }
    bool has_samples() const { return first[0] < end[0] && first[1] < end[1] && first[2] < end[2]; }
    std::uint64_t count() const { return std::uint64_t{end[1] - first[1]} * (end[2] - first[2]); }
};

/// From sample `first` of a line on, the label is entered `times` times more after the collapse than before.
struct Entry {
    std::uint32_t section, row, first;
    Label label;
    int times;
    auto place() const { return std::tuple(section, row, first, label); }
};

void note_crossings(const Lines& lines, std::array<Vec3, 3> p, const std::array<Label, 2>& labels, int times,
                    std::vector<Entry>& changes) {
    for (Vec3& corner : p) corner = lines.permuted(corner);
    const Vec3 low = min(p[0], min(p[1], p[2])), high = max(p[0], max(p[1], p[2]));
    const std::uint32_t row_first = lines.first_from(1, low.y), row_end = lines.end_up_to(1, high.y);
    const std::uint32_t section_end = lines.end_up_to(2, high.z);
    for (std::uint32_t section = lines.first_from(2, low.z); section < section_end; ++section)
        for (std::uint32_t row = row_first; row < row_end; ++row) {
            const auto crossing = lines.samples.crossing(p, row, section);
            if (!crossing || crossing->first_beyond == lines.samples.size(0)) continue;
            const int entered = crossing->is_ahead ? 1 : 0;
            changes.push_back({section, row, crossing->first_beyond, labels[entered], times});
            changes.push_back({section, row, crossing->first_beyond, labels[1 - entered], -times});
        }
}

/// Does a triangle pass through a sample, or so near that rounding may take it there? The lines have to leave the plane
/// of the triangle.
bool meets_sample(const Lines& lines, std::array<Vec3, 3> p) {
    for (Vec3& corner : p) corner = lines.permuted(corner);
    const Vec3 low = min(p[0], min(p[1], p[2])), high = max(p[0], max(p[1], p[2]));
    const std::uint32_t row_first = lines.first_from(1, low.y), row_end = lines.end_up_to(1, high.y);
    const std::uint32_t section_end = lines.end_up_to(2, high.z);
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    for (std::uint32_t section = lines.first_from(2, low.z); section < section_end; ++section)
        for (std::uint32_t row = row_first; row < row_end; ++row) {
            const double y = lines.samples.at(1, row) - p[0].y, z = lines.samples.at(2, section) - p[0].z;
            const Vec3 to_b = p[1] - p[0], to_c = p[2] - p[0];
            const double b = (y * to_c.z - z * to_c.y) / normal.x, c = (to_b.y * z - to_b.z * y) / normal.x;
            if (b < -kNear || c < -kNear || b + c > 1 + kNear) continue;
            const double index = lines.samples.index_of(0, p[0].x + b * to_b.x + c * to_c.x);
            if (std::abs(index - std::round(index)) < kNear) return true;
        }
    return false;
}

bool meets_sample(const std::array<Lines, 3>& lines, const std::array<Vec3, 3>& p) {
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    int steepest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(normal[axis]) > std::abs(normal[steepest])) steepest = axis;
    return meets_sample(lines[steepest], p);
}

}  // namespace

bool changes_samples(const Lattice& lattice, std::span<const LabelledTriangle> before,
                     std::span<const LabelledTriangle> after) {
    Box box;
    for (const auto& part : {before, after})
        for (const LabelledTriangle& face : part)
            for (Vec3 p : face.at) box.add(p);
    const std::array<Lines, 3> all{Lines(lattice, box, 0), Lines(lattice, box, 1), Lines(lattice, box, 2)};
    if (!all[0].has_samples()) return false;
    const Lines& lines =
        *std::min_element(all.begin(), all.end(), [](const Lines& a, const Lines& b) { return a.count() < b.count(); });
    thread_local std::vector<Entry> changes;
    changes.clear();
    for (const LabelledTriangle& face : before) note_crossings(lines, face.at, face.labels, -1, changes);
    for (const LabelledTriangle& face : after) {
        // Caps pass through the samples of their side; elsewhere such a sample would be in no region for certain.
        if (!is_exterior(face.labels[0]) && !is_exterior(face.labels[1]) && meets_sample(all, face.at)) return true;
        note_crossings(lines, face.at, face.labels, 1, changes);
    }
    // Crossings between the same two samples cancel: no sample lies between them.
    std::sort(changes.begin(), changes.end(), [](const Entry& a, const Entry& b) { return a.place() < b.place(); });
    for (std::size_t n = 0; n < changes.size();) {
        const std::size_t first = n;
        int times = 0;
        for (; n < changes.size() && changes[n].place() == changes[first].place(); ++n) times += changes[n].times;
        if (times != 0) return true;
    }
    return false;
}

Verdict test_samples(const Judge& judge, Change& change) {
    const std::optional<Lattice>& samples = judge.promises().samples;
    if (!samples || (change.star.is_flat && !change.is_flip())) return Verdict::kAccepted;
    thread_local std::vector<LabelledTriangle> before, after;
    list_faces_before(judge.mesh(), change, before);
    if (!change.is_flip()) {
        const SweptSamples swept = find_swept_samples(*samples, before, change.position);
        if (swept != SweptSamples::kPerhaps)
            return swept == SweptSamples::kSome ? Verdict::kSamples : Verdict::kAccepted;
    }
    list_faces_after(judge.mesh(), change, after);
    return changes_samples(*samples, before, after) ? Verdict::kSamples : Verdict::kAccepted;
}

}  // namespace regionmesh
