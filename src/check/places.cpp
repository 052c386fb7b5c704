// Vertices at the same position (P 3.6 d).
#include <algorithm>
#include <cstring>
#include <tuple>

#include "base/hash.h"
#include "base/parallel_for.h"
#include "base/radix_sort.h"
#include "check/check_steps.h"

namespace regionmesh {
namespace {

std::uint32_t hash_of(Vec3 p) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::uint64_t bits;
        const double value = p[axis] + 0.0;  // -0 and 0 are equal
        std::memcpy(&bits, &value, 8);
        hash = mix64(hash ^ bits);
    }
    return static_cast<std::uint32_t>(hash);
}

/// All vertices; those at the same position are consecutive.
std::vector<KeyedIndex> sort_by_hash(const Mesh& mesh, std::uint32_t threads) {
    std::vector<KeyedIndex> sorted;
    sorted.reserve(mesh.vertex_count());
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        std::vector<KeyedIndex> hashed;
        for (std::uint32_t n = first; n < end; ++n)
            if (mesh.is_alive(VertexId{n})) hashed.push_back({hash_of(mesh.position(VertexId{n})), n});
        return hashed;
    };
    for_chunks(mesh.vertex_end(), kCheckChunk, threads, find, [&](const std::vector<KeyedIndex>& hashed) {
        sorted.insert(sorted.end(), hashed.begin(), hashed.end());
    });
    radix_sort(sorted, threads);
    return sorted;
}

}  // namespace

void check_places(const Mesh& mesh, const CheckOptions& options, Findings& findings, const MeshPart* part) {
    const std::vector<KeyedIndex> sorted = sort_by_hash(mesh, options.threads);
    std::vector<std::pair<VertexId, VertexId>> found;
    std::vector<VertexId> same;
    for (std::size_t first = 0, end = 1; first < sorted.size(); first = end++) {
        while (end < sorted.size() && sorted[end].key == sorted[first].key) ++end;
        if (end - first == 1) continue;
        same.clear();
        for (std::size_t n = first; n < end; ++n) same.push_back(VertexId{sorted[n].index});
        std::sort(same.begin(), same.end(), [&](VertexId a, VertexId b) {
            const Vec3 p = mesh.position(a), q = mesh.position(b);
            return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
        });
        for (std::size_t n = 1; n < same.size(); ++n)
            if (mesh.position(same[n - 1]) == mesh.position(same[n]) && (!part || part->has(same[n])))
                found.push_back({same[n - 1], same[n]});
    }
    std::sort(found.begin(), found.end());
    for (const auto& [a, b] : found)
        findings.add(ViolationKind::kCoincidentVertices, {index(a), index(b)}, {},
                     [a = a, b = b] { return name(a) + " and " + name(b) + " are at one place"; });
}

}  // namespace regionmesh
