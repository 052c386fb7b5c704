#include "smooth/filters/backtrack.h"

#include <vector>

#include "base/parallel_for.h"
#include "base/triangle.h"

namespace regionmesh {
namespace {

using smoothing::kLeastQuality, smoothing::kRoundTask;

}  // namespace

void StepLengths::set_backtrack(const SurfaceWindow& window, std::uint32_t v, std::uint8_t steps) {
    backtrack[v] = std::min(steps, kFullBacktrack);
    (*now)[v] = position_at(window.origin[v], (*smooth)[v], backtrack[v]);
}

ShapeFault shape_fault(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after, double min_quality) {
    const Vec3 was = area_vector(before[0], before[1], before[2]), is = area_vector(after[0], after[1], after[2]);
    if (!(dot(was, is) > 0)) return ShapeFault::kTurned;
    const double bound = std::max(min_quality, kLeastQuality);
    const QualityTerms terms = quality_terms(0.5 * length(is), length2(after[1] - after[0]),
                                             length2(after[2] - after[1]), length2(after[0] - after[2]));
    if (terms.is_at_least(bound)) return ShapeFault::kNone;
    const QualityTerms was_terms = quality_terms(0.5 * length(was), length2(before[1] - before[0]),
                                                 length2(before[2] - before[1]), length2(before[0] - before[2]));
    const bool is_worse = was_terms.is_at_least(bound) || terms.value() < 0.5 * was_terms.value();
    return is_worse ? ShapeFault::kQuality : ShapeFault::kNone;
}

std::uint8_t BacktrackRounds::first_valid_backtrack(const ChunkFace& face) const {
    std::array<Vec3, 3> before, after;
    for (int n = 0; n < 3; ++n) before[n] = window_.origin[face.vertices[n]];
    for (std::uint8_t steps = 1; steps < kFullBacktrack; ++steps) {
        for (int n = 0; n < 3; ++n) after[n] = position_at(before[n], (*steps_.smooth)[face.vertices[n]], steps);
        if (shape_fault(before, after, options_.min_quality) == ShapeFault::kNone) return steps;
    }
    return kFullBacktrack;
}

void BacktrackRounds::run(std::uint32_t round, std::uint32_t chunk, bool is_last) {
    const NumberRange faces = window_.faces_of(chunk);
    std::vector<std::vector<Request>> requests((faces.size() + kRoundTask - 1) / kRoundTask);
    parallel_for(static_cast<std::uint32_t>(requests.size()), options_.threads, [&](std::uint32_t n) {
        const std::uint32_t first = faces.first + n * kRoundTask;
        for (std::uint32_t f = first; f < std::min(faces.end, first + kRoundTask); ++f) {
            const ChunkFace& face = window_.faces[f];
            std::array<Vec3, 3> before, after;
            for (int k = 0; k < 3; ++k) {
                before[k] = window_.origin[face.vertices[k]];
                after[k] = (*steps_.now)[face.vertices[k]];
            }
            const ShapeFault fault = shape_fault(before, after, options_.min_quality);
            if (fault == ShapeFault::kNone) continue;
            requests[n].push_back({f, round == 0 ? first_valid_backtrack(face) : kRoundStep, fault});
        }
    });
    for (const auto& part : requests) {
        for (const Request& request : part) {
            if (round == 0) ++(request.fault == ShapeFault::kTurned ? faults_.turned : faults_.low_quality);
            for (std::uint32_t v : window_.faces[request.face].vertices) {
                const int steps = round == 0 ? request.steps : steps_.backtrack[v] + request.steps;
                steps_.wanted[v] =
                    std::max(steps_.wanted[v], static_cast<std::uint8_t>(std::min<int>(steps, kFullBacktrack)));
            }
        }
    }
    if (chunk > 0) apply_requests(window_.vertices_of(chunk - 1));
    if (is_last) apply_requests(window_.vertices_of(chunk));
}

void BacktrackRounds::apply_requests(NumberRange vertices) {
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        if (steps_.wanted[v] > steps_.backtrack[v]) steps_.set_backtrack(window_, v, steps_.wanted[v]);
}

}  // namespace regionmesh
