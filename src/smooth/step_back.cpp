#include "smooth/step_back.h"

#include <vector>

#include "base/parallel_for.h"
#include "base/triangle.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 4096;  // faces

/// Where no bound is asked for, faces still may not become needles that have no normal to speak of.
constexpr double kLeastQuality = 1e-4;

}  // namespace

void Stand::set_level(const SurfaceWindow& window, std::uint32_t v, std::uint8_t to) {
    level[v] = std::min(to, kFullyBack);
    (*now)[v] = stepped_back(window.origin[v], (*smooth)[v], level[v]);
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

std::uint8_t StepBackRounds::first_sound_level(const WindowFace& face) const {
    std::array<Vec3, 3> before, after;
    for (int n = 0; n < 3; ++n) before[n] = window_.origin[face.vertices[n]];
    for (std::uint8_t level = 1; level < kFullyBack; ++level) {
        for (int n = 0; n < 3; ++n) after[n] = stepped_back(before[n], (*stand_.smooth)[face.vertices[n]], level);
        if (shape_fault(before, after, options_.min_quality) == ShapeFault::kNone) return level;
    }
    return kFullyBack;
}

void StepBackRounds::run(std::uint32_t round, std::uint32_t layer, bool is_last) {
    const NumberRange faces = window_.faces_of(layer);
    std::vector<std::vector<Wish>> wishes((faces.size() + kChunk - 1) / kChunk);
    parallel_for(static_cast<std::uint32_t>(wishes.size()), options_.threads, [&](std::uint32_t n) {
        const std::uint32_t first = faces.first + n * kChunk;
        for (std::uint32_t f = first; f < std::min(faces.end, first + kChunk); ++f) {
            const WindowFace& face = window_.faces[f];
            std::array<Vec3, 3> before, after;
            for (int k = 0; k < 3; ++k) {
                before[k] = window_.origin[face.vertices[k]];
                after[k] = (*stand_.now)[face.vertices[k]];
            }
            const ShapeFault fault = shape_fault(before, after, options_.min_quality);
            if (fault == ShapeFault::kNone) continue;
            wishes[n].push_back({f, round == 0 ? first_sound_level(face) : kRoundStep, fault});
        }
    });
    for (const auto& part : wishes) {
        for (const Wish& wish : part) {
            if (round == 0) ++(wish.fault == ShapeFault::kTurned ? faults_.turned : faults_.low_quality);
            for (std::uint32_t v : window_.faces[wish.face].vertices) {
                const int level = round == 0 ? wish.level : stand_.level[v] + wish.level;
                stand_.wanted[v] =
                    std::max(stand_.wanted[v], static_cast<std::uint8_t>(std::min<int>(level, kFullyBack)));
            }
        }
    }
    if (layer > 0) settle(window_.vertices_of(layer - 1));
    if (is_last) settle(window_.vertices_of(layer));
}

void StepBackRounds::settle(NumberRange vertices) {
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        if (stand_.wanted[v] > stand_.level[v]) stand_.set_level(window_, v, stand_.wanted[v]);
}

}  // namespace regionmesh
