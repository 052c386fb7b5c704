#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/box.h"
#include "formats/surface/file_surface.h"
#include "mesh/grid_tree.h"

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

/// A side of a face.
struct FaceSide {
    std::uint32_t face;
    InputLabel label;
};

/// The groups, and the sides at edges that their region ends at, such as a background without faces on the box.
std::pair<TurnGroups, std::vector<FaceSide>> group_faces(const FileSurface& surface) {
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
    std::vector<FaceSide> ends;
    for (std::size_t first = 0, end = 1; first < uses.size(); first = end++) {
        while (end < uses.size() && key(uses[end]) == key(uses[first])) ++end;
        if (end - first == 2)
            groups.join(uses[first].face, uses[first + 1].face, uses[first].is_back == uses[first + 1].is_back);
        if ((end - first) % 2 == 1) ends.push_back({uses[first].face, uses[first].label});
    }
    return {std::move(groups), std::move(ends)};
}

/// A group, in the given orientation of its first face.
struct Part {
    std::map<InputLabel, double> volumes;
    std::set<InputLabel> open;  // their faces are not closed, so their volumes mean nothing
    Box box;
    Vec3 origin;                        // near the group, to keep rounding small
    std::int64_t kept = 0, turned = 0;  // numbers of faces
};

bool must_turn(const Part& part, InputLabel exterior) {
    if (part.volumes.size() > part.open.size() && !part.open.empty()) {
        // What lies outside is open: the rest has a volume above zero.
        std::ptrdiff_t above = 0;
        for (const auto& [label, volume] : part.volumes)
            if (!part.open.contains(label)) above += volume > 0 ? 1 : -1;
        if (above != 0) return above < 0;
    } else if (!part.open.empty() && part.turned == 0) {
        return false;  // neighbours agree, and nothing says that they are wrong
    } else if (part.volumes.size() > 2) {
        const auto above = std::count_if(part.volumes.begin(), part.volumes.end(),
                                         [](const auto& volume) { return volume.second > 0; });
        const auto count = static_cast<std::ptrdiff_t>(part.volumes.size());
        if (above == count - 1) return false;
        if (above == 1) return true;
    } else {
        for (const InputLabel outside : {exterior, InputLabel{0}})
            if (const auto at = part.volumes.find(outside); at != part.volumes.end()) return at->second > 0;
    }
    return part.kept < part.turned;
}

/// Decides for each part whether it turns.
class Orientation {
public:
    Orientation(const std::vector<Part>& parts, InputLabel exterior) : parts_(parts), exterior_(exterior) {
        Box extent;
        for (const Part& part : parts_) extent.join(part.box);
        boxes_.build(static_cast<std::uint32_t>(parts_.size()), extent, 1,
                     [&](std::uint32_t n) { return parts_[n].box; });
        // Parts round others come first.
        std::vector<std::uint32_t> order(parts_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t n) { return size_of(parts_[n]); });
        turns_.resize(parts_.size());
        for (const std::uint32_t n : order) turns_[n] = decide(parts_[n]);
    }

    const std::vector<bool>& turns() const { return turns_; }

private:
    bool decide(const Part& part) const {
        const bool may_be_inside = part.volumes.size() == 2 && !part.volumes.contains(exterior_);
        const Part* const outer = may_be_inside ? part_round(part) : nullptr;
        if (!outer) return must_turn(part, exterior_);
        // The label that the outer part has, too, is outside. It may have both: then this may be a cavity or an island,
        // and its faces, where they agree, are as right as those round it.
        const auto [first, second] = std::pair(part.volumes.begin(), std::next(part.volumes.begin()));
        const bool has_first = outer->volumes.contains(first->first),
                   has_second = outer->volumes.contains(second->first);
        if (has_first != has_second && part.open.empty()) return (has_first ? first : second)->second > 0;
        return part.turned == 0 && outer->turned == 0 ? turns_[outer - parts_.data()] : must_turn(part, exterior_);
    }

    /// The smallest box round that of the part, of those that have one of its labels.
    const Part* part_round(const Part& part) const {
        const Part* found = nullptr;
        boxes_.search(part.box, [&](std::span<const std::uint32_t> places) {
            for (const std::uint32_t n : places) {
                const Part& outer = parts_[n];
                if (!contains(outer.box, part.box) || (found && size_of(outer) >= size_of(*found))) continue;
                if (std::ranges::any_of(part.volumes,
                                        [&](const auto& one) { return outer.volumes.contains(one.first); }))
                    found = &outer;
            }
            return true;
        });
        return found;
    }

    static double size_of(const Part& part) {
        const Vec3 size = part.box.high - part.box.low;
        return size.x * size.y * size.z;
    }

    static bool contains(const Box& outer, const Box& inner) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(outer.low[axis] < inner.low[axis] && inner.high[axis] < outer.high[axis])) return false;
        return true;
    }

    const std::vector<Part>& parts_;
    InputLabel exterior_;
    GridTree boxes_;
    std::vector<bool> turns_;  // by part
};

}  // namespace

void orient_faces(FileSurface& surface) {
    auto [groups, ends] = group_faces(surface);
    std::vector<Part> parts;
    std::vector<std::uint32_t> part_of(surface.faces.size());
    std::vector<bool> is_turned(surface.faces.size());
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const std::uint32_t root = groups.find(f);
        const auto& [a, b, c] = surface.faces[f];
        if (root == f) {  // the first face of its group
            part_of[f] = static_cast<std::uint32_t>(parts.size());
            parts.emplace_back().origin = surface.points[a];
        } else {
            part_of[f] = part_of[root];
            is_turned[f] = groups.is_turned(f);
        }
        Part& part = parts[part_of[f]];
        for (const std::uint32_t v : surface.faces[f]) part.box.add(surface.points[v]);
        const Vec3 o = part.origin;
        const double cone = dot(surface.points[a] - o, cross(surface.points[b] - o, surface.points[c] - o));
        part.volumes[surface.labels[f][0]] += is_turned[f] ? -cone : cone;
        part.volumes[surface.labels[f][1]] -= is_turned[f] ? -cone : cone;
        ++(is_turned[f] ? part.turned : part.kept);
    }
    for (const auto& [face, label] : ends) parts[part_of[face]].open.insert(label);
    const Orientation orientation(parts, surface.exterior_label);
    const std::vector<bool>& turns = orientation.turns();
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
        if (is_turned[f] != turns[part_of[f]]) std::swap(surface.faces[f][1], surface.faces[f][2]);
}

}  // namespace regionmesh
