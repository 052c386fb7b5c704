#include "check/crossing_faces.h"

#include <algorithm>
#include <cstddef>

#include "base/box.h"
#include "base/exact_predicates.h"
#include "base/lanes.h"
#include "base/parallel_for.h"
#include "base/radix_sort.h"

namespace regionmesh {
namespace {

using Pairs = std::vector<FacePair>;
using Corners = std::array<Vec3, 3>;

constexpr std::uint32_t kStars = 1 << 12, kParts = 8;  // stars per task, parts per task

/// Gives a mesh and a list of faces the same interface.
class MeshFaces {
public:
    explicit MeshFaces(const Mesh& mesh) : mesh_(mesh) {}

    const std::array<VertexId, 3>& vertices(FaceId f) const { return mesh_[f].vertices; }
    bool share_vertex(FaceId f, FaceId g) const {
        static_assert(offsetof(Face, vertices) == 0 && sizeof(Face) >= sizeof(Unsigned4));
        const auto a = load<Unsigned4>(&mesh_[f]), b = load<Unsigned4>(&mesh_[g]);  // vertices in three lanes each
        const auto same = (a == b) | (a == __builtin_shufflevector(b, b, 1, 2, 0, 3)) |
                          (a == __builtin_shufflevector(b, b, 2, 0, 1, 3));
        return (bits_of(same) & 7u) != 0;
    }
    Corners corners(FaceId f) const { return mesh_.corners(f); }
    std::uint32_t star_count() const { return mesh_.vertex_end(); }
    /// Adds the pages of star n and returns its vertex.
    VertexId star(std::uint32_t n, std::vector<StarPage>& pages, Vec3& at) const {
        const VertexId v{n};
        if (!mesh_.is_alive(v)) return v;
        at = mesh_.position(v);
        mesh_.for_star(v, [&](FaceId f, int place) {
            const Face& face = mesh_[f];
            const VertexId a = face.vertices[place_after(place)], b = face.vertices[place_before(place)];
            pages.push_back({f, a, b, mesh_.position(a), mesh_.position(b), face.labels});
        });
        return v;
    }

private:
    const Mesh& mesh_;
};

class ListedFaces {
public:
    ListedFaces(std::span<const LabelledFace> faces, std::uint32_t threads) : faces_(faces) {
        corners_.reserve(3 * faces.size());
        for (std::uint32_t f = 0; f < faces.size(); ++f)
            for (std::uint32_t place = 0; place < 3; ++place)
                corners_.push_back({index(faces[f].placed.vertices[place]), f << 2 | place});
        radix_sort(corners_, threads);
        for (std::uint32_t n = 0; n < corners_.size(); ++n)
            if (n == 0 || corners_[n].key != corners_[n - 1].key) starts_.push_back(n);
        starts_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }

    const std::array<VertexId, 3>& vertices(FaceId f) const { return faces_[index(f)].placed.vertices; }
    bool share_vertex(FaceId f, FaceId g) const { return regionmesh::share_vertex(vertices(f), vertices(g)); }
    const Corners& corners(FaceId f) const { return faces_[index(f)].placed.at; }
    std::uint32_t star_count() const { return static_cast<std::uint32_t>(starts_.size()) - 1; }
    VertexId star(std::uint32_t n, std::vector<StarPage>& pages, Vec3& at) const {
        for (std::uint32_t c = starts_[n]; c < starts_[n + 1]; ++c) {
            const FaceId f{corners_[c].index >> 2};
            const std::uint32_t place = corners_[c].index & 3, a = (place + 1) % 3, b = (place + 2) % 3;
            at = corners(f)[place];
            pages.push_back({f, vertices(f)[a], vertices(f)[b], corners(f)[a], corners(f)[b], faces_[index(f)].labels});
        }
        return VertexId{corners_[starts_[n]].key};
    }

private:
    std::span<const LabelledFace> faces_;
    std::vector<KeyedIndex> corners_;    // corners sorted by vertex
    std::vector<std::uint32_t> starts_;  // first corner of each star
};

template <class Faces>
bool cross(const Faces& faces, FaceId f, FaceId g) {
    const Corners p = faces.corners(f), q = faces.corners(g);
    if (are_apart(p, q) || is_degenerate({p[0], p[1], p[2]}) || is_degenerate({q[0], q[1], q[2]})) return false;
    return meet_outside_shared({faces.vertices(f), p}, {faces.vertices(g), q});
}

/// Adds the pairs of some parts of the tree that share no vertex.
template <class Faces>
void cross_apart(const Faces& faces, const SortedFaceTree& tree, std::uint32_t first, std::uint32_t end, Pairs& found) {
    Pairs strangers;
    tree.boxes().visit_pairs(first, end, [&](const GridTree::PartPairs& near) {
        strangers.resize(std::max(strangers.size(), near.pairs.size()));
        std::size_t count = 0;
        for (const GridTree::Pair pair : near.pairs) {
            const FaceId f = tree.face(near.first_m + pair.m()), g = tree.face(near.first_n + pair.n());
            strangers[count] = {f, g};
            count += !faces.share_vertex(f, g);
        }
        for (std::size_t n = 0; n < count; ++n) {
            const auto [f, g] = strangers[n];
            if (cross(faces, f, g)) found.push_back({std::min(f, g), std::max(f, g)});
        }
    });
}

auto append_to(Pairs& all) {
    return [&](const Pairs& found) { all.insert(all.end(), found.begin(), found.end()); };
}

/// Adds the pairs that share a vertex, star by star.
template <class Faces>
void find_in_stars(const Faces& faces, std::uint32_t threads, Pairs& all) {
    const auto in_stars = [&](std::uint32_t first, std::uint32_t end) {
        Pairs found;
        StarCrossing crossing;
        std::vector<StarPage> pages;
        for (std::uint32_t n = first; n < end; ++n) {
            pages.clear();
            Vec3 at;
            const VertexId v = faces.star(n, pages, at);
            crossing.find(v, at, pages, found);
        }
        return found;
    };
    for_chunks(faces.star_count(), kStars, threads, in_stars, append_to(all));
}

/// Adds all others.
template <class Faces>
void find_apart(const Faces& faces, const SortedFaceTree& tree, std::uint32_t threads, Pairs& all) {
    const auto in_parts = [&](std::uint32_t first, std::uint32_t end) {
        Pairs found;
        cross_apart(faces, tree, first, end, found);
        return found;
    };
    for_chunks(tree.boxes().part_count(), kParts, threads, in_parts, append_to(all));
}

/// Two passes that only read the faces.
template <class Faces>
Pairs find_all(const Faces& faces, const SortedFaceTree& tree, std::uint32_t threads) {
    Pairs all;
    find_in_stars(faces, threads, all);
    find_apart(faces, tree, threads, all);
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

std::vector<FacePair> find_crossings(const Mesh& mesh, const SortedFaceTree& tree, std::uint32_t threads) {
    return find_all(MeshFaces(mesh), tree, threads);
}

std::vector<FacePair> find_crossings_apart(const Mesh& mesh, const SortedFaceTree& tree, std::uint32_t threads) {
    Pairs found;
    find_apart(MeshFaces(mesh), tree, threads, found);
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<FacePair> find_crossings(std::span<const LabelledFace> faces, std::uint32_t threads) {
    const ListedFaces listed(faces, threads);
    Box extent;
    for (const LabelledFace& face : faces)
        for (Vec3 p : face.placed.at) extent.add(p);
    const SortedFaceTree tree(
        static_cast<std::uint32_t>(faces.size()), extent, [&](FaceId f) { return box_of(listed.corners(f)); }, threads);
    return find_all(listed, tree, threads);
}

}  // namespace regionmesh
