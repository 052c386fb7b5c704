// Does every separate part of the surface lie in the region that its outermost faces name?
#include <map>
#include <optional>

#include "base/parallel_for.h"
#include "base/union_find.h"
#include "check/check_steps.h"
#include "check/nesting_ray.h"
#include "mesh/extent.h"

namespace regionmesh {
namespace {

/// A connected part of the surface.
struct Part {
    VertexId farthest = kNoVertex;  // along the ray
    NestedVolumes volumes;
    SideSet sides = 0;
    bool has_outer = false, has_inner = false;  // faces with the exterior, and others

    /// A surface of nothing but faces with the exterior is closed, on a hull that is no box, too: its outermost region
    /// is known, as that of a surface without such faces inside the hull. Others may end at the exterior.
    bool has_outermost() const {
        if (has_outer && has_inner) return false;
        return (has_outer ? sides & kBoxSides : sides) == 0;
    }
};

/// Parts in the order of their smallest vertices.
using Parts = std::map<std::uint32_t, Part>;

class NestingCheck {
public:
    NestingCheck(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings)
        : mesh_(mesh), options_(options), tree_(tree), findings_(findings), joined_(mesh.vertex_end()) {}

    void run() {
        join_faces();
        gather_parts();
        if (parts_.size() < 2) return;
        measure_parts();
        std::vector<const Part*> inner;
        for (const auto& [root, part] : parts_)
            if (part.has_outermost()) inner.push_back(&part);
        if (inner.empty()) return;
        const Box extent = extent_of(mesh_, options_.threads);
        reach_ = 2 * length(extent.high - extent.low);
        std::optional<SortedFaceTree> own;
        if (!tree_) tree_ = &own.emplace(mesh_, options_.threads);
        for_chunks(
            static_cast<std::uint32_t>(inner.size()), 16, options_.threads,
            [&](std::uint32_t first, std::uint32_t end) {
                Findings found(options_.listed);
                for (std::uint32_t n = first; n < end; ++n) look_at(*inner[n], found);
                return found;
            },
            [&](Findings&& found) { findings_.append(std::move(found)); });
    }

private:
    /// First pass: joins the vertices of each face.
    void join_faces() {
        for_each_index(mesh_.face_end(), kCheckChunk, options_.threads, [&](std::uint32_t f) {
            if (!mesh_.is_alive(FaceId{f})) return;
            const auto& v = mesh_[FaceId{f}].vertices;
            joined_.join(index(v[0]), index(v[1]));
            joined_.join(index(v[0]), index(v[2]));
        });
    }

    /// Second pass: finds the parts, and the farthest vertex of each along the ray.
    void gather_parts() {
        const auto add = [&](Part& part, VertexId v, SideSet sides) {
            part.sides |= sides;
            if (part.farthest == kNoVertex ||
                dot(kNestingRay, mesh_.position(v)) > dot(kNestingRay, mesh_.position(part.farthest)))
                part.farthest = v;
        };
        const auto find = [&](std::uint32_t first, std::uint32_t end) {
            Parts parts;
            Parts::value_type* last = nullptr;  // consecutive vertices are mostly of the same part
            for (std::uint32_t v = first; v < end; ++v) {
                const Vertex& vertex = mesh_[VertexId{v}];
                if (!vertex.is_alive || vertex.star == kNoCorner) continue;
                const std::uint32_t root = joined_.find(v);
                if (!last || last->first != root) last = &*parts.try_emplace(root).first;
                add(last->second, VertexId{v}, vertex.sides);
            }
            return parts;
        };
        for_chunks(mesh_.vertex_end(), kCheckChunk, options_.threads, find, [&](const Parts& parts) {
            for (const auto& [root, part] : parts) add(parts_[root], part.farthest, part.sides);
        });
    }

    /// Third pass: the volume of each region inside each part that does not touch the box.
    void measure_parts() {
        const auto find = [&](std::uint32_t first, std::uint32_t end) {
            Parts parts;
            Parts::value_type* last = nullptr;
            for (std::uint32_t n = first; n < end; ++n) {
                const FaceId f{n};
                if (!mesh_.is_alive(f)) continue;
                const std::uint32_t root = joined_.find(index(mesh_[f].vertices[0]));
                if (!last || last->first != root) {
                    const Part& known = parts_.at(root);
                    last = &*parts.try_emplace(root, Part{known.farthest, {}, known.sides}).first;
                }
                add(f, last->second);
            }
            return parts;
        };
        for_chunks(mesh_.face_end(), kCheckChunk, options_.threads, find, [&](const Parts& parts) {
            for (const auto& [root, part] : parts) {
                Part& whole = parts_[root];
                whole.has_outer |= part.has_outer;
                whole.has_inner |= part.has_inner;
                for (const auto& [label, volume] : part.volumes) whole.volumes[label] += volume;
            }
        });
    }

    void add(FaceId f, Part& part) const {
        (is_exterior(mesh_[f].labels[1]) ? part.has_outer : part.has_inner) = true;
        if (part.has_outermost()) add_volume(part.volumes, mesh_, f, mesh_.position(part.farthest));
    }

    void look_at(const Part& part, Findings& findings) {
        const Label outer = outermost(part.volumes);
        const Vec3 from = mesh_.position(part.farthest);
        const std::uint32_t own = joined_.find(index(part.farthest));
        NestingHit nearest;
        search_along(from, reach_, nearest, [&](const Box& piece) {
            tree_->search(piece, [&](FaceId f) {
                if (joined_.find(index(mesh_[f].vertices[0])) != own) {
                    const NestingHit hit = nesting_hit(mesh_, f, from);
                    if (hit.distance < nearest.distance) nearest = hit;
                }
                return true;
            });
        });
        if (is_nested(options_, outer, nearest)) return;
        findings.add(ViolationKind::kNesting, {index(part.farthest)}, {},
                     [&] { return nesting_text(options_, index(part.farthest), outer, nearest); });
    }

    const Mesh& mesh_;
    const CheckOptions& options_;
    const SortedFaceTree* tree_;
    Findings& findings_;
    UnionFind joined_;
    Parts parts_;
    double reach_ = 0;  // the length that a ray needs
};

}  // namespace

void check_nesting(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings) {
    NestingCheck(mesh, options, tree, findings).run();
}

}  // namespace regionmesh
