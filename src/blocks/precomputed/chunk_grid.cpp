#include "blocks/precomputed/chunk_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regionmesh {
namespace {

__extension__ using Wide = __int128;

/// Where the viewer halves a chunk: not in the middle, which is no whole step.
constexpr std::int64_t kHalfSteps = (kChunkSteps + 1) / 2;

/// The first plane above a place.
std::int64_t plane_above(std::int64_t place, std::uint32_t level) {
    const std::int64_t chunk = place / kChunkSteps, half = chunk * kChunkSteps + kHalfSteps;
    return level > 0 && place < half ? half : (chunk + 1) * kChunkSteps;
}

/// `numerator / denominator` to the nearest integer, halves up. Requires a positive denominator.
std::int64_t rounded(Wide numerator, Wide denominator) {
    const Wide doubled = 2 * numerator + denominator, whole = 2 * denominator;
    return static_cast<std::int64_t>(doubled >= 0 ? doubled / whole : -((whole - 1 - doubled) / whole));
}

/// Where the edge meets a plane. Requires that its ends lie on either side.
StepPoint meeting(StepPoint a, StepPoint b, int axis, std::int64_t plane) {
    if (b < a) std::swap(a, b);  // either face of the edge gets the same
    Wide along = plane - a[axis], length = b[axis] - a[axis];
    if (length < 0) along = -along, length = -length;
    StepPoint point;
    for (int n = 0; n < 3; ++n) point[n] = n == axis ? plane : a[n] + rounded(along * (Wide{b[n]} - a[n]), length);
    return point;
}

bool has_area(const StepFace& face) { return face[0] != face[1] && face[1] != face[2] && face[2] != face[0]; }

/// Adds the two or three parts of a face that a plane cuts to `below` and `above`.
void split(const StepFace& face, int axis, std::int64_t plane, std::vector<StepFace>& below,
           std::vector<StepFace>& above) {
    const auto side = [&](const StepPoint& p) { return p[axis] < plane ? -1 : p[axis] > plane; };
    // Turned so that the first corner lies on the plane, or alone on its side.
    StepFace turned = face;
    for (int n = 0; n < 3; ++n) {
        const int alone = side(turned[0]);
        if (alone == 0 ||
            (alone != side(turned[1]) && alone != side(turned[2]) && side(turned[1]) * side(turned[2]) > 0))
            break;
        std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    }
    const auto& [a, b, c] = turned;
    const auto add = [&](const StepFace& part, int where) {
        if (has_area(part)) (where < 0 ? below : above).push_back(part);
    };
    if (side(a) == 0) {
        const StepPoint cut = meeting(b, c, axis, plane);
        add({a, b, cut}, side(b));
        add({a, cut, c}, side(c));
        return;
    }
    const StepPoint to_b = meeting(a, b, axis, plane), to_c = meeting(a, c, axis, plane);
    add({a, to_b, to_c}, side(a));
    add({to_b, b, c}, side(b));
    add({to_b, c, to_c}, side(c));
}

/// Replaces the faces by their parts between the planes across one axis.
void cut_across(std::vector<StepFace>& faces, int axis, std::uint32_t level) {
    std::vector<StepFace> whole, waiting = std::move(faces);
    while (!waiting.empty()) {
        const StepFace face = waiting.back();
        waiting.pop_back();
        const auto [low, high] = std::minmax({face[0][axis], face[1][axis], face[2][axis]});
        const std::int64_t plane = plane_above(low, level);
        if (plane >= high)
            whole.push_back(face);
        else
            split(face, axis, plane, whole, waiting);
    }
    faces = std::move(whole);
}

ChunkFacePart part_of(const StepFace& face) {
    ChunkFacePart part;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t high = std::max({face[0][axis], face[1][axis], face[2][axis]});
        const std::int64_t chunk = high > 0 ? (high - 1) / kChunkSteps : 0;
        part.chunk[axis] = static_cast<std::uint32_t>(chunk);
        for (int n = 0; n < 3; ++n)
            part.corners[n][axis] = static_cast<std::uint16_t>(face[n][axis] - chunk * kChunkSteps);
    }
    return part;
}

}  // namespace

ChunkGrid::ChunkGrid(const Box& box, double chunk) : chunk_(static_cast<float>(chunk)) {
    for (int axis = 0; axis < 3; ++axis) {
        auto low = static_cast<float>(box.low[axis]);
        if (low > box.low[axis]) low = std::nextafter(low, -std::numeric_limits<float>::infinity());
        origin_[axis] = low;
    }
}

double ChunkGrid::step(std::uint32_t level) const { return std::ldexp(chunk_ / kChunkSteps, static_cast<int>(level)); }

StepPoint ChunkGrid::nearest(Vec3 position, std::uint32_t level) const {
    StepPoint point;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = std::max<std::int64_t>(std::llround((position[axis] - origin_[axis]) / step(level)), 0);
    return point;
}

void ChunkGrid::cut(const StepFace& face, std::uint32_t level,
                    const std::function<void(const ChunkFacePart&)>& visit) const {
    if (!has_area(face)) return;
    std::vector<StepFace> faces{face};
    for (int axis = 0; axis < 3; ++axis) cut_across(faces, axis, level);
    for (const StepFace& part : faces) visit(part_of(part));
}

}  // namespace regionmesh
