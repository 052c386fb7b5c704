#include "regionmesh/smooth/nifpms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/base/triangle.h"
#include "regionmesh/smooth/relax.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 256;  // vertices

bool is_before(Vec3 p, Vec3 q) { return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z; }

double gaussian(double square, double sigma) { return std::exp(-square / (2 * sigma * sigma)); }

/// A face, or an edge of a line, that speaks for the surface near a vertex.
struct Witness {
    Vec3 middle;
    double size;                      // area or length
    std::array<std::uint32_t, 3> at;  // its vertices in the order of their places; of an edge, the first two
};

/// Collects the witnesses of one vertex after another.
class Witnesses {
public:
    Witnesses(const SurfaceWindow& window, const Neighbours& neighbours, const SlidingLists& stars)
        : window_(window), neighbours_(neighbours), stars_(stars) {}

    /// Faces of the interface of v, or edges of its line, that a path within `reach` joins to it; in the order of their
    /// places. None for points, and for vertices without neighbours.
    const std::vector<Witness>& near(std::uint32_t v, double reach) {
        found_.clear();
        const auto own = neighbours_.of(v);
        if (is_inside_interface(v) && own.size() > 2)
            grow_faces(v, reach);
        else if (own.size() == 2)
            for (std::uint32_t next : own) walk_line(v, next, reach);
        std::sort(found_.begin(), found_.end(),
                  [](const Witness& a, const Witness& b) { return is_before(a.middle, b.middle); });
        return found_;
    }
    bool are_faces() const { return are_faces_; }

private:
    bool is_inside_interface(std::uint32_t v) const {
        const auto star = stars_.of(v);
        return std::all_of(star.begin(), star.end(), [&](std::uint32_t corner) {
            return is_same_interface(window_.faces[corner >> 2].labels, window_.faces[star[0] >> 2].labels);
        });
    }
    static bool is_same_interface(const std::array<Label, 2>& a, const std::array<Label, 2>& b) {
        return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]);
    }

    void grow_faces(std::uint32_t v, double reach) {
        are_faces_ = true;
        const auto labels = window_.faces[stars_.of(v)[0] >> 2].labels;
        const Vec3 from = window_.origin[v];
        seen_.clear();
        queue_.assign(1, v);
        seen_vertices_.assign(1, v);
        for (std::size_t n = 0; n < queue_.size(); ++n) {
            for (std::uint32_t corner : stars_.of(queue_[n])) {
                const std::uint32_t f = corner >> 2;
                const WindowFace& face = window_.faces[f];
                if (!is_same_interface(face.labels, labels) || !add(seen_, f)) continue;
                std::array<std::uint32_t, 3> at = face.vertices;
                std::sort(at.begin(), at.end(), [&](std::uint32_t p, std::uint32_t q) {
                    return is_before(window_.origin[p], window_.origin[q]);
                });
                const Vec3 a = window_.origin[at[0]], b = window_.origin[at[1]], c = window_.origin[at[2]];
                const Vec3 middle = (a + b + c) / 3.0;
                if (length2(middle - from) > reach * reach) continue;
                found_.push_back({middle, 0.5 * length(area_vector(a, b, c)), at});
                for (std::uint32_t w : face.vertices)
                    if (add(seen_vertices_, w)) queue_.push_back(w);
            }
        }
    }

    void walk_line(std::uint32_t v, std::uint32_t next, double reach) {
        are_faces_ = false;
        const Vec3 from = window_.origin[v];
        for (std::uint32_t at = v;;) {
            const Vec3 p = window_.origin[at], q = window_.origin[next], middle = 0.5 * (p + q);
            if (length2(middle - from) > reach * reach) return;
            found_.push_back({middle, length(q - p), {at, next, next}});
            const auto onward = neighbours_.of(next);
            if (onward.size() != 2 || next == v) return;
            const std::uint32_t after = onward[0] == at ? onward[1] : onward[0];
            at = next;
            next = after;
        }
    }

    /// Adds to a small sorted set; false when it was there.
    static bool add(std::vector<std::uint32_t>& set, std::uint32_t n) {
        const auto at = std::lower_bound(set.begin(), set.end(), n);
        if (at != set.end() && *at == n) return false;
        set.insert(at, n);
        return true;
    }

    const SurfaceWindow& window_;
    const Neighbours& neighbours_;
    const SlidingLists& stars_;
    std::vector<Witness> found_;
    std::vector<std::uint32_t> queue_, seen_, seen_vertices_;
    bool are_faces_ = true;
};

/// Where p comes to lie on the plane of a face, or on an edge, with the direction of the mollified places.
Vec3 projected(Vec3 p, const Witness& witness, bool is_face, const SlidingArray<Vec3>& mollified) {
    const Vec3 a = mollified[witness.at[0]], b = mollified[witness.at[1]], c = mollified[witness.at[2]];
    const Vec3 direction = is_face ? area_vector(a, b, c) : b - a;
    const double square = length2(direction);
    if (!(square > 0)) return p;
    const Vec3 along = dot(p - witness.middle, direction) / square * direction;
    return is_face ? p - along : witness.middle + along;
}

}  // namespace

void Nifpms::add_layer(const LayerStars& stars) {
    for (std::uint32_t v = stars.vertices().first; v < stars.vertices().end; ++v) stars_.push_back(stars.of(v));
}

void Nifpms::mollify(NumberRange vertices, SlidingArray<Vec3>& mollified) const {
    const double sigma = 0.5 * options_.nifpms_reach * options_.scale;
    parallel_for((vertices.size() + kChunk - 1) / kChunk, options_.threads, [&](std::uint32_t n) {
        Witnesses witnesses(window_, neighbours_, stars_);
        const std::uint32_t first = vertices.first + n * kChunk;
        for (std::uint32_t v = first; v < std::min(vertices.end, first + kChunk); ++v) {
            const Vec3 p = window_.origin[v];
            Vec3 sum;
            double weights = 0;
            for (const Witness& witness : witnesses.near(v, mollifying_reach())) {
                const double weight = witness.size * gaussian(length2(witness.middle - p), sigma);
                sum += weight * (witness.middle - p);
                weights += weight;
            }
            mollified[v] = weights > 0 ? p + sum / weights : p;
        }
    });
}

void Nifpms::predict(NumberRange vertices, const SlidingArray<Vec3>& mollified, SlidingArray<Vec3>& to) const {
    const double sigma = options_.nifpms_reach * options_.scale, bound = options_.nifpms_bound * options_.scale;
    parallel_for((vertices.size() + kChunk - 1) / kChunk, options_.threads, [&](std::uint32_t n) {
        Witnesses witnesses(window_, neighbours_, stars_);
        const std::uint32_t first = vertices.first + n * kChunk;
        for (std::uint32_t v = first; v < std::min(vertices.end, first + kChunk); ++v) {
            const Vec3 p = window_.origin[v];
            Vec3 sum;
            double weights = 0;
            for (const Witness& witness : witnesses.near(v, predicting_reach())) {
                const Vec3 step = projected(p, witness, witnesses.are_faces(), mollified) - p;
                const double weight =
                    witness.size * gaussian(length2(witness.middle - p), sigma) * gaussian(length2(step), bound);
                sum += weight * step;
                weights += weight;
            }
            Vec3 q = weights > 0 ? p + sum / weights : p;
            keep_on_sides(window_.sides[v], p, q);
            to[v] = q;
        }
    });
}

}  // namespace regionmesh
