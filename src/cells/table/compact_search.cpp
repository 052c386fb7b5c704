#include "cells/table/compact_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "cells/compact_cells.h"
#include "cells/table/polygon_cuts.h"

namespace regionmesh::cell_table {
namespace {

using Edge = std::pair<NodeSet, NodeSet>;

/// Sheets are cut one after the other; every choice is tried. A cell has at most 19 sheets, mostly with one cut each,
/// so that no cell comes near this number.
constexpr int kMostChoices = 200000;

static_assert(AnyPosition::kTenths == 10 * CompactCells::kInnerMargin);

bool is_inner_triangle(NodeSet vertex) {
    return std::popcount(static_cast<unsigned>(vertex)) == 3 && (vertex & kMainDiagonal) == kMainDiagonal;
}

/// The surface of one cell, with some of its inner vertices left out.
class CompactCell {
public:
    /// `kept` of the vertices inside the cell on lines between three labels stay; with `keeps_main` also that of the
    /// main diagonal, as an inner vertex of its sheet.
    CompactCell(const Partition& labels, const std::vector<Sheet>& sheets, const std::set<NodeSet>& kept,
                bool keeps_main, AnyPosition& positions)
        : labels_(labels), sheets_(sheets), kept_(kept), keeps_main_(keeps_main), positions_(positions) {}

    /// The faces with the best worst quality, if there are any.
    std::optional<std::vector<CellFace>> faces() {
        if (!shorten_boundaries() || !cut_sheets()) return {};
        chosen_.resize(sheets_.size());
        choose(0, HUGE_VAL);
        return best_;
    }
    double quality() const { return best_quality_; }

private:
    bool is_kept(NodeSet vertex) const {
        const int count = std::popcount(static_cast<unsigned>(vertex));
        if (vertex == kMainDiagonal) return false;
        if (is_inner_triangle(vertex)) return kept_.count(vertex) > 0;
        const bool is_diagonal = count == 2 && std::popcount(sides_of(vertex)) == 1;
        return !is_diagonal || !drops_diagonal(vertex, labels_);
    }

    /// False where a loop has too few vertices left, two lines would become one edge, or a line would lie in a side.
    bool shorten_boundaries() {
        std::map<Edge, Loop> paths;  // the vertices left out between the ends
        for (const Sheet& sheet : sheets_) {
            auto& loops = boundaries_.emplace_back();
            for (const Loop& whole : sheet.boundary) {
                const auto first = std::find_if(whole.begin(), whole.end(), [&](NodeSet v) { return is_kept(v); });
                if (first == whole.end()) return false;
                Loop turned(first, whole.end()), path;
                turned.insert(turned.end(), whole.begin(), first);
                turned.push_back(*first);
                Loop& loop = loops.emplace_back();
                for (NodeSet vertex : turned) {
                    if (!is_kept(vertex)) {
                        path.push_back(vertex);
                        continue;
                    }
                    if (!loop.empty()) {
                        if (loop.back() > vertex) std::reverse(path.begin(), path.end());
                        const auto known = paths.try_emplace(std::minmax(loop.back(), vertex), path).first;
                        if (!std::ranges::equal(known->second, path)) return false;
                        path.clear();
                    }
                    loop.push_back(vertex);
                }
                loop.pop_back();
                if (loop.size() < 3) return false;
            }
        }
        for (const auto& [edge, left_out] : paths) {
            const unsigned sides = sides_of(edge.first) & sides_of(edge.second);
            for (NodeSet vertex : left_out)
                if (sides && !(sides_of(vertex) & sides)) return false;
            edges_.insert(edge);
        }
        return true;
    }

    bool cut_sheets() {
        const IsChord is_chord = [&](NodeSet a, NodeSet b) {
            return !(sides_of(a) & sides_of(b)) && edges_.count(std::minmax(a, b)) == 0;
        };
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            const std::vector<Loop>& loops = boundaries_[s];
            if (loops.size() > 2 || sheets_[s].euler != 2 - static_cast<int>(loops.size())) return false;
            if (keeps_main_ && sheets_[s].has_main_diagonal) {
                if (loops.size() > 1) return false;
                cuts_.push_back(cone(loops[0]));
            } else {
                cuts_.push_back(cuts_of(loops, is_chord, positions_));
            }
            if (cuts_.back().empty()) return false;
        }
        return true;
    }

    /// The triangles from the main diagonal to a loop.
    std::vector<Cut> cone(const Loop& loop) const {
        Cut cut;
        for (std::size_t n = 0; n < loop.size(); ++n)
            cut.push_back({loop[n], loop[(n + 1) % loop.size()], kMainDiagonal});
        return are_apart(cut, cut) ? std::vector<Cut>{cut} : std::vector<Cut>{};
    }

    bool are_apart(const Cut& a, const Cut& b) const {
        for (const Triangle& t : a)
            for (const Triangle& u : b)
                if (t != u && !positions_.are_apart(t, u)) return false;
        return true;
    }

    /// Two sheets may not be cut along the same edge.
    bool share_chord(const Cut& a, const Cut& b) const {
        std::set<Edge> chords;
        for (const Triangle& t : a)
            for (int n = 0; n < 3; ++n) chords.insert(std::minmax(t[n], t[(n + 1) % 3]));
        for (const Triangle& t : b)
            for (int n = 0; n < 3; ++n) {
                const Edge edge = std::minmax(t[n], t[(n + 1) % 3]);
                if (edges_.count(edge) == 0 && chords.count(edge) > 0) return true;
            }
        return false;
    }

    void choose(std::size_t sheet, double quality) {
        if (quality <= best_quality_) return;
        if (++choices_ > kMostChoices) throw std::logic_error("a cell has too many cuts for all to be tried");
        if (sheet == sheets_.size()) {
            best_quality_ = quality;
            best_.emplace();
            for (std::size_t s = 0; s < sheets_.size(); ++s)
                for (const Triangle& t : *chosen_[s]) best_->push_back({t, sheets_[s].first, sheets_[s].second});
            return;
        }
        for (const Cut& cut : cuts_[sheet]) {
            bool fits = true;
            for (std::size_t s = 0; s < sheet && fits; ++s)
                fits = !share_chord(*chosen_[s], cut) && are_apart(*chosen_[s], cut);
            if (!fits) continue;
            chosen_[sheet] = &cut;
            choose(sheet + 1, std::min(quality, quality_of(cut)));
        }
    }

    const Partition& labels_;
    const std::vector<Sheet>& sheets_;
    const std::set<NodeSet>& kept_;
    bool keeps_main_;
    AnyPosition& positions_;
    std::vector<std::vector<Loop>> boundaries_;  // one list per sheet
    std::set<Edge> edges_;                       // edges of all boundaries
    std::vector<std::vector<Cut>> cuts_;         // one list per sheet
    std::vector<const Cut*> chosen_;
    std::optional<std::vector<CellFace>> best_;
    double best_quality_ = 0;
    int choices_ = 0;
};

}  // namespace

std::vector<CellFace> compact_faces(const Partition& labels, AnyPosition& positions) {
    const std::vector<CellFace> raw = tetrahedra_faces(labels);
    const std::vector<Sheet> sheets = sheets_of(raw);
    std::set<NodeSet> inner;
    bool has_main = false;
    for (const CellFace& face : raw)
        for (NodeSet vertex : face.vertices) {
            if (is_inner_triangle(vertex)) inner.insert(vertex);
            has_main |= vertex == kMainDiagonal;
        }
    // A vertex on a line costs a face in each of three sheets, that of the main diagonal two.
    const int most = 3 * static_cast<int>(inner.size()) + (has_main ? 2 : 0);
    const std::vector<NodeSet> candidates(inner.begin(), inner.end());
    for (int faces = 0; faces <= most; ++faces) {
        std::vector<CellFace> best;
        double quality = -1;
        for (unsigned choice = 0; choice < 1u << candidates.size(); ++choice) {
            const int rest = faces - 3 * std::popcount(choice);
            if (rest != 0 && !(rest == 2 && has_main)) continue;
            std::set<NodeSet> kept;
            for (std::size_t n = 0; n < candidates.size(); ++n)
                if (choice >> n & 1) kept.insert(candidates[n]);
            CompactCell cell(labels, sheets, kept, rest == 2, positions);
            const auto made = cell.faces();
            if (!made || cell.quality() <= quality) continue;
            best = *made;
            quality = cell.quality();
        }
        if (quality >= 0) return best;
    }
    return {};
}

std::string compact_table() {
    AnyPosition positions;
    std::set<Partition> done;
    std::string text;
    for_each_partition([&](const Partition& labels) {
        if (done.count(labels)) return;
        for (const CellSymmetry& symmetry : kCellSymmetries) done.insert(symmetry(labels));
        for (const CellFace& face : compact_faces(labels, positions)) {
            for (NodeSet vertex : face.vertices) text += kCompactAlphabet[place_in_cell(vertex)];
            text += kCompactAlphabet[8 * face.first + face.second];
        }
        text += kEndOfClass;
    });
    return text;
}

}  // namespace regionmesh::cell_table
