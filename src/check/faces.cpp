// Tests and measures of single faces: degenerate faces, area, quality, pairs of regions.
#include <algorithm>
#include <cmath>

#include "base/exact_predicates.h"
#include "base/hash.h"
#include "base/parallel_for.h"
#include "base/triangle.h"
#include "check/check_parts.h"
#include "check/check_steps.h"
#include "check/quality_sum.h"
#include "check/region_sums.h"
#include "mesh/extent.h"

namespace regionmesh {
namespace {

/// Pairs of labels; most repetitions are already removed.
class PairList {
public:
    PairList() { recent_.fill(~std::uint64_t{0}); }
    void add(Label a, Label b) {
        const std::uint64_t pair = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        std::uint64_t& recent = recent_[mix64(pair) % recent_.size()];
        if (recent == pair) return;
        recent = pair;
        pairs_.push_back(pair);
    }
    std::vector<std::uint64_t> take() { return std::move(pairs_); }

private:
    std::vector<std::uint64_t> pairs_;
    std::array<std::uint64_t, 256> recent_;
};

struct FaceChunk {
    Findings findings;
    QualitySum quality;
    std::vector<RegionReport> regions;
    std::vector<std::uint64_t> pairs;
};

/// Some faces of a mesh: those of a part, or all.
struct FaceRange {
    std::uint32_t first, end;
    const MeshPart* part;
};

FaceChunk look_at_faces(const Mesh& mesh, Vec3 origin, std::uint32_t listed, const FaceRange& range) {
    FaceChunk chunk{.findings = Findings(listed), .quality = {}, .regions = {}, .pairs = {}};
    RegionSums regions;
    PairList pairs;
    for (std::uint32_t n = range.first; n < range.end; ++n) {
        const FaceId f{n};
        if (!mesh.is_alive(f) || (range.part && !range.part->has(f))) continue;
        const auto p = mesh.corners(f);
        const auto& labels = mesh[f].labels;
        const double area = 0.5 * length(area_vector(p[0], p[1], p[2]));
        if (labels[0] == labels[1] || !std::isfinite(area) || is_degenerate({p[0], p[1], p[2]}))
            chunk.findings.add(ViolationKind::kDegenerateFace, {}, {n}, [&] {
                return name(f) + (labels[0] == labels[1] ? " has one label on both sides"
                                  : !std::isfinite(area) ? " has no finite area"
                                                         : " has no area");
            });
        const double volume = dot(p[0] - origin, cross(p[1] - origin, p[2] - origin)) / 6;
        for (int side = 0; side < 2; ++side) {
            if (is_exterior(labels[side])) continue;
            RegionReport& region = regions[labels[side]];
            region.euler += repeats_a_vertex(mesh[f]) ? 0 : 1;
            region.area += area;
            region.volume += side == 0 ? volume : -volume;
        }
        if (!is_exterior(labels[0]) && !is_exterior(labels[1])) pairs.add(labels[0], labels[1]);
        chunk.quality.add(p);
    }
    chunk.regions = regions.take();
    chunk.pairs = pairs.take();
    return chunk;
}

}  // namespace

void sum_faces(const Mesh& mesh, const CheckOptions& options, const MeshPart* part, Vec3 origin, FaceTotals& totals,
               Findings& findings) {
    for_chunks(
        mesh.face_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) {
            return look_at_faces(mesh, origin, options.listed, {first, end, part});
        },
        [&](FaceChunk&& chunk) {
            findings.append(std::move(chunk.findings));
            totals.quality.append(chunk.quality);
            add_to(totals.regions, chunk.regions);
            totals.pairs.insert(chunk.pairs.begin(), chunk.pairs.end());
        });
}

void check_faces(const Mesh& mesh, const CheckOptions& options, std::vector<RegionReport>& regions, CheckReport& report,
                 Findings& findings) {
    // Volumes are measured from the middle of the box, to reduce rounding.
    const Box extent = extent_of(mesh, options.threads);
    FaceTotals totals{.quality = {}, .regions = std::move(regions), .pairs = {}};
    sum_faces(mesh, options, nullptr, 0.5 * (extent.low + extent.high), totals, findings);
    regions = std::move(totals.regions);
    report.quality = totals.quality.report();
    report.region_pairs = totals.pairs.size();
}

}  // namespace regionmesh
