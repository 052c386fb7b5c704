#include "compare/sorted_strata.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/parallel_for.h"
#include "base/radix_sort.h"
#include "base/triangle.h"
#include "compare/hilbert.h"
#include "mesh/star_edges.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 1 << 16;  // vertices or simplices per task

std::uint32_t chunks_of(std::size_t count) { return static_cast<std::uint32_t>((count + kChunk - 1) / kChunk); }

/// Simplices as found, by vertices of the model, each with the number of its label set.
struct Found {
    std::vector<Simplex> simplices;
    std::vector<std::uint32_t> sets;
    std::vector<std::vector<Label>> labels;  // labels of each set
};

bool is_empty_space(const CommonView& view, const std::vector<Label>& labels) {
    const auto is_background = [&](Label label) {
        return std::ranges::find(view.background, label) != view.background.end();
    };
    return is_exterior(labels.back()) &&
           std::ranges::all_of(labels, [&](Label label) { return is_exterior(label) || is_background(label); });
}

bool is_before(Vec3 p, Vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

/// Orders the points by position, so that no result depends on how the model numbers or turns its faces: files turn
/// those whose second label is smaller. An edge keeps its form.
void order_points(const Mesh& mesh, Simplex& simplex) {
    const auto by_position = [&](std::uint32_t a, std::uint32_t b) {
        return is_before(mesh.position(VertexId{a}), mesh.position(VertexId{b}));
    };
    auto& [a, b, c] = simplex;
    if (is_edge(simplex)) {
        if (by_position(b, a)) std::swap(a, b), c = b;
        return;
    }
    std::ranges::sort(simplex, by_position);
    if (b == c) std::swap(a, c);  // a face that repeats a vertex must not be taken for an edge
}

/// Simplices with the same position on the curve, in the order of their points.
void order_ties(const Mesh& mesh, const std::vector<Simplex>& simplices, std::vector<KeyedIndex>& order) {
    const auto by_points = [&](const KeyedIndex& a, const KeyedIndex& b) {
        return std::ranges::lexicographical_compare(
            simplices[a.index], simplices[b.index], is_before,
            [&](std::uint32_t v) { return mesh.position(VertexId{v}); },
            [&](std::uint32_t v) { return mesh.position(VertexId{v}); });
    };
    for (auto first = order.begin(); first != order.end();) {
        const auto end =
            std::find_if(first, order.end(), [&](const KeyedIndex& item) { return item.key != first->key; });
        if (end - first > 1) std::sort(first, end, by_points);
        first = end;
    }
}

std::vector<KeyedIndex> along_curve(const Mesh& mesh, const std::vector<Simplex>& simplices, const Box& bounds,
                                    std::uint32_t threads) {
    const HilbertGrid grid(bounds);
    std::vector<KeyedIndex> order(simplices.size());
    parallel_for(chunks_of(order.size()), threads, [&](std::uint32_t chunk) {
        const std::size_t end = std::min<std::size_t>(order.size(), (std::size_t{chunk} + 1) * kChunk);
        for (std::size_t n = std::size_t{chunk} * kChunk; n < end; ++n) {
            Vec3 sum;
            for (const std::uint32_t v : simplices[n]) sum += mesh.position(VertexId{v});
            order[n] = {grid.key(sum / 3), static_cast<std::uint32_t>(n)};
        }
    });
    radix_sort(order);
    order_ties(mesh, simplices, order);
    return order;
}

/// Renumbers vertices of the model as points, in order of use.
void take_points(const Mesh& mesh, SortedStrata& strata) {
    constexpr std::uint32_t kNew = 0xFFFFFFFFu;
    std::vector<std::uint32_t> numbers(mesh.vertex_end(), kNew);
    for (Simplex& simplex : strata.simplices)
        for (std::uint32_t& v : simplex) {
            if (numbers[v] == kNew) {
                numbers[v] = static_cast<std::uint32_t>(strata.points.size());
                strata.points.push_back(mesh.position(VertexId{v}));
            }
            v = numbers[v];
        }
}

void sum_measures(SortedStrata& strata, std::uint32_t threads) {
    strata.ends.resize(strata.simplices.size());
    parallel_for(chunks_of(strata.ends.size()), threads, [&](std::uint32_t chunk) {
        const std::size_t end = std::min(strata.ends.size(), (std::size_t{chunk} + 1) * kChunk);
        for (std::size_t n = std::size_t{chunk} * kChunk; n < end; ++n) {
            const Simplex& s = strata.simplices[n];
            const Vec3 p = strata.points[s[0]], q = strata.points[s[1]];
            strata.ends[n] = is_edge(s) ? length(q - p) : 0.5 * length(area_vector(p, q, strata.points[s[2]]));
        }
    });
    for (const Stratum& stratum : strata.strata)
        for (std::uint32_t n = stratum.begin + 1; n < stratum.end; ++n) strata.ends[n] += strata.ends[n - 1];
}

SortedStrata sorted(const Mesh& mesh, const Found& found, std::uint32_t threads) {
    std::vector<std::uint32_t> ranked(found.labels.size()), rank(found.labels.size());
    std::iota(ranked.begin(), ranked.end(), 0u);
    std::ranges::sort(ranked, [&](std::uint32_t a, std::uint32_t b) { return found.labels[a] < found.labels[b]; });
    SortedStrata result;
    for (const std::uint32_t set : ranked) {
        rank[set] = static_cast<std::uint32_t>(result.strata.size());
        result.strata.push_back({found.labels[set]});
    }
    for (const std::uint32_t set : found.sets) ++result.strata[rank[set]].end;
    std::uint32_t begin = 0;
    for (Stratum& stratum : result.strata) {
        stratum.begin = begin;
        begin += std::exchange(stratum.end, begin);  // the end moves on as the stratum is filled
    }
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) result.bounds.add(mesh.position(VertexId{v}));
    result.simplices.resize(found.simplices.size());
    for (const KeyedIndex& item : along_curve(mesh, found.simplices, result.bounds, threads))
        result.simplices[result.strata[rank[found.sets[item.index]]].end++] = found.simplices[item.index];
    take_points(mesh, result);
    sum_measures(result, threads);
    return result;
}

}  // namespace

bool Stratum::contains(Label label) const { return std::ranges::find(labels, label) != labels.end(); }

SortedStrata interfaces_of(const CommonView& view, std::uint32_t threads) {
    const Mesh& mesh = view.mesh;
    Found found;
    std::unordered_map<std::uint64_t, std::uint32_t> sets;
    std::uint64_t last_pair = ~std::uint64_t{0};
    std::uint32_t last_set = kNoStratum;
    found.simplices.reserve(mesh.face_count());
    found.sets.reserve(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f}) || (view.part && !view.part->has(FaceId{f}))) continue;
        const Face& face = mesh[FaceId{f}];
        const Label x = view.labels.common(view.which, face.labels[0]),
                    y = view.labels.common(view.which, face.labels[1]);
        const std::uint64_t pair = std::uint64_t{std::min(x, y)} << 32 | std::max(x, y);
        if (pair != last_pair) {
            const auto [at, is_new] = sets.try_emplace(pair, static_cast<std::uint32_t>(found.labels.size()));
            if (is_new) {
                const std::vector<Label> labels{std::min(x, y), std::max(x, y)};
                if (is_empty_space(view, labels))
                    at->second = kNoStratum;
                else
                    found.labels.push_back(labels);
            }
            last_pair = pair;
            last_set = at->second;
        }
        if (last_set == kNoStratum) continue;
        const auto& [a, b, c] = face.vertices;
        Simplex simplex{index(a), index(b), index(c)};
        if (b == c) std::swap(simplex[0], simplex[2]);  // not an edge
        order_points(mesh, simplex);
        found.simplices.push_back(simplex);
        found.sets.push_back(last_set);
    }
    return sorted(mesh, found, threads);
}

SortedStrata lines_of(const CommonView& view, bool sides_apart, std::uint32_t threads) {
    const Mesh& mesh = view.mesh;
    struct LineEdge {
        VertexId u, v;
        std::vector<Label> labels;
    };
    std::vector<std::vector<LineEdge>> by_chunk(chunks_of(mesh.vertex_end()));
    const auto look_at = [&](VertexId u, StarEdges& star, std::vector<LineEdge>& edges) {
        if (!mesh.is_alive(u) || (view.part && !view.part->has(u)) || vertex_labels(mesh, u).size() < 3) return;
        star.gather(mesh, u);
        for (std::size_t n = 0; n < star.ends().size(); ++n) {
            const VertexId v = star.ends()[n];
            const LabelSet& set = star.labels()[n];
            if (v < u || set.size() < 3) continue;
            std::vector<Label> labels;
            for (const Label label : set) labels.push_back(view.labels.common(view.which, label));
            std::ranges::sort(labels);
            if (!sides_apart) labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
            if (labels.size() >= 3 && !is_empty_space(view, labels)) edges.push_back({u, v, std::move(labels)});
        }
    };
    parallel_for(static_cast<std::uint32_t>(by_chunk.size()), threads, [&](std::uint32_t chunk) {
        StarEdges star;
        const std::uint64_t end = std::min<std::uint64_t>(mesh.vertex_end(), (std::uint64_t{chunk} + 1) * kChunk);
        for (std::uint64_t u = std::uint64_t{chunk} * kChunk; u < end; ++u)
            look_at(VertexId{static_cast<std::uint32_t>(u)}, star, by_chunk[chunk]);
    });
    Found found;
    std::map<std::vector<Label>, std::uint32_t> sets;
    for (auto& edges : by_chunk)
        for (LineEdge& edge : edges) {
            const auto [at, is_new] = sets.try_emplace(std::move(edge.labels), static_cast<std::uint32_t>(sets.size()));
            if (is_new) found.labels.push_back(at->first);
            found.simplices.push_back({index(edge.u), index(edge.v), index(edge.v)});
            order_points(mesh, found.simplices.back());
            found.sets.push_back(at->second);
        }
    return sorted(mesh, found, threads);
}

}  // namespace regionmesh
