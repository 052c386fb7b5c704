// Each strip in turn: faces by cell, then for each fine sample of a cell a walk from the coarse sample nearest to it.
#include "denoise/coarse_surface.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "base/parallel_for.h"
#include "cells/strip_mesher.h"
#include "smooth/chunk_smoother.h"
#include "surface/chunk.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

struct CellFace {
    std::array<Vec3, 3> corners;  // in coarse samples along the axes of the sweep
    std::array<Label, 2> labels;
};

/// The faces of a row of cells, sorted by cell.
using RowFaces = std::vector<std::pair<std::uint32_t, CellFace>>;

/// A strip on its way through the smoother.
struct CoarseStrip {
    std::vector<Label> low, high;
};

/// Where the segment from `a` to `b` crosses the face, as a share of it; negative: nowhere.
double crossing(Vec3 a, Vec3 b, const CellFace& face) {
    const Vec3 along = b - a, u = face.corners[1] - face.corners[0], v = face.corners[2] - face.corners[0];
    const Vec3 p = cross(along, v);
    const double determinant = dot(u, p);
    if (determinant == 0) return -1;
    const Vec3 from = a - face.corners[0];
    const double s = dot(from, p) / determinant;
    if (s < 0 || s > 1) return -1;
    const Vec3 q = cross(from, u);
    const double t = dot(along, q) / determinant;
    if (t < 0 || s + t > 1) return -1;
    const double share = dot(v, q) / determinant;
    return share >= 0 && share <= 1 ? share : -1;
}

class StripLabels {
public:
    StripLabels(const std::array<CoarseAxis, 3>& axes, const VolumeInfo& coarse, std::uint32_t threads)
        : axes_(axes), info_(coarse), threads_(threads), rows_(axes[1].size() - 1) {}

    /// Appends the candidates of the fine sections of strip `number`.
    void add(const Chunk& chunk, const std::vector<ChunkVertex>& carried, const CoarseStrip& strip,
             std::uint32_t number, ItemsBySection<Candidate>& candidates) {
        sort_faces(chunk, carried, number);
        const std::uint32_t first = axes_[2].first_in_cell[number], end = axes_[2].first_in_cell[number + 1];
        for (std::uint32_t s = first; s < end; ++s) {
            const double height = axes_[2].place(s) - number;
            parallel_for(static_cast<std::uint32_t>(rows_.size()), threads_, [&](std::uint32_t j) {
                found_[j].clear();
                look_at_row(strip, j, height);
            });
            section_.clear();
            for (const auto& row : found_) section_.insert(section_.end(), row.begin(), row.end());
            std::ranges::sort(section_, {}, &Candidate::sample);
            candidates.append(section_);
        }
    }

private:
    void sort_faces(const Chunk& chunk, const std::vector<ChunkVertex>& carried, std::uint32_t number) {
        for (RowFaces& row : rows_) row.clear();
        const auto& order = info_.sweep.axes;
        const auto place = [&](std::uint32_t local) {
            const Vec3 at = vertex_of(chunk, carried, local).position;
            return Vec3{at[order[0]] / info_.lattice.spacing[order[0]], at[order[1]] / info_.lattice.spacing[order[1]],
                        at[order[2]] / info_.lattice.spacing[order[2]] - number};
        };
        for (const ChunkFace& face : chunk.faces) {
            if (is_exterior(face.labels[0]) || is_exterior(face.labels[1])) continue;
            const CellFace made{{place(face.vertices[0]), place(face.vertices[1]), place(face.vertices[2])},
                                face.labels};
            const Vec3 middle = (made.corners[0] + made.corners[1] + made.corners[2]) / 3;
            const double i = std::clamp(std::floor(middle.x), 0.0, axes_[0].size() - 2.0);
            const double j = std::clamp(std::floor(middle.y), 0.0, axes_[1].size() - 2.0);
            rows_[static_cast<std::size_t>(j)].emplace_back(static_cast<std::uint32_t>(i), made);
        }
        for (RowFaces& row : rows_)
            std::ranges::stable_sort(row, {}, [](const RowFaces::value_type& face) { return face.first; });
        found_.resize(rows_.size());
    }

    void look_at_row(const CoarseStrip& strip, std::uint32_t j, double height) {
        const RowFaces& faces = rows_[j];
        for (auto first = faces.begin(); first != faces.end();) {
            auto last = first;
            while (last != faces.end() && last->first == first->first) ++last;
            look_at_cell(strip, first->first, j, height, {first, last});
            first = last;
        }
    }

    void look_at_cell(const CoarseStrip& strip, std::uint32_t i, std::uint32_t j, double height,
                      std::span<const RowFaces::value_type> faces) {
        for (std::uint32_t v = axes_[1].first_in_cell[j]; v < axes_[1].first_in_cell[j + 1]; ++v)
            for (std::uint32_t u = axes_[0].first_in_cell[i]; u < axes_[0].first_in_cell[i + 1]; ++u) {
                const Vec3 to{axes_[0].place(u), axes_[1].place(v), height};
                const Vec3 corner{std::clamp(std::floor(to.x + 0.5), double(i), i + 1.0),
                                  std::clamp(std::floor(to.y + 0.5), double(j), j + 1.0), height < 0.5 ? 0.0 : 1.0};
                const auto& labels = corner.z == 0 ? strip.low : strip.high;
                const Label own =
                    labels[static_cast<std::size_t>(corner.y) * axes_[0].size() + static_cast<std::size_t>(corner.x)];
                const Label other = walk({double(i), double(j), 0}, corner, to, own, faces);
                if (other != own) found_[j].push_back({v * axes_[0].fine + u, other});
            }
    }

    /// The label at the end of the segment; `own` where crossings do not follow each other.
    static Label walk(Vec3 cell, Vec3 from, Vec3 to, Label own, std::span<const RowFaces::value_type> faces) {
        // Samples lie on edges and sides of cells, where faces meet: the segment is moved into the cell, each end by
        // another share, to a place with no symmetry.
        constexpr double kStart = 1e-4, kEnd = 1.3e-4;
        const Vec3 inside = cell + Vec3{0.413, 0.467, 0.539};
        const Vec3 a = from + kStart * (inside - from), b = to + kEnd * (inside - to);
        std::array<std::pair<double, const CellFace*>, 32> crossed;
        std::size_t count = 0;
        for (const auto& face : faces)
            if (const double share = crossing(a, b, face.second); share >= 0) {
                if (count == crossed.size()) return own;
                crossed[count++] = {share, &face.second};
            }
        std::sort(crossed.begin(), crossed.begin() + static_cast<std::ptrdiff_t>(count));
        Label label = own;
        for (std::size_t n = 0; n < count; ++n) {
            const auto& sides = crossed[n].second->labels;
            if (sides[0] != label && sides[1] != label) return own;
            label = sides[0] == label ? sides[1] : sides[0];
        }
        return label;
    }

    const std::array<CoarseAxis, 3>& axes_;
    const VolumeInfo& info_;
    std::uint32_t threads_;
    std::vector<RowFaces> rows_;
    std::vector<std::vector<Candidate>> found_;
    std::vector<Candidate> section_;
};

}  // namespace

void find_candidates(SectionReader& coarse, const std::array<CoarseAxis, 3>& axes, LabelTable& labels,
                     std::uint32_t threads, ItemsBySection<Candidate>& candidates) {
    coarse.rewind();
    const VolumeInfo& info = coarse.info();
    const int axis = info.sweep.axes[2];
    SectionWindow window(coarse, labels);
    StripMesher mesher(info.lattice, info.sweep, {.cells = CellKind::kCompact, .cuts = QuadCuts::kCones});
    SmoothOptions options{.filter = SmoothFilter::kLattice};
    options.threads = threads;
    const auto smoother = make_chunk_smoother(options, {.axis = axis,
                                                        .thickness = info.lattice.spacing[axis],
                                                        .frame = {info.lattice.origin, info.lattice.spacing},
                                                        .cells = CellKind::kCompact});
    StripLabels strips(axes, info, threads);
    std::deque<CoarseStrip> waiting;
    std::vector<ChunkVertex> carried;
    std::uint32_t added = 0, done = 0;
    Chunk chunk;
    const auto take_out = [&] {
        while (smoother->next(chunk)) {
            strips.add(chunk, carried, waiting.front(), done++, candidates);
            carried = active_vertices(chunk, carried);
            waiting.pop_front();
        }
    };
    while (window.advance()) {
        chunk.clear();
        mesher.mesh(window.low(), window.high(), chunk);
        waiting.push_back({{window.low().begin(), window.low().end()}, {window.high().begin(), window.high().end()}});
        ++added;
        if (!smoother->add(chunk, window.is_last(), added * info.lattice.spacing[axis])) break;
        take_out();
    }
}

}  // namespace regionmesh
