// What can be seen round one vertex at a time: edges, fans, Euler characteristics, and how boundaries hang together.
#include <algorithm>
#include <span>

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/base/union_find.h"
#include "regionmesh/check/findings.h"
#include "regionmesh/check/generic_star.h"
#include "regionmesh/check/region_sums.h"
#include "regionmesh/model/fan.h"
#include "regionmesh/model/label_set.h"

namespace regionmesh {
namespace {

/// What was found round some vertices.
struct StarChunk {
    Findings findings;
    std::vector<RegionReport> regions;
    std::uint64_t quadruple_points_inside = 0;
};

/// The two sides of each face are its sheets, joined where a region's boundary goes on across an edge.
class StarCheck {
public:
    StarCheck(const Model& model, const CheckOptions& options, UnionFind& sheets)
        : model_(model), options_(options), sheets_(sheets), generic_(model, options), findings_(options.listed) {}

    StarChunk run(std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t v = first; v < end; ++v)
            if (model_.is_alive(VertexId{v})) look_at_vertex(VertexId{v});
        return {std::move(findings_), regions_.take(), quadruple_points_inside_};
    }

private:
    /// One face seen from the vertex in its middle: a then b go round it.
    struct Page {
        FaceId face;
        VertexId a, b;
        std::array<Label, 2> labels;
    };
    static std::uint32_t sheet(FaceId f, int side) { return 2 * index(f) + static_cast<std::uint32_t>(side); }
    bool is_background(Label label) const {
        return std::find(options_.background.begin(), options_.background.end(), label) != options_.background.end();
    }

    void look_at_vertex(VertexId v) {
        pages_.clear();
        labels_ = LabelSet();
        bool has_exterior = false, is_odd = false;
        model_.for_star(v, [&](FaceId f, int place) {
            const Face& face = model_[f];
            pages_.push_back({f, face.vertices[(place + 1) % 3], face.vertices[(place + 2) % 3], face.labels});
            is_odd |= face.labels[0] == face.labels[1];
            for (Label label : face.labels) {
                if (is_exterior(label))
                    has_exterior = true;
                else
                    labels_.add(label);
            }
        });
        if (pages_.empty())
            return findings_.add(ViolationKind::kUnusedVertex, {index(v)}, {},
                                 [&] { return name(v) + " has no face"; });
        if (model_[v].sides == 0 && labels_.size() == 4) ++quadruple_points_inside_;
        if (!is_odd && labels_.size() < LabelSet::kCapacity && look_at_closed_fans(v, has_exterior)) {
            // Faces on the same vertices are in no closed fan, unless they have no label in common.
            if (has_exterior || labels_.size() > 3) look_for_duplicates(v);
            if (has_exterior || labels_.size() > 2) look_at_form(v);
        } else {
            look_at_any_fans(v);
            look_for_duplicates(v);
            if (labels_.size() > 4) look_at_form(v);
        }
    }

    void look_at_form(VertexId v) {
        const StarFault fault = generic_.fault(v);
        if (fault == StarFault::kNone) return;
        findings_.add(ViolationKind::kNonGenericVertex, {index(v)}, {}, [&] {
            return name(v) + (fault == StarFault::kLabels  ? ": more than four labels meet"
                              : fault == StarFault::kPages ? ": more than three labels meet at one of its edges"
                              : fault == StarFault::kLines ? ": its lines are not those where three or four labels meet"
                                                           : ": its faces are too many to be told");
        });
    }

    /// Nearly all vertices: the faces of each region go round v once, from one neighbour to the next. So all is well
    /// with its edges, too. False where it is not so: then nothing has been done.
    bool look_at_closed_fans(VertexId v, bool has_exterior) {
        const bool is_interface = labels_.size() == 2 && !has_exterior;  // both regions have the same faces
        fans_.clear();
        ends_.clear();
        for (Label label : labels_) {
            if (!is_interface || ends_.empty())
                if (!add_closed_fan(label)) return false;
            ends_.push_back(fans_.size());
        }
        std::size_t start = 0;
        for (int n = 0; n < labels_.size(); ++n) {
            if (is_interface) start = 0;
            const auto fan = std::span(fans_).subspan(start, ends_[n] - start);
            regions_[labels_.begin()[n]].euler += 1 - join_fan(v, fan, is_interface && n == 1);
            start = ends_[n];
        }
        return true;
    }

    /// Adds the faces of a region in the order in which they go round.
    bool add_closed_fan(Label label) {
        const std::size_t start = fans_.size();
        for (const Page& page : pages_) {
            if (page.labels[0] == label)
                fans_.push_back({page.a, page.b, sheet(page.face, 0)});
            else if (page.labels[1] == label)
                fans_.push_back({page.b, page.a, sheet(page.face, 1)});
        }
        const std::span<FanPage> fan = std::span(fans_).subspan(start);
        return fan.size() >= 3 && order_fan(fan) && is_closed(fan);
    }

    /// Joins the sheets of a closed fan across the edges from v to later vertices, and returns how many those are.
    std::int64_t join_fan(VertexId v, std::span<const FanPage> fan, std::uint32_t other_side) {
        std::int64_t edges = 0;
        for (std::size_t n = 0; n < fan.size(); ++n) {
            if (fan[n].second < v) continue;
            ++edges;
            sheets_.join(fan[n].name ^ other_side, fan[n + 1 < fan.size() ? n + 1 : 0].name ^ other_side);
        }
        return edges;
    }

    void look_at_any_fans(VertexId v) {
        neighbours_.clear();
        for (const Page& page : pages_) {
            neighbours_.push_back(page.a);
            neighbours_.push_back(page.b);
        }
        std::sort(neighbours_.begin(), neighbours_.end());
        neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
        const bool may_be_rim =
            model_[v].sides != 0 &&
            (options_.boundary_is_open ||
             std::any_of(labels_.begin(), labels_.end(), [&](Label label) { return is_background(label); }));
        if (neighbours_.size() < 3 && !may_be_rim)
            findings_.add(ViolationKind::kFewEdges, {index(v)}, {},
                          [&] { return name(v) + " has fewer than three edges"; });
        for (Label label : labels_) {
            regions_[label].euler += 1;
            look_at_fan(v, label);
        }
        for (VertexId w : neighbours_)
            if (v < w) look_at_edge(v, w);
    }

    /// The faces of a region at a vertex must be one fan: joined by the edges between them.
    void look_at_fan(VertexId v, Label label) {
        fan_.clear();
        for (std::uint32_t n = 0; n < pages_.size(); ++n)
            if (pages_[n].labels[0] == label || pages_[n].labels[1] == label) fan_.push_back(n);
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
                          [&] { return name(v) + ": " + region_name(options_, label) + " has more than one fan"; });
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
            for (int side = 0; side < 2; ++side) {
                if (is_exterior(page.labels[side])) continue;
                const int turn = (page.a == w) == (side == 0) ? 1 : -1;
                const auto at = std::find_if(uses.begin(), uses.begin() + use_count,
                                             [&](const Use& use) { return use.label == page.labels[side]; });
                if (at != uses.begin() + use_count) {
                    ++at->count;
                    at->turn += turn;
                    sheets_.join(at->sheet, sheet(page.face, side));
                } else if (use_count < LabelSet::kCapacity) {
                    uses[use_count++] = {page.labels[side], 1, turn, sheet(page.face, side)};
                }
            }
        }
        for (int n = 0; n < use_count; ++n) {
            const Use& use = uses[n];
            regions_[use.label].euler -= 1;
            const bool may_be_open =
                (options_.boundary_is_open || is_background(use.label)) && (model_[v].sides & model_[w].sides) != 0;
            const auto say = [&](ViolationKind kind, const std::string& what) {
                findings_.add(kind, {index(v), index(w)}, {},
                              [&] { return name(v, w) + ", " + region_name(options_, use.label) + ": " + what; });
            };
            if (use.count == 1 && !may_be_open) say(ViolationKind::kOpenEdge, "one face");
            if (use.count > 2) say(ViolationKind::kOverfullEdge, std::to_string(use.count) + " faces");
            if (use.count == 2 && use.turn != 0) say(ViolationKind::kOrientation, "its two faces look opposite ways");
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
                                  [&] { return name(p.face) + " and " + name(q.face) + " have the same vertices"; });
            }
        }
    }

    const Model& model_;
    const CheckOptions& options_;
    UnionFind& sheets_;
    GenericStar generic_;
    Findings findings_;
    RegionSums regions_;
    std::uint64_t quadruple_points_inside_ = 0;
    std::vector<Page> pages_;
    LabelSet labels_;            // of the regions among them
    std::vector<FanPage> fans_;  // region after region
    std::vector<std::size_t> ends_;
    std::vector<VertexId> neighbours_;
    std::vector<std::uint32_t> fan_, todo_;
    std::vector<bool> reached_;
};

/// Each part of a region's boundary has one root among its sheets.
std::vector<RegionReport> count_components(const Model& model, const UnionFind& sheets, std::uint32_t first,
                                           std::uint32_t end) {
    RegionSums regions;
    for (std::uint32_t f = first; f < end; ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        for (std::uint32_t side = 0; side < 2; ++side) {
            const Label label = model[FaceId{f}].labels[side];
            if (sheets.is_root(2 * f + side) && !is_exterior(label)) ++regions[label].components;
        }
    }
    return regions.take();
}

}  // namespace

void check_stars(const Model& model, const CheckOptions& options, std::vector<RegionReport>& regions,
                 CheckReport& report, Findings& findings) {
    UnionFind sheets(2 * model.face_end());
    for_chunks(
        model.vertex_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) { return StarCheck(model, options, sheets).run(first, end); },
        [&](StarChunk&& chunk) {
            findings.append(std::move(chunk.findings));
            add_to(regions, chunk.regions);
            report.quadruple_points_inside += chunk.quadruple_points_inside;
        });
    for_chunks(
        model.face_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) { return count_components(model, sheets, first, end); },
        [&](const std::vector<RegionReport>& chunk) { add_to(regions, chunk); });
}

}  // namespace regionmesh
