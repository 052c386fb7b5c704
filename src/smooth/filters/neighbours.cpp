#include "smooth/filters/neighbours.h"

#include <algorithm>

#include "base/hash.h"
#include "base/parallel_for.h"
#include "mesh/label_set.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using smoothing::kNeighbourTask;

void add_sides(LabelSet& set, SideSet sides) {
    for (int side = 0; side < kSideCount; ++side)
        if (sides >> side & 1) set.add(exterior(side));
}

/// Finds the neighbours of one vertex after another.
class Finder {
public:
    Finder(const SurfaceWindow& window, bool move_points) : window_(window), move_points_(move_points) {}

    const std::vector<std::uint32_t>& find(std::uint32_t v, std::span<const std::uint32_t> star) {
        found_.clear();
        if (!is_inside_interface(v, star)) find_along_lines(v, star);
        std::sort(found_.begin(), found_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const Vec3 p = window_.origin[a], q = window_.origin[b];
            return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
        });
        return found_;
    }

private:
    struct Spoke {
        std::uint32_t vertex;
        LabelSet labels;
        int uses;
        bool is_open;  // the surface ends here, and not at a side of the box
    };

    /// All faces have the same two labels, and the star is closed: each neighbour follows v in one face.
    bool is_inside_interface(std::uint32_t v, std::span<const std::uint32_t> star) {
        if (star.empty()) return true;
        const auto& labels = window_.faces[star[0] >> 2].labels;
        const Label low = std::min(labels[0], labels[1]), high = std::max(labels[0], labels[1]);
        std::uint64_t sum =
            0;  // hashes of the vertices after v in its faces, less those before: 0 if the star is closed
        for (std::uint32_t corner : star) {
            const ChunkFace& face = window_.faces[corner >> 2];
            if (std::min(face.labels[0], face.labels[1]) != low || std::max(face.labels[0], face.labels[1]) != high)
                return false;
            // Seen from the lower label, all faces have the same orientation.
            const std::uint32_t place = corner & 3, step = face.labels[0] == low ? 1 : 2;
            const std::uint32_t after = face.vertices[(place + step) % 3];
            found_.push_back(after);
            sum += mix64(after) - mix64(face.vertices[(place + 3 - step) % 3]);
        }
        const SideSet sides = window_.sides[v];
        const bool is_on_line =
            sides != 0 && !(is_exterior(high) && sides == static_cast<SideSet>(1u << side_of(high)));
        if (sum == 0 && !is_on_line) return true;
        return false;
    }

    void find_along_lines(std::uint32_t v, std::span<const std::uint32_t> star) {
        found_.clear();
        gather_spokes(v, star);
        LabelSet own;
        add_sides(own, window_.sides[v]);
        for (std::uint32_t corner : star)
            for (Label label : window_.faces[corner >> 2].labels) own.add(label);
        const bool is_point = own.size() > 3;
        if (is_point && !move_points_) return;
        for (const Spoke& spoke : spokes_) {
            if (spoke.is_open) {
                found_.clear();
                return;
            }
            if (spoke.labels.size() >= (is_point ? 3 : own.size())) found_.push_back(spoke.vertex);
        }
        if (own.size() == 3 && found_.size() != 2) found_.clear();  // a line that ends or forks here
    }

    void gather_spokes(std::uint32_t v, std::span<const std::uint32_t> star) {
        spokes_.clear();
        for (std::uint32_t corner : star) {
            const ChunkFace& face = window_.faces[corner >> 2];
            for (std::uint32_t step = 1; step < 3; ++step) {
                const std::uint32_t w = face.vertices[((corner & 3) + step) % 3];
                auto at = std::find_if(spokes_.begin(), spokes_.end(), [&](const Spoke& s) { return s.vertex == w; });
                if (at == spokes_.end()) at = spokes_.insert(at, {w, {}, 0, false});
                for (Label label : face.labels) at->labels.add(label);
                ++at->uses;
            }
        }
        // Where the surface ends on the box (not capped, or background), the sides count as the faces not made there.
        for (Spoke& spoke : spokes_) {
            if (spoke.uses >= spoke.labels.size()) continue;
            const SideSet common = window_.sides[v] & window_.sides[spoke.vertex];
            add_sides(spoke.labels, common);
            spoke.is_open = common == 0;
        }
    }

    const SurfaceWindow& window_;
    bool move_points_;
    std::vector<Spoke> spokes_;
    std::vector<std::uint32_t> found_;
};

}  // namespace

void Neighbours::add_chunk(const SurfaceWindow& window, const ChunkStars& stars, std::uint32_t threads) {
    const NumberRange vertices = stars.vertices();
    std::vector<SlidingLists> parts((vertices.size() + kNeighbourTask - 1) / kNeighbourTask);
    parallel_for(static_cast<std::uint32_t>(parts.size()), threads, [&](std::uint32_t n) {
        Finder finder(window, move_points_);
        const std::uint32_t first = vertices.first + n * kNeighbourTask;
        for (std::uint32_t v = first; v < std::min(vertices.end, first + kNeighbourTask); ++v)
            parts[n].push_back(finder.find(v, stars.of(v)));
    });
    for (const SlidingLists& part : parts)
        for (std::uint32_t n = 0; n < part.end(); ++n) lists_.push_back(part.of(n));
}

}  // namespace regionmesh
