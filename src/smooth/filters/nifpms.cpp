#include "smooth/filters/nifpms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "base/parallel_for.h"
#include "base/triangle.h"
#include "regionmesh/ids.h"
#include "smooth/filters/relax.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using smoothing::kNifpmsTask;

bool is_before(Vec3 p, Vec3 q) { return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z; }

double gaussian(double square, double sigma) { return std::exp(-square / (2 * sigma * sigma)); }

/// False for a step that is no number: faces outside the window must not be reached.
bool is_within(Vec3 step, double reach) { return length2(step) <= reach * reach; }

/// A face, or an edge of a line, that predicts the position of a near vertex.
struct Witness {
    Vec3 middle;
    double size;            // area or length
    FaceId face = kNoFace;  // or else the ends of an edge
    std::uint32_t from = 0, to = 0;
};

/// A small set of numbers that is cleared in constant time.
class SmallSet {
public:
    void clear() {
        if (++now_ == 0 || held_ > kSlots / 2) {
            slots_.assign(slots_.size(), {});
            now_ = 1;
        }
        held_ = 0;
    }
    /// False if the number was in the set.
    bool add(std::uint32_t n) {
        if (2 * held_ >= slots_.size()) grow();
        Slot& slot = find(n);
        if (slot.epoch == now_) return false;
        slot = {n, now_};
        ++held_;
        return true;
    }

private:
    struct Slot {
        std::uint32_t number = 0, epoch = 0;
    };
    static constexpr std::size_t kSlots = 1024;

    Slot& find(std::uint32_t n) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = mix64(n) & mask;
        while (slots_[at].epoch == now_ && slots_[at].number != n) at = (at + 1) & mask;
        return slots_[at];
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.epoch == now_) find(slot.number) = slot;
    }

    std::vector<Slot> slots_ = std::vector<Slot>(kSlots);
    std::uint32_t now_ = 1;
    std::size_t held_ = 0;
};

/// Collects the witnesses of one vertex after another.
class Witnesses {
public:
    Witnesses(const SurfaceWindow& window, const Neighbours& neighbours, const SlidingLists& stars,
              const SlidingArray<Nifpms::FaceMeasure>& measures)
        : window_(window), neighbours_(neighbours), stars_(stars), measures_(measures) {}

    /// Faces of the interface of v, or edges of its line, that a path within `reach` connects with it; sorted by
    /// position. None for quadruple points, and for vertices without neighbours.
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
        const auto labels = window_.faces[stars_.of(v)[0] >> 2].labels;
        const Vec3 from = window_.origin[v];
        seen_faces_.clear();
        seen_vertices_.clear();
        queue_.assign(1, v);
        seen_vertices_.add(v);
        for (std::size_t n = 0; n < queue_.size(); ++n) {
            for (std::uint32_t corner : stars_.of(queue_[n])) {
                const std::uint32_t f = corner >> 2;
                if (!seen_faces_.add(f)) continue;
                const ChunkFace& face = window_.faces[f];
                const auto& [middle, area] = measures_[f];
                if (!is_same_interface(face.labels, labels) || !is_within(middle - from, reach)) continue;
                found_.push_back({middle, area, FaceId{f}});
                for (std::uint32_t w : face.vertices)
                    if (seen_vertices_.add(w)) queue_.push_back(w);
            }
        }
    }

    void walk_line(std::uint32_t v, std::uint32_t next, double reach) {
        const Vec3 from = window_.origin[v];
        for (std::uint32_t at = v;;) {
            const Vec3 p = window_.origin[at], q = window_.origin[next], middle = 0.5 * (p + q);
            if (!is_within(middle - from, reach)) return;
            found_.push_back({middle, length(q - p), kNoFace, at, next});
            const auto onward = neighbours_.of(next);
            if (onward.size() != 2 || next == v) return;
            const std::uint32_t after = onward[0] == at ? onward[1] : onward[0];
            at = next;
            next = after;
        }
    }

    const SurfaceWindow& window_;
    const Neighbours& neighbours_;
    const SlidingLists& stars_;
    const SlidingArray<Nifpms::FaceMeasure>& measures_;
    std::vector<Witness> found_;
    std::vector<std::uint32_t> queue_;
    SmallSet seen_faces_, seen_vertices_;
};

/// Projection of p on an edge with the direction of its mollified positions.
Vec3 projected_on_line(Vec3 p, Vec3 middle, Vec3 direction) {
    const double square = length2(direction);
    return square > 0 ? middle + dot(p - middle, direction) / square * direction : p;
}

}  // namespace

void Nifpms::note_stars(const ChunkStars& stars) {
    for (std::uint32_t v = stars.vertices().first; v < stars.vertices().end; ++v) stars_.push_back(stars.of(v));
}

void Nifpms::note_chunk(std::uint32_t chunk) {
    const NumberRange faces = input_.window.faces_of(chunk);
    for (std::uint32_t f = faces.first; f < faces.end; ++f) {
        // Sorted by position, so that the result does not depend on the first vertex of a face.
        std::array<Vec3, 3> p;
        for (int n = 0; n < 3; ++n) p[n] = input_.window.origin[input_.window.faces[f].vertices[n]];
        std::sort(p.begin(), p.end(), is_before);
        measures_.push_back({(p[0] + p[1] + p[2]) / 3.0, 0.5 * length(area_vector(p[0], p[1], p[2]))});
    }
}

void Nifpms::run(std::uint32_t pass, std::uint32_t chunk, const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to) {
    const NumberRange vertices = input_.window.vertices_of(chunk);
    if (pass == 0) {
        mollify(vertices, to);
        return;
    }
    const std::uint32_t end = std::min(chunk + chunks_ahead(pass), input_.window.chunk_end());
    note_normals(input_.window.faces_of(end - 1).end, from);
    predict(vertices, from, to);
}

void Nifpms::drop_before(std::uint32_t v, std::uint32_t f) {
    if (stars_.end() == 0) return;
    stars_.drop_before(v);
    measures_.drop_before(f);
    normals_.drop_before(f);
}

void Nifpms::mollify(NumberRange vertices, SlidingArray<Vec3>& mollified) const {
    const double sigma = 0.5 * input_.options.nifpms_reach * input_.options.scale;
    parallel_for((vertices.size() + kNifpmsTask - 1) / kNifpmsTask, input_.options.threads, [&](std::uint32_t n) {
        Witnesses witnesses(input_.window, input_.neighbours, stars_, measures_);
        const std::uint32_t first = vertices.first + n * kNifpmsTask;
        for (std::uint32_t v = first; v < std::min(vertices.end, first + kNifpmsTask); ++v) {
            const Vec3 p = input_.window.origin[v];
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

void Nifpms::note_normals(std::uint32_t face_end, const SlidingArray<Vec3>& mollified) {
    for (std::uint32_t f = normals_.end(); f < face_end; ++f) {
        std::array<Vec3, 3> p;
        for (int n = 0; n < 3; ++n) p[n] = mollified[input_.window.faces[f].vertices[n]];
        std::sort(p.begin(), p.end(), is_before);
        const Vec3 normal = area_vector(p[0], p[1], p[2]);
        const double size = length(normal);
        normals_.push_back(size > 0 ? normal / size : Vec3{});
    }
}

void Nifpms::predict(NumberRange vertices, const SlidingArray<Vec3>& mollified, SlidingArray<Vec3>& to) const {
    const double reach = input_.options.nifpms_reach * input_.options.scale,
                 bound = input_.options.nifpms_bound * input_.options.scale;
    const double by_distance = 1 / (2 * reach * reach), by_height = 1 / (2 * bound * bound);
    parallel_for((vertices.size() + kNifpmsTask - 1) / kNifpmsTask, input_.options.threads, [&](std::uint32_t n) {
        Witnesses witnesses(input_.window, input_.neighbours, stars_, measures_);
        const std::uint32_t first = vertices.first + n * kNifpmsTask;
        for (std::uint32_t v = first; v < std::min(vertices.end, first + kNifpmsTask); ++v) {
            const Vec3 p = input_.window.origin[v];
            Vec3 sum;
            double weights = 0;
            for (const Witness& witness : witnesses.near(v, predicting_reach())) {
                const Vec3 step =
                    witness.face == kNoFace
                        ? projected_on_line(p, witness.middle, mollified[witness.to] - mollified[witness.from]) - p
                        : dot(witness.middle - p, normals_[index(witness.face)]) * normals_[index(witness.face)];
                const double weight =
                    witness.size * std::exp(-by_distance * length2(witness.middle - p) - by_height * length2(step));
                sum += weight * step;
                weights += weight;
            }
            Vec3 q = weights > 0 ? p + sum / weights : p;
            keep_on_sides(input_.window.sides[v], p, q);
            to[v] = q;
        }
    });
}

}  // namespace regionmesh
