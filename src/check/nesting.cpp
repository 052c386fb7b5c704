// Does every separate part of the surface lie in the region that its outermost faces name?
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "base/parallel_for.h"
#include "base/union_find.h"
#include "check/findings.h"

namespace regionmesh {
namespace {

/// No simple ratios, so that a ray from a lattice point hits no edge.
constexpr Vec3 kRay{1, 0.013748231, 0.007193377};

/// A connected part of the surface. The volume inside is negative for its outermost region, and for no other.
struct Part {
    VertexId farthest = kNoVertex;  // along the ray
    std::map<Label, double> volumes;
    bool touches_box = false;
};

/// By the smallest vertex of each part.
using Parts = std::map<std::uint32_t, Part>;

struct Hit {
    double distance = HUGE_VAL;
    Label label = 0;  // of the region in front of the face
};

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
            if (!part.touches_box) inner.push_back(&part);
        if (inner.empty()) return;
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
    template <class Find, class Append>
    void for_face_chunks(Find&& find, Append&& append) {
        for_chunks(mesh_.face_end(), kCheckChunk, options_.threads, find, append);
    }

    /// First pass: joins the vertices of each face, and measures the length that a ray needs.
    void join_faces() {
        Box box;
        const auto find = [&](std::uint32_t first, std::uint32_t end) {
            Box own;
            for (std::uint32_t f = first; f < end; ++f) {
                if (!mesh_.is_alive(FaceId{f})) continue;
                const auto& v = mesh_[FaceId{f}].vertices;
                joined_.join(index(v[0]), index(v[1]));
                joined_.join(index(v[0]), index(v[2]));
                for (Vec3 p : mesh_.corners(FaceId{f})) own.add(p);
            }
            return own;
        };
        for_face_chunks(find, [&](const Box& own) { box.join(own); });
        reach_ = 2 * length(box.high - box.low);
    }

    /// Second pass: finds the parts, and the farthest vertex of each along the ray.
    void gather_parts() {
        const auto add = [&](Part& part, VertexId v, bool touches_box) {
            part.touches_box |= touches_box;
            if (part.farthest == kNoVertex || dot(kRay, mesh_.position(v)) > dot(kRay, mesh_.position(part.farthest)))
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
                add(last->second, VertexId{v}, vertex.sides != 0);
            }
            return parts;
        };
        for_chunks(mesh_.vertex_end(), kCheckChunk, options_.threads, find, [&](const Parts& parts) {
            for (const auto& [root, part] : parts) add(parts_[root], part.farthest, part.touches_box);
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
                if (!last || last->first != root) last = &*parts.try_emplace(root, parts_.at(root)).first;
                add_volume(f, last->second);
            }
            return parts;
        };
        for_face_chunks(find, [&](const Parts& parts) {
            for (const auto& [root, part] : parts) {
                parts_[root].touches_box |= part.touches_box;
                for (const auto& [label, volume] : part.volumes) parts_[root].volumes[label] += volume;
            }
        });
    }

    void add_volume(FaceId f, Part& part) const {
        const auto& labels = mesh_[f].labels;
        part.touches_box |= is_exterior(labels[1]);
        if (part.touches_box) return;
        const Vec3 o = mesh_.position(part.farthest);
        const auto p = mesh_.corners(f);
        const double sixfold = dot(p[0] - o, cross(p[1] - o, p[2] - o));
        part.volumes[labels[0]] += sixfold;
        part.volumes[labels[1]] -= sixfold;
    }

    void look_at(const Part& part, Findings& findings) {
        const auto outer = std::min_element(part.volumes.begin(), part.volumes.end(),
                                            [](const auto& a, const auto& b) { return a.second < b.second; });
        const Vec3 from = mesh_.position(part.farthest);
        const std::uint32_t own = joined_.find(index(part.farthest));
        Box box;
        box.add(from);
        box.add(from + reach_ * kRay);
        Hit nearest;
        tree_->search(box, [&](FaceId f) {
            if (joined_.find(index(mesh_[f].vertices[0])) != own) {
                const Hit hit = hit_at(f, from);
                if (hit.distance < nearest.distance) nearest = hit;
            }
            return true;
        });
        const bool leaves = nearest.distance == HUGE_VAL;
        const bool may_leave = options_.boundary_is_open || options_.is_background(outer->first);
        if (leaves ? may_leave || is_exterior(outer->first) : nearest.label == outer->first) return;
        findings.add(ViolationKind::kNesting, {index(part.farthest)}, {}, [&] {
            return "the part with vertex " + std::to_string(index(part.farthest)) + " has faces that place it in " +
                   region_name(options_, outer->first) + ", but " +
                   (leaves ? "nothing surrounds it" : "it lies in " + region_name(options_, nearest.label));
        });
    }

    /// Where the ray meets a face (Moeller and Trumbore 1997).
    Hit hit_at(FaceId f, Vec3 from) const {
        const auto p = mesh_.corners(f);
        const Vec3 e = p[1] - p[0], g = p[2] - p[0];
        const Vec3 h = cross(kRay, g);
        const double d = dot(e, h);
        if (d == 0) return {};
        const Vec3 s = from - p[0];
        const double u = dot(s, h) / d;
        const Vec3 q = cross(s, e);
        const double v = dot(kRay, q) / d, t = dot(g, q) / d;
        if (u < 0 || v < 0 || u + v > 1 || t <= 0) return {};
        const bool along_normal = dot(cross(e, g), kRay) > 0;
        return {t, mesh_[f].labels[along_normal ? 0 : 1]};
    }

    const Mesh& mesh_;
    const CheckOptions& options_;
    const SortedFaceTree* tree_;
    Findings& findings_;
    UnionFind joined_;
    Parts parts_;
    double reach_ = 0;
};

}  // namespace

void check_nesting(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings) {
    NestingCheck(mesh, options, tree, findings).run();
}

}  // namespace regionmesh
