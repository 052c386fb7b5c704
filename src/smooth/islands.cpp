#include "smooth/islands.h"

#include <algorithm>
#include <unordered_map>

#include "base/exact_predicates.h"

namespace regionmesh {
namespace {

/// False for a tetrahedron without volume.
bool is_in_or_on_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && side * orientation(a, b, c, q) >= 0 && side * orientation(a, d, b, q) >= 0 &&
           side * orientation(b, d, c, q) >= 0 && side * orientation(c, d, a, q) >= 0;
}

bool meets_segment(const std::array<Vec3, 3>& t, Vec3 p, Vec3 q) {
    if (p == q) return false;  // the point stays, and surfaces do not touch before they move
    const int at_p = orientation(t[0], t[1], t[2], p), at_q = orientation(t[0], t[1], t[2], q);
    if (at_p != 0 && at_p == at_q) return false;
    const int a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]), c = orientation(p, q, t[2], t[0]);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

}  // namespace

std::uint32_t Parts::root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
}

void Parts::add_chunk(const SurfaceWindow& window, std::uint32_t chunk) {
    const NumberRange vertices = window.vertices_of(chunk), faces = window.faces_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) parent_.push_back(v);
    for (std::uint32_t f = faces.first; f < faces.end; ++f) {
        std::uint32_t joined = root(window.faces[f].vertices[0]);
        for (int n = 1; n < 3; ++n) {
            const std::uint32_t other = root(window.faces[f].vertices[n]), newest = std::max(joined, other);
            parent_[joined] = parent_[other] = newest;
            joined = newest;
        }
    }
}

std::vector<std::uint32_t> Parts::that_end_in(const SurfaceWindow& window, std::uint32_t chunk) {
    const NumberRange vertices = window.vertices_of(chunk);
    const auto is_before = [&](std::uint32_t v, std::uint32_t w) {
        const Vec3 p = window.origin[v], q = window.origin[w];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::unordered_map<std::uint32_t, std::uint32_t> firsts;  // first of each root in the chunk
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        if (parent_[v] == v) firsts[v] = v;
    for (std::uint32_t v = vertices.first; v < vertices.end && !firsts.empty(); ++v) {
        const auto at = firsts.find(root(v));
        if (at != firsts.end() && is_before(v, at->second)) at->second = v;
    }
    std::vector<std::uint32_t> found;
    for (const auto& [root, first] : firsts) found.push_back(first);
    std::sort(found.begin(), found.end());
    return found;
}

bool may_change_sides(Vec3 before, Vec3 after, const MovedFace& face) {
    if (meets_segment(face.before, before, after)) return true;
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return face.vertices[a] < face.vertices[b]; });
    const auto &was = face.before, &is = face.after;
    const int a = order[0], b = order[1], c = order[2];
    return is_in_or_on_tetrahedron(was[a], was[b], was[c], is[c], after) ||
           is_in_or_on_tetrahedron(was[a], was[b], is[b], is[c], after) ||
           is_in_or_on_tetrahedron(was[a], is[a], is[b], is[c], after);
}

}  // namespace regionmesh
