#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "formats/surface/file_surface.h"

namespace regionmesh {
namespace {

/// Groups of faces with known relative orientation (union-find).
class TurnGroups {
public:
    explicit TurnGroups(std::size_t size) : up_(size), is_turned_(size) { std::iota(up_.begin(), up_.end(), 0u); }

    /// The first face of the group of f; after it is_turned(f) says whether f has the opposite orientation.
    std::uint32_t find(std::uint32_t f) {
        std::uint32_t root = f;
        bool turned = false;
        while (up_[root] != root) {
            turned ^= is_turned_[root];
            root = up_[root];
        }
        while (up_[f] != root && up_[f] != f) {
            const std::uint32_t next = up_[f];
            const bool rest = turned ^ is_turned_[f];
            up_[f] = root;
            is_turned_[f] = turned;
            turned = rest;
            f = next;
        }
        return root;
    }
    bool is_turned(std::uint32_t f) const { return is_turned_[f]; }

    /// Sets the relative orientation of two faces, unless it is known already.
    void join(std::uint32_t f, std::uint32_t g, bool differ) {
        const std::uint32_t a = find(f), b = find(g);
        if (a == b) return;
        const bool between = differ ^ is_turned_[f] ^ is_turned_[g];
        const auto [first, later] = std::minmax(a, b);
        up_[later] = first;
        is_turned_[later] = between;
    }

private:
    std::vector<std::uint32_t> up_;
    std::vector<bool> is_turned_;  // relative to the parent
};

/// One side of a face at an edge, whose vertices are sorted.
struct Use {
    std::uint32_t low, high;
    InputLabel label;
    std::uint32_t face;
    bool is_back;  // the side traverses the edge from high to low
};

TurnGroups group_faces(const FileSurface& surface) {
    std::vector<Use> uses;
    uses.reserve(6 * surface.faces.size());
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const auto& labels = surface.labels[f];
        if (labels[0] == labels[1]) continue;
        for (int n = 0; n < 3; ++n) {
            const std::uint32_t a = surface.faces[f][n], b = surface.faces[f][(n + 1) % 3];
            for (int side = 0; side < 2; ++side)
                uses.push_back({std::min(a, b), std::max(a, b), labels[side], f, (a > b) != (side == 1)});
        }
    }
    const auto key = [](const Use& use) { return std::tie(use.low, use.high, use.label); };
    std::sort(uses.begin(), uses.end(),
              [&](const Use& a, const Use& b) { return key(a) != key(b) ? key(a) < key(b) : a.face < b.face; });
    TurnGroups groups(surface.faces.size());
    for (std::size_t first = 0, end = 1; first < uses.size(); first = end++) {
        while (end < uses.size() && key(uses[end]) == key(uses[first])) ++end;
        if (end - first == 2)
            groups.join(uses[first].face, uses[first + 1].face, uses[first].is_back == uses[first + 1].is_back);
    }
    return groups;
}

/// A group, in the given orientation of its first face.
struct Part {
    std::map<InputLabel, double> volumes;
    Vec3 origin;                 // near the group, to keep rounding small
    std::int64_t kept_more = 0;  // number of faces that keep their orientation, minus the others
};

bool must_turn(const Part& part, InputLabel exterior) {
    if (part.volumes.size() > 2) {
        const auto above = std::count_if(part.volumes.begin(), part.volumes.end(),
                                         [](const auto& volume) { return volume.second > 0; });
        const auto count = static_cast<std::ptrdiff_t>(part.volumes.size());
        if (above == count - 1) return false;
        if (above == 1) return true;
    } else {
        for (const InputLabel outside : {exterior, InputLabel{0}})
            if (const auto at = part.volumes.find(outside); at != part.volumes.end()) return at->second > 0;
    }
    return part.kept_more < 0;
}

}  // namespace

void orient_faces(FileSurface& surface) {
    TurnGroups groups = group_faces(surface);
    std::map<std::uint32_t, Part> parts;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const std::uint32_t root = groups.find(f);
        const bool is_turned = root != f && groups.is_turned(f);
        const auto [at, is_new] = parts.try_emplace(root);
        Part& part = at->second;
        const auto& [a, b, c] = surface.faces[f];
        if (is_new) part.origin = surface.points[a];
        const Vec3 o = part.origin;
        const double cone = dot(surface.points[a] - o, cross(surface.points[b] - o, surface.points[c] - o));
        part.volumes[surface.labels[f][0]] += is_turned ? -cone : cone;
        part.volumes[surface.labels[f][1]] -= is_turned ? -cone : cone;
        part.kept_more += is_turned ? -1 : 1;
    }
    for (auto& [root, part] : parts) part.kept_more = must_turn(part, surface.exterior_label) ? -1 : 1;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const std::uint32_t root = groups.find(f);
        const bool is_turned = root != f && groups.is_turned(f);
        if (is_turned != (parts[root].kept_more < 0)) std::swap(surface.faces[f][1], surface.faces[f][2]);
    }
}

}  // namespace regionmesh
