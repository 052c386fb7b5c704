// What can be seen round one vertex at a time: edges, fans, Euler characteristics; and the measures of faces.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <unordered_set>

#include "regionmesh/base/hash.h"
#include "regionmesh/base/triangle.h"
#include "regionmesh/base/union_find.h"
#include "regionmesh/check/findings.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/label_set.h"

namespace regionmesh {
namespace {

std::string name(VertexId v) { return "vertex " + std::to_string(index(v)); }
std::string name(FaceId f) { return "face " + std::to_string(index(f)); }
std::string name(VertexId u, VertexId v) { return "edge " + std::to_string(index(u)) + "-" + std::to_string(index(v)); }

class StarCheck {
public:
    StarCheck(const Model& model, const CheckOptions& options, CheckReport& report, Findings& findings)
        : model_(model), options_(options), report_(report), findings_(findings), sheets_(2 * model.face_end()) {}

    void run() {
        for (std::uint32_t f = 0; f < model_.face_end(); ++f)
            if (model_.is_alive(FaceId{f})) look_at_face(FaceId{f});
        for (std::uint32_t v = 0; v < model_.vertex_end(); ++v)
            if (model_.is_alive(VertexId{v})) look_at_vertex(VertexId{v});
        find_coincident();
        finish();
    }

private:
    /// One face seen from the vertex in its middle: a then b go round it.
    struct Page {
        FaceId face;
        VertexId a, b;
    };

    RegionReport& region(Label label) {
        if (label >= regions_.size()) regions_.resize(label + 1);
        return regions_[label];
    }
    bool is_background(Label label) const {
        return std::find(options_.background.begin(), options_.background.end(), label) != options_.background.end();
    }

    void look_at_face(FaceId f) {
        const auto p = model_.corners(f);
        const auto& labels = model_[f].labels;
        const auto& v = model_[f].vertices;
        const double area = 0.5 * length(area_vector(p[0], p[1], p[2]));
        const bool repeats = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        if (repeats || labels[0] == labels[1] || is_degenerate({p[0], p[1], p[2]}))
            findings_.add(ViolationKind::kDegenerateFace, {}, {index(f)},
                          name(f) + (labels[0] == labels[1] ? " has one label on both sides" : " has no area"));
        const double sixfold = dot(p[0] - origin(), cross(p[1] - origin(), p[2] - origin()));
        for (int side = 0; side < 2; ++side) {
            if (is_exterior(labels[side])) continue;
            RegionReport& r = region(labels[side]);
            r.euler += 1;
            r.area += area;
            r.volume += (side == 0 ? sixfold : -sixfold) / 6;
        }
        if (!is_exterior(labels[0]) && !is_exterior(labels[1])) add_pair(labels[0], labels[1]);
        measure(p);
    }

    Vec3 origin() {
        if (!has_origin_) {
            Box box;
            for (std::uint32_t v = 0; v < model_.vertex_end(); ++v)
                if (model_.is_alive(VertexId{v})) box.add(model_.position(VertexId{v}));
            origin_ = 0.5 * (box.low + box.high);
            has_origin_ = true;
        }
        return origin_;
    }

    void add_pair(Label a, Label b) {
        const std::uint64_t pair = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        if (pair == last_pair_) return;
        last_pair_ = pair;
        pairs_.insert(pair);
    }

    void measure(const std::array<Vec3, 3>& p) {
        const double q = face_quality(p[0], p[1], p[2]);
        QualityReport& quality = report_.quality;
        quality.min = faces_ == 0 ? q : std::min(quality.min, q);
        quality_sum_ += q;
        ++faces_;
        ++quality.histogram[std::clamp(int(q * 100), 0, int(quality.histogram.size()) - 1)];
        for (int n = 0; n < 3; ++n) {
            const Vec3 s = p[(n + 1) % 3] - p[n], t = p[(n + 2) % 3] - p[n];
            const double angle = std::atan2(length(cross(s, t)), dot(s, t)) * 180 / std::numbers::pi;
            quality.min_angle = faces_ == 1 && n == 0 ? angle : std::min(quality.min_angle, angle);
            quality.max_angle = std::max(quality.max_angle, angle);
            ++quality.angle_histogram[std::clamp(int(angle / 10), 0, 17)];
        }
    }

    void look_at_vertex(VertexId v) {
        pages_.clear();
        model_.for_star(v, [&](FaceId f, int place) {
            const auto& corner = model_[f].vertices;
            pages_.push_back({f, corner[(place + 1) % 3], corner[(place + 2) % 3]});
        });
        if (pages_.empty())
            return findings_.add(ViolationKind::kUnusedVertex, {index(v)}, {}, name(v) + " has no face");
        LabelSet labels;
        neighbours_.clear();
        for (const Page& page : pages_) {
            for (Label label : model_[page.face].labels)
                if (!is_exterior(label)) labels.add(label);
            neighbours_.push_back(page.a);
            neighbours_.push_back(page.b);
        }
        std::sort(neighbours_.begin(), neighbours_.end());
        neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
        const bool may_be_rim =
            model_[v].sides != 0 &&
            (options_.boundary_is_open ||
             std::any_of(labels.begin(), labels.end(), [&](Label label) { return is_background(label); }));
        if (neighbours_.size() < 3 && !may_be_rim)
            findings_.add(ViolationKind::kFewEdges, {index(v)}, {}, name(v) + " has fewer than three edges");
        for (Label label : labels) {
            region(label).euler += 1;
            look_at_fan(v, label);
        }
        if (model_[v].sides == 0 && labels.size() == 4) ++report_.quadruple_points_inside;
        for (VertexId w : neighbours_)
            if (v < w) look_at_edge(v, w);
        look_for_duplicates(v);
    }

    /// The faces of a region at a vertex must be one fan: joined by the edges between them.
    void look_at_fan(VertexId v, Label label) {
        fan_.clear();
        for (std::uint32_t n = 0; n < pages_.size(); ++n)
            if (model_[pages_[n].face].labels[0] == label || model_[pages_[n].face].labels[1] == label)
                fan_.push_back(n);
        reached_.assign(fan_.size(), false);
        todo_.assign(1, 0);
        reached_[0] = true;
        std::size_t count = 1;
        while (!todo_.empty()) {
            const Page& page = pages_[fan_[todo_.back()]];
            todo_.pop_back();
            for (std::uint32_t n = 0; n < fan_.size(); ++n) {
                const Page& other = pages_[fan_[n]];
                const bool joined = page.a == other.a || page.a == other.b || page.b == other.a || page.b == other.b;
                if (reached_[n] || !joined) continue;
                reached_[n] = true;
                ++count;
                todo_.push_back(n);
            }
        }
        if (count < fan_.size())
            findings_.add(ViolationKind::kPinchedVertex, {index(v)}, {},
                          name(v) + ": " + region_name(options_, label) + " has more than one fan");
    }

    void look_at_edge(VertexId v, VertexId w) {
        struct Use {
            Label label;
            int count, turn;
            std::uint32_t sheet;
        };
        std::array<Use, LabelSet::kCapacity> uses;
        int use_count = 0;
        for (const Page& page : pages_) {
            if (page.a != w && page.b != w) continue;
            const auto& labels = model_[page.face].labels;
            for (int side = 0; side < 2; ++side) {
                if (is_exterior(labels[side])) continue;
                const int turn = (page.a == w) == (side == 0) ? 1 : -1;
                const std::uint32_t sheet = 2 * index(page.face) + side;
                const auto at = std::find_if(uses.begin(), uses.begin() + use_count,
                                             [&](const Use& use) { return use.label == labels[side]; });
                if (at != uses.begin() + use_count) {
                    ++at->count;
                    at->turn += turn;
                    sheets_.join(at->sheet, sheet);
                } else if (use_count < LabelSet::kCapacity) {
                    uses[use_count++] = {labels[side], 1, turn, sheet};
                }
            }
        }
        for (int n = 0; n < use_count; ++n) {
            const Use& use = uses[n];
            region(use.label).euler -= 1;
            const bool may_be_open =
                (options_.boundary_is_open || is_background(use.label)) && (model_[v].sides & model_[w].sides) != 0;
            const std::string where = name(v, w) + ", " + region_name(options_, use.label);
            if (use.count == 1 && !may_be_open)
                findings_.add(ViolationKind::kOpenEdge, {index(v), index(w)}, {}, where + ": one face");
            if (use.count > 2)
                findings_.add(ViolationKind::kOverfullEdge, {index(v), index(w)}, {},
                              where + ": " + std::to_string(use.count) + " faces");
            if (use.count == 2 && use.turn != 0)
                findings_.add(ViolationKind::kOrientation, {index(v), index(w)}, {},
                              where + ": its two faces look opposite ways");
        }
    }

    void look_for_duplicates(VertexId v) {
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            const Page& p = pages_[i];
            if (p.a < v || p.b < v) continue;
            for (std::size_t j = i + 1; j < pages_.size(); ++j) {
                const Page& q = pages_[j];
                if ((p.a == q.a && p.b == q.b) || (p.a == q.b && p.b == q.a))
                    findings_.add(ViolationKind::kDuplicateFace, {}, {index(p.face), index(q.face)},
                                  name(p.face) + " and " + name(q.face) + " have the same vertices");
            }
        }
    }

    void find_coincident() {
        std::vector<std::pair<std::uint64_t, VertexId>> hashed;
        hashed.reserve(model_.vertex_count());
        for (std::uint32_t n = 0; n < model_.vertex_end(); ++n) {
            if (!model_.is_alive(VertexId{n})) continue;
            const Vec3 p = model_.position(VertexId{n});
            std::uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                std::uint64_t bits;
                const double value = p[axis] + 0.0;  // -0 and 0 are one place
                std::memcpy(&bits, &value, 8);
                hash = mix64(hash ^ bits);
            }
            hashed.push_back({hash, VertexId{n}});
        }
        std::sort(hashed.begin(), hashed.end());
        for (std::size_t n = 1; n < hashed.size(); ++n) {
            const VertexId a = hashed[n - 1].second, b = hashed[n].second;
            if (hashed[n - 1].first == hashed[n].first && model_.position(a) == model_.position(b))
                findings_.add(ViolationKind::kCoincidentVertices, {index(a), index(b)}, {},
                              name(a) + " and " + name(b) + " are at one place");
        }
    }

    void finish() {
        for (std::uint32_t f = 0; f < model_.face_end(); ++f) {
            if (!model_.is_alive(FaceId{f})) continue;
            for (std::uint32_t side = 0; side < 2; ++side) {
                const Label label = model_[FaceId{f}].labels[side];
                if (!is_exterior(label) && sheets_.find(2 * f + side) == 2 * f + side) ++region(label).components;
            }
        }
        for (Label label = 0; label < regions_.size(); ++label) {
            regions_[label].label = label;
            if (regions_[label].area > 0 && !is_background(label)) report_.regions.push_back(regions_[label]);
        }
        report_.region_pairs = pairs_.size();
        report_.quality.mean = faces_ ? quality_sum_ / static_cast<double>(faces_) : 0;
    }

    const Model& model_;
    const CheckOptions& options_;
    CheckReport& report_;
    Findings& findings_;
    UnionFind sheets_;  // the two sides of each face, joined where a region's boundary goes on across an edge
    std::vector<RegionReport> regions_;
    std::unordered_set<std::uint64_t> pairs_;
    std::uint64_t last_pair_ = ~std::uint64_t{0};
    Vec3 origin_;
    bool has_origin_ = false;
    double quality_sum_ = 0;
    std::uint64_t faces_ = 0;
    std::vector<Page> pages_;
    std::vector<VertexId> neighbours_;
    std::vector<std::uint32_t> fan_, todo_;
    std::vector<bool> reached_;
};

}  // namespace

void check_stars(const Model& model, const CheckOptions& options, CheckReport& report, Findings& findings) {
    StarCheck(model, options, report, findings).run();
}

}  // namespace regionmesh
