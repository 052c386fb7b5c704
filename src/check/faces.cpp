// Tests and measures of single faces: degenerate faces, area, quality, pairs of regions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/exact_predicates.h"
#include "base/hash.h"
#include "base/parallel_for.h"
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
        if (pair == std::exchange(last_, pair)) return;
        std::uint64_t& recent = recent_[mix64(pair) % recent_.size()];
        if (recent == pair) return;
        recent = pair;
        pairs_.push_back(pair);
    }
    std::vector<std::uint64_t> take() { return std::move(pairs_); }

private:
    std::vector<std::uint64_t> pairs_;
    std::uint64_t last_ = ~std::uint64_t{0};
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

/// Measures faces two at a time.
class FaceSums {
public:
    FaceSums(const Mesh& mesh, Vec3 origin, std::uint32_t listed)
        : mesh_(mesh),
          origin_(origin),
          chunk_{.findings = Findings(listed), .quality = {}, .regions = {}, .pairs = {}} {}

    FaceChunk run(const FaceRange& range) {
        std::array<FaceId, 2> two;
        int count = 0;
        for (std::uint32_t n = range.first; n < range.end; ++n) {
            const FaceId f{n};
            if (!mesh_.is_alive(f) || (range.part && !range.part->has(f))) continue;
            two[count++] = f;
            if (count == 2) add(two, std::exchange(count, 0));
        }
        if (count == 1) add({two[0], two[0]}, 1);
        chunk_.regions = regions_.take();
        chunk_.pairs = pairs_.take();
        return std::move(chunk_);
    }

private:
    /// The first `count` of two.
    void add(const std::array<FaceId, 2>& two, int count) {
        const std::array corners{mesh_.corners(two[0]), mesh_.corners(two[1])};
        const TwoFaces faces({side_by_side(corners[0][0], corners[1][0]), side_by_side(corners[0][1], corners[1][1]),
                              side_by_side(corners[0][2], corners[1][2])});
        for (int lane = 0; lane < count; ++lane) {
            add(two[lane], corners[lane], faces, lane);
            chunk_.quality.add(faces, lane);
        }
    }

    void add(FaceId f, const std::array<Vec3, 3>& p, const TwoFaces& faces, int lane) {
        const Face& face = mesh_[f];
        const auto& labels = face.labels;
        const double twice_area = faces.twice_area[lane];
        if (labels[0] == labels[1] || !std::isfinite(twice_area) ||
            (!faces.is_fat(lane) && is_degenerate({p[0], p[1], p[2]})))
            chunk_.findings.add(ViolationKind::kDegenerateFace, {}, {index(f)}, [&] {
                return name(f) + (labels[0] == labels[1]       ? " has one label on both sides"
                                  : !std::isfinite(twice_area) ? " has no finite area"
                                                               : " has no area");
            });
        const double volume = dot(p[0] - origin_, faces.normal[lane]) / 6;
        for (int side = 0; side < 2; ++side) {
            if (is_exterior(labels[side])) continue;
            RegionReport& region = regions_[labels[side]];
            region.euler += repeats_a_vertex(face) ? 0 : 1;
            region.area += 0.5 * twice_area;
            region.volume += side == 0 ? volume : -volume;
        }
        if (!is_exterior(labels[0]) && !is_exterior(labels[1])) pairs_.add(labels[0], labels[1]);
    }

    const Mesh& mesh_;
    Vec3 origin_;
    FaceChunk chunk_;
    RegionSums regions_;
    PairList pairs_;
};

}  // namespace

void sum_faces(const Mesh& mesh, const CheckOptions& options, const MeshPart* part, Vec3 origin, FaceTotals& totals,
               Findings& findings) {
    for_chunks(
        mesh.face_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) {
            return FaceSums(mesh, origin, options.listed).run({first, end, part});
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
