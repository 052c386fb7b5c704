// Does every separate part of the surface lie in the region that its outermost faces say?
#include <algorithm>
#include <array>
#include <map>

#include "regionmesh/base/union_find.h"
#include "regionmesh/check/findings.h"
#include "regionmesh/model/face_tree.h"

namespace regionmesh {
namespace {

/// A connected part of the surface. Seen from its outermost region the volume inside is negative, and only from that.
struct Part {
    VertexId farthest = kNoVertex;  // along the ray
    std::map<Label, double> volumes;
    bool touches_box = false;
};

struct Hit {
    double distance = HUGE_VAL;
    Label label = 0;  // of the region before the face
};

class NestingCheck {
public:
    NestingCheck(const Model& model, const CheckOptions& options, Findings& findings)
        : model_(model), options_(options), findings_(findings), joined_(model.vertex_end()) {}

    void run() {
        gather_parts();
        if (parts_.size() < 2) return;
        const FaceTree tree(model_);
        for (const auto& [root, part] : parts_)
            if (!part.touches_box) look_at(part, tree);
    }

private:
    /// No simple ratio, so that the ray from a lattice point hits no edge.
    static constexpr Vec3 kRay{1, 0.013748231, 0.007193377};

    void gather_parts() {
        Box box;
        for (std::uint32_t f = 0; f < model_.face_end(); ++f) {
            if (!model_.is_alive(FaceId{f})) continue;
            const auto& v = model_[FaceId{f}].vertices;
            joined_.join(index(v[0]), index(v[1]));
            joined_.join(index(v[0]), index(v[2]));
            for (Vec3 p : model_.corners(FaceId{f})) box.add(p);
        }
        reach_ = 2 * length(box.high - box.low);
        for (std::uint32_t v = 0; v < model_.vertex_end(); ++v) {
            if (!model_.is_alive(VertexId{v}) || model_[VertexId{v}].star == kNoCorner) continue;
            Part& part = parts_[joined_.find(v)];
            part.touches_box |= model_[VertexId{v}].sides != 0;
            if (part.farthest == kNoVertex ||
                dot(kRay, model_.position(VertexId{v})) > dot(kRay, model_.position(part.farthest)))
                part.farthest = VertexId{v};
        }
        if (parts_.size() < 2) return;
        for (std::uint32_t f = 0; f < model_.face_end(); ++f) {
            if (!model_.is_alive(FaceId{f})) continue;
            Part& part = parts_[joined_.find(index(model_[FaceId{f}].vertices[0]))];
            const auto& labels = model_[FaceId{f}].labels;
            part.touches_box |= is_exterior(labels[1]);
            if (part.touches_box) continue;
            const Vec3 o = model_.position(part.farthest);
            const auto p = model_.corners(FaceId{f});
            const double sixfold = dot(p[0] - o, cross(p[1] - o, p[2] - o));
            part.volumes[labels[0]] += sixfold;
            part.volumes[labels[1]] -= sixfold;
        }
    }

    void look_at(const Part& part, const FaceTree& tree) {
        const auto outer = std::min_element(part.volumes.begin(), part.volumes.end(),
                                            [](const auto& a, const auto& b) { return a.second < b.second; });
        const Vec3 from = model_.position(part.farthest);
        Box box;
        box.add(from);
        box.add(from + reach_ * kRay);
        Hit nearest;
        tree.search(box, [&](FaceId f, const FaceTree::GridBox&) {
            if (joined_.find(index(model_[f].vertices[0])) != joined_.find(index(part.farthest))) {
                const Hit hit = hit_at(f, from);
                if (hit.distance < nearest.distance) nearest = hit;
            }
            return true;
        });
        const bool leaves = nearest.distance == HUGE_VAL;
        const bool may_leave = options_.boundary_is_open ||
                               std::find(options_.background.begin(), options_.background.end(), outer->first) !=
                                   options_.background.end();
        if (leaves ? may_leave || is_exterior(outer->first) : nearest.label == outer->first) return;
        findings_.add(ViolationKind::kNesting, {index(part.farthest)}, {},
                      "the part with vertex " + std::to_string(index(part.farthest)) + " says it lies in " +
                          region_name(options_, outer->first) + ", but " +
                          (leaves ? "nothing is round it" : "it lies in " + region_name(options_, nearest.label)));
    }

    /// Where the ray meets a face (Moeller and Trumbore 1997).
    Hit hit_at(FaceId f, Vec3 from) const {
        const auto p = model_.corners(f);
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
        return {t, model_[f].labels[along_normal ? 0 : 1]};
    }

    const Model& model_;
    const CheckOptions& options_;
    Findings& findings_;
    UnionFind joined_;
    std::map<std::uint32_t, Part> parts_;
    double reach_ = 0;
};

}  // namespace

void check_nesting(const Model& model, const CheckOptions& options, Findings& findings) {
    NestingCheck(model, options, findings).run();
}

}  // namespace regionmesh
