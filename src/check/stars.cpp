// Tests and measures of single stars: edges, fans, Euler characteristics, and the parts of each region's boundary.
#include <algorithm>
#include <bit>
#include <numeric>
#include <span>
#include <tuple>

#include "base/parallel_for.h"
#include "base/union_find.h"
#include "check/check_steps.h"
#include "check/generic_star.h"
#include "check/part_components.h"
#include "check/region_sums.h"
#include "mesh/box_sides.h"
#include "mesh/fan.h"
#include "mesh/label_set.h"

namespace regionmesh {
namespace {

constexpr SideSet kAnySide = (1 << kSideCount) - 1;

/// Findings at some vertices.
struct StarChunk {
    Findings findings;
    std::vector<RegionReport> regions;
    std::uint64_t quadruple_points_inside = 0;
    LineTotals lines;
    std::vector<FacePair> crossings;
};

/// The two sides of each face are its sheets; they are joined where a region's boundary continues across an edge.
class StarCheck {
public:
    StarCheck(const Mesh& mesh, const CheckOptions& options, UnionFind& sheets)
        : mesh_(mesh), options_(options), sheets_(sheets), generic_(mesh, options), findings_(options.listed) {}

    StarChunk run(std::uint32_t first, std::uint32_t end, const MeshPart* part) {
        for (std::uint32_t v = first; v < end; ++v)
            if (mesh_.is_alive(VertexId{v}) && (!part || part->has(VertexId{v}))) look_at_vertex(VertexId{v});
        return {std::move(findings_), regions_.take(), quadruple_points_inside_, lines_, std::move(crossings_)};
    }

private:
    /// A face seen from the central vertex: its other corners a, b in order around the vertex.
    struct Page {
        FaceId face;
        VertexId a, b;
        std::array<Label, 2> labels;
    };
    /// A side of a page at one of its edges.
    struct Use {
        VertexId end;
        Label label;
        std::uint32_t side;  // page * 2 + which
        int turn;            // 1: it passes the edge away from the vertex
    };
    /// Ordering a fan takes time proportional to the square of its faces.
    static constexpr std::size_t kMostOrdered = 1024;

    static std::uint32_t sheet(FaceId f, int side) { return 2 * index(f) + static_cast<std::uint32_t>(side); }

    void look_at_vertex(VertexId v) {
        if (mesh_[v].star == kNoCorner) {
            findings_.add(ViolationKind::kUnusedVertex, {index(v)}, {}, [&] { return name(v) + " has no face"; });
            return;
        }
        if (!look_at_interface(v)) look_at_star(v);
    }

    /// The case of most vertices: faces of one interface that turn once around v, from one neighbour to the next. Then
    /// its edges are sound, too. Returns false otherwise, and has then changed nothing.
    bool look_at_interface(VertexId v) {
        fans_.clear();
        std::array<Label, 2> labels{};
        bool is_one = true;
        mesh_.for_star(v, [&](FaceId f, int place) {
            const Face& face = mesh_[f];
            if (fans_.empty()) labels = face.labels;
            const bool is_back = face.labels[0] != labels[0];
            const VertexId a = face.vertices[place_after(place)], b = face.vertices[place_before(place)];
            is_one &= (face.labels[is_back] == labels[0]) & (face.labels[!is_back] == labels[1]);
            is_one &= (a != b) & (a != v) & (b != v);
            fans_.push_back({is_back ? b : a, is_back ? a : b, sheet(f, is_back)});
        });
        if (!is_one || labels[0] == labels[1] || is_exterior(labels[0]) || is_exterior(labels[1])) return false;
        if (!order_closed(fans_)) return false;
        if (options_.crossing && !is_fan_simple(v, fans_)) return false;
        for (std::uint32_t side = 0; side < 2; ++side) regions_[labels[side]].euler += 1 - join_fan(v, fans_, side);
        return true;
    }

    void look_at_star(VertexId v) {
        pages_.clear();
        labels_ = LabelSet();
        SideSet sides = mesh_[v].sides & kAnySide;  // sides of the box that it lies on, or that its faces name
        bool has_exterior = false, is_odd = false, repeats = false;
        mesh_.for_star(v, [&](FaceId f, int place) {
            const Face& face = mesh_[f];
            if (repeats_a_vertex(face)) {  // its neighbours are checked without it
                repeats = true;
                return;
            }
            pages_.push_back({f, face.vertices[place_after(place)], face.vertices[place_before(place)], face.labels});
            is_odd |= face.labels[0] == face.labels[1];
            for (Label label : face.labels) {
                if (is_exterior(label)) {
                    has_exterior = true;
                    sides |= SideSet(1u << side_of(label));
                } else {
                    labels_.add(label);
                }
            }
        });
        if (pages_.empty()) return;
        const int met = labels_.size() + (sides == 0 ? 0 : std::popcount(sides));
        if (met > 2) edges_.gather(mesh_, v);
        if (labels_.size() > 2) lines_.add(mesh_, v, edges_);
        if (mesh_[v].sides == 0 && !has_exterior && labels_.size() == 4) ++quadruple_points_inside_;
        if (!is_odd && labels_.size() < LabelSet::kCapacity && look_at_closed_fans(v)) {
            // Faces on the same vertices are not in a closed fan, unless they have no label in common.
            if (has_exterior || labels_.size() > 3) look_for_duplicates(v);
            if (has_exterior || labels_.size() > 2)
                report_form(v, repeats ? generic_.fault(v) : generic_.fault_of_fans(v, met, edges_));
            // Two or three labels: any two faces are in a fan together.
            if (options_.crossing && (has_exterior || labels_.size() > 3 || !are_fans_simple(v))) look_for_crossings(v);
        } else {
            look_at_any_fans(v);
            look_for_duplicates(v);
            if (labels_.size() > 4) report_form(v, generic_.fault(v));
            if (options_.crossing) look_for_crossings(v);
        }
    }

    void report_form(VertexId v, StarFault fault) {
        if (fault == StarFault::kNone) return;
        findings_.add(ViolationKind::kNonGenericVertex, {index(v)}, {}, [&] {
            return name(v) + (fault == StarFault::kLabels  ? ": more than four labels meet"
                              : fault == StarFault::kSize  ? ": it has too many faces to be examined"
                              : fault == StarFault::kPages ? ": more than three labels meet at one of its edges"
                              : fault == StarFault::kLines ? ": its lines are not those where three or four labels meet"
                                                           : ": the faces of a region are not one fan");
        });
    }

    /// The faces of each region turn once around v, from one neighbour to the next. Then its edges are sound, too.
    /// Returns false otherwise, and has then changed nothing.
    bool look_at_closed_fans(VertexId v) {
        fans_.clear();
        ends_.clear();
        for (Label label : labels_) {
            const std::size_t start = fans_.size();
            for (const Page& page : pages_) {
                if (page.labels[0] == label)
                    fans_.push_back({page.a, page.b, sheet(page.face, 0)});
                else if (page.labels[1] == label)
                    fans_.push_back({page.b, page.a, sheet(page.face, 1)});
            }
            if (!order_closed(std::span(fans_).subspan(start))) return false;
            ends_.push_back(fans_.size());
        }
        std::size_t start = 0;
        for (int n = 0; n < labels_.size(); ++n) {
            regions_[labels_.begin()[n]].euler += 1 - join_fan(v, std::span(fans_).subspan(start, ends_[n] - start), 0);
            start = ends_[n];
        }
        return true;
    }

    /// False unless they form a closed fan.
    static bool order_closed(std::span<FanPage> fan) {
        return fan.size() >= 3 && fan.size() <= kMostOrdered && order_fan(fan) && is_closed(fan);
    }

    /// Closed fans of all labels.
    bool are_fans_simple(VertexId v) {
        std::size_t start = 0;
        for (const std::size_t end : ends_) {
            if (!is_fan_simple(v, std::span(fans_).subspan(start, end - start))) return false;
            start = end;
        }
        return true;
    }

    bool is_fan_simple(VertexId v, std::span<const FanPage> fan) {
        return crossing_.is_simple(mesh_.position(v), fan.size(), true,
                                   [&](std::size_t n) { return mesh_.position(fan[n < fan.size() ? n : 0].first); });
    }

    void look_for_crossings(VertexId v) {
        star_.clear();
        for (const Page& page : pages_)
            star_.push_back({page.face, page.a, page.b, mesh_.position(page.a), mesh_.position(page.b), page.labels});
        crossing_.find(v, mesh_.position(v), star_, crossings_);
    }

    /// Joins the sheets of a closed fan across the edges from v to later vertices. Returns the number of these edges.
    std::int64_t join_fan(VertexId v, std::span<const FanPage> fan, std::uint32_t other_side) {
        std::int64_t edges = 0;
        for (std::size_t n = 0; n < fan.size(); ++n) {
            if (fan[n].second < v) continue;
            ++edges;
            sheets_.join(fan[n].name ^ other_side, fan[n + 1 < fan.size() ? n + 1 : 0].name ^ other_side);
        }
        return edges;
    }

    /// The general case: any number of labels and of faces at an edge. Its time is that of sorting the sides.
    void look_at_any_fans(VertexId v) {
        gather_uses();
        const auto ends = [&](const Use& a, const Use& b) { return a.end != b.end; };
        std::size_t edges = uses_.empty() ? 0 : 1;
        for (std::size_t n = 1; n < uses_.size(); ++n) edges += ends(uses_[n - 1], uses_[n]);
        const bool may_be_rim = mesh_[v].sides != 0 && (options_.boundary_is_open ||
                                                        std::any_of(uses_.begin(), uses_.end(), [&](const Use& use) {
                                                            return options_.is_background(use.label);
                                                        }));
        if (edges < 3 && !may_be_rim)
            findings_.add(ViolationKind::kFewEdges, {index(v)}, {},
                          [&] { return name(v) + " has fewer than three edges"; });
        up_.resize(2 * pages_.size());
        std::iota(up_.begin(), up_.end(), 0u);
        for (std::size_t first = 0, end = 1; first < uses_.size(); first = end++) {
            while (end < uses_.size() && uses_[end].end == uses_[first].end && uses_[end].label == uses_[first].label)
                ++end;
            if (!is_exterior(uses_[first].label)) look_at_edge(v, std::span(uses_).subspan(first, end - first));
        }
        look_at_parts(v);
    }

    /// Visits all sides of all pages, edge by edge and label by label.
    void gather_uses() {
        uses_.clear();
        for (std::uint32_t n = 0; n < pages_.size(); ++n) {
            const Page& page = pages_[n];
            for (std::uint32_t side = 0; side < 2; ++side) {
                uses_.push_back({page.a, page.labels[side], 2 * n + side, side == 0 ? 1 : -1});
                uses_.push_back({page.b, page.labels[side], 2 * n + side, side == 0 ? -1 : 1});
            }
        }
        std::sort(uses_.begin(), uses_.end(), [](const Use& a, const Use& b) {
            return std::tie(a.end, a.label, a.side) < std::tie(b.end, b.label, b.side);
        });
    }

    /// The sides of one region at the edge.
    void look_at_edge(VertexId v, std::span<const Use> sides) {
        const auto [w, label, first_side, first_turn] = sides[0];
        const std::uint32_t first_sheet = sheet(pages_[first_side / 2].face, static_cast<int>(first_side % 2));
        int turn = 0;
        for (const Use& use : sides) {
            turn += use.turn;
            up_[root_of(use.side)] = root_of(first_side);
            sheets_.join(first_sheet, sheet(pages_[use.side / 2].face, static_cast<int>(use.side % 2)));
        }
        if (w < v) return;  // reported at w
        regions_[label].euler -= 1;
        const bool may_be_open = (options_.boundary_is_open || options_.is_background(label)) &&
                                 open_sides(mesh_[v].sides & mesh_[w].sides, pages_[first_side / 2].labels) != 0;
        const auto say = [&, w = w, label = label](ViolationKind kind, const std::string& what) {
            findings_.add(kind, {index(v), index(w)}, {},
                          [&] { return name(v, w) + ", " + region_name(options_, label) + ": " + what; });
        };
        if (sides.size() == 1 && !may_be_open) say(ViolationKind::kOpenEdge, "one face");
        if (sides.size() > 2) say(ViolationKind::kOverfullEdge, std::to_string(sides.size()) + " faces");
        if (sides.size() == 2 && turn != 0 && !(options_.is_background(label) && is_beside_hull(v, w, sides)))
            say(ViolationKind::kOrientation, "its two faces pass it in the same direction");
    }

    /// Edges of a hull that is no box: two parts of the background may end, each between a face and the hull.
    bool is_beside_hull(VertexId v, VertexId w, std::span<const Use> sides) const {
        if ((mesh_[v].sides & mesh_[w].sides & 1u << kHull) == 0) return false;
        return std::ranges::none_of(sides, [&](const Use& use) {
            const auto& labels = pages_[use.side / 2].labels;
            return is_exterior(labels[0]) || is_exterior(labels[1]);
        });
    }

    /// The faces of a region at a vertex must be one fan, joined by the edges between them.
    void look_at_parts(VertexId v) {
        parts_.clear();
        for (std::uint32_t side = 0; side < up_.size(); ++side) {
            const Label label = pages_[side / 2].labels[side % 2];
            if (!is_exterior(label)) parts_.push_back({label, root_of(side)});
        }
        std::sort(parts_.begin(), parts_.end());
        parts_.erase(std::unique(parts_.begin(), parts_.end()), parts_.end());
        for (std::size_t first = 0, end = 1; first < parts_.size(); first = end++) {
            while (end < parts_.size() && parts_[end].first == parts_[first].first) ++end;
            const Label label = parts_[first].first;
            regions_[label].euler += 1;
            if (end - first > 1)
                findings_.add(ViolationKind::kPinchedVertex, {index(v)}, {},
                              [&] { return name(v) + ": " + region_name(options_, label) + " has more than one fan"; });
        }
    }

    std::uint32_t root_of(std::uint32_t side) {
        while (up_[side] != side) side = up_[side] = up_[up_[side]];
        return side;
    }

    /// Reports each face on the same vertices as another face once, together with one of these.
    void look_for_duplicates(VertexId v) {
        rims_.clear();
        for (const Page& page : pages_)
            if (v < page.a && v < page.b)
                rims_.push_back({std::min(page.a, page.b), std::max(page.a, page.b), page.face});
        std::sort(rims_.begin(), rims_.end());
        for (std::size_t n = 1; n < rims_.size(); ++n) {
            const auto& [a, b, f] = rims_[n - 1];
            const auto& [c, d, g] = rims_[n];
            if (a == c && b == d)
                findings_.add(ViolationKind::kDuplicateFace, {}, {index(f), index(g)},
                              [&, f = f, g = g] { return name(f) + " and " + name(g) + " have the same vertices"; });
        }
    }

    const Mesh& mesh_;
    const CheckOptions& options_;
    UnionFind& sheets_;
    GenericStar generic_;
    Findings findings_;
    RegionSums regions_;
    std::uint64_t quadruple_points_inside_ = 0;
    LineTotals lines_;
    std::vector<FacePair> crossings_;
    std::vector<Page> pages_;
    LabelSet labels_;            // the labels that are regions
    StarEdges edges_;            // gathered where more than two labels meet
    std::vector<FanPage> fans_;  // grouped by region
    std::vector<std::size_t> ends_;
    StarCrossing crossing_;
    std::vector<StarPage> star_;
    std::vector<Use> uses_;
    std::vector<std::uint32_t> up_;  // union-find over the sides of pages
    std::vector<std::pair<Label, std::uint32_t>> parts_;
    std::vector<std::tuple<VertexId, VertexId, FaceId>> rims_;
};

/// Each part of a region's boundary has one root among its sheets.
std::vector<RegionReport> count_components(const Mesh& mesh, const UnionFind& sheets, std::uint32_t first,
                                           std::uint32_t end) {
    RegionSums regions;
    for (std::uint32_t f = first; f < end; ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        for (std::uint32_t side = 0; side < 2; ++side) {
            const Label label = mesh[FaceId{f}].labels[side];
            if (sheets.is_root(2 * f + side) && !is_exterior(label)) ++regions[label].components;
        }
    }
    return regions.take();
}

}  // namespace

void check_stars(const Mesh& mesh, const CheckOptions& options, StarTotals& totals, Findings& findings,
                 const PartStars* of) {
    UnionFind sheets(2 * mesh.face_end());
    for_chunks(
        mesh.vertex_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) {
            return StarCheck(mesh, options, sheets).run(first, end, of ? &of->part : nullptr);
        },
        [&](StarChunk&& chunk) {
            findings.append(std::move(chunk.findings));
            add_to(totals.regions, chunk.regions);
            totals.quadruple_points_inside += chunk.quadruple_points_inside;
            totals.lines.append(chunk.lines);
            totals.crossings.insert(totals.crossings.end(), chunk.crossings.begin(), chunk.crossings.end());
        });
    if (of) return of->components.add(mesh, of->part, sheets, totals.regions);
    for_chunks(
        mesh.face_end(), kCheckChunk, options.threads,
        [&](std::uint32_t first, std::uint32_t end) { return count_components(mesh, sheets, first, end); },
        [&](const std::vector<RegionReport>& chunk) { add_to(totals.regions, chunk); });
}

}  // namespace regionmesh
