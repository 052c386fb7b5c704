#include "check/part_nesting.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/box.h"
#include "base/union_find.h"
#include "check/check_steps.h"
#include "mesh/extent.h"

namespace regionmesh {
namespace {

/// Calls visit(FaceId, MeshPart::Span) for the faces with a corner of the part.
template <class Visit>
void for_own_corners(const Mesh& mesh, const MeshPart& part, Visit&& visit) {
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f}))
            if (const MeshPart::Span parts = part.span_of(mesh[FaceId{f}].vertices); parts.has_own)
                visit(FaceId{f}, parts);
}

}  // namespace

void PartNesting::join(Island& into, Island&& other) {
    into.touches_box |= other.touches_box;
    if (other.along > into.along) {
        into.farthest = other.farthest, into.along = other.along;
        into.vertex = other.vertex, into.part = other.part;
    }
    if (into.touches_box)
        into.volumes.clear();
    else
        for (const auto& [label, volume] : other.volumes) into.volumes[label] += volume;
}

void PartNesting::add(const Mesh& mesh, const MeshPart& part) {
    UnionFind joined(mesh.vertex_end());
    for_own_corners(mesh, part, [&](FaceId f, const MeshPart::Span&) {
        const auto& v = mesh[f].vertices;
        joined.join(index(v[0]), index(v[1]));
        joined.join(index(v[0]), index(v[2]));
    });
    std::map<std::uint32_t, Island> found;  // key: root
    auto last = found.end();                // consecutive vertices are mostly of the same island
    const auto island = [&](std::uint32_t v) -> Island& {
        const std::uint32_t root = joined.find(v);
        if (last == found.end() || last->first != root) last = found.try_emplace(root).first;
        return last->second;
    };
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const Vertex& vertex = mesh[VertexId{v}];
        if (!vertex.is_alive || vertex.star == kNoCorner || !part.has(VertexId{v})) continue;
        join(island(v), {vertex.position, dot(kNestingRay, vertex.position), v, part.number, vertex.sides != 0, {}});
    }
    for_own_corners(mesh, part, [&](FaceId f, const MeshPart::Span& parts) {
        if (parts.first != part.number) return;  // counted there
        Island& own = island(index(mesh[f].vertices[0]));
        if (is_exterior(mesh[f].labels[1])) own.touches_box = true;
        if (own.touches_box)
            own.volumes.clear();
        else
            add_volume(own.volumes, mesh, f, origin_);
    });
    std::unordered_map<std::uint32_t, std::uint32_t> set_of;  // key: root
    for_own_corners(mesh, part, [&](FaceId f, const MeshPart::Span& parts) {
        if (parts.first == parts.last) return;
        const auto [at, is_new] = set_of.try_emplace(joined.find(index(mesh[f].vertices[0])));
        if (is_new) {
            at->second = sets_.add();
            open_.emplace(at->second, std::move(found.at(at->first)));
            found.erase(at->first);
            ++count_;
        }
        const auto [kept, gone] = sets_.meet(part.key_of_face[index(f)], at->second, parts.last == part.number);
        if (kept == gone) return;
        join(open_.at(kept), std::move(open_.at(gone)));
        open_.erase(gone);
        --count_;
    });
    count_ += found.size();
    for (const auto& [root, own] : found) close(own);
}

void PartNesting::close(const Island& island) {
    if (!island.touches_box) rays_.push_back({island.farthest, island.vertex, island.part, outermost(island.volumes)});
}

void PartNesting::begin_rays(double reach) {
    reach_ = reach;
    for (const auto& [set, island] : open_) close(island);
    open_.clear();
    if (count_ < 2) rays_.clear();
}

Box PartNesting::way_of(const Ray& ray) const {
    Box way;
    way.add(ray.from);
    way.add(ray.from + std::min(reach_, ray.nearest.distance) * kNestingRay);
    return way;
}

bool PartNesting::needs(const Box& box) const {
    return std::ranges::any_of(rays_, [&](const Ray& ray) { return overlap(way_of(ray), box); });
}

void PartNesting::meet(const Mesh& mesh, std::uint32_t threads) {
    const Box extent = extent_of(mesh, threads);
    std::optional<SortedFaceTree> tree;
    for (Ray& ray : rays_) {
        const Box way = way_of(ray);
        if (!overlap(way, extent)) continue;
        if (!tree) tree.emplace(mesh, threads);
        search_along(ray.from, reach_, ray.nearest, [&](const Box& piece) {
            tree->search(piece, [&](FaceId f) {
                meet(mesh, f, ray);
                return true;
            });
        });
    }
}

void PartNesting::meet(const Mesh& mesh, FaceId f, Ray& ray) {
    // The other faces of the island lie behind the start of the ray.
    if (std::ranges::count(mesh.corners(f), ray.from) > 0) {
        for (const Label label : mesh[f].labels)
            if (const auto free_slot = std::ranges::find_if(
                    ray.at_start, [&](Label there) { return there == label || there == kNoLabel; });
                free_slot != ray.at_start.end())
                *free_slot = label;
        return;
    }
    const NestingHit hit = nesting_hit(mesh, f, ray.from);
    if (hit.distance < ray.nearest.distance) ray.nearest = hit;
}

void PartNesting::report(const CheckOptions& options, Findings& findings) const {
    for (const Ray& ray : rays_) {
        if (is_nested(options, ray.outer, ray.nearest)) continue;
        Violation* const listed = findings.add(ViolationKind::kNesting, {ray.vertex}, {}, [&] {
            return nesting_text(options, ray.vertex, ray.outer, ray.nearest);
        });
        if (!listed) continue;
        LabelSet met;
        for (const Label label : ray.at_start)
            if (label != kNoLabel) met.add(label);
        place_violation(ray.from, met, *listed);
        listed->text += MeshPart::text_of(ray.part);
    }
}

}  // namespace regionmesh
