// The simplex nearest to a point: among all faces, those of one region or those of one interface; likewise for lines.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/box_tree.h"
#include "compare/sorted_strata.h"

namespace regionmesh {

inline constexpr std::uint32_t kNoSimplex = 0xFFFFFFFFu;

/// A nearest simplex. Among several at the same distance the choice is arbitrary but reproducible.
struct Nearest {
    double squared = HUGE_VAL;  // distance
    std::uint32_t simplex = kNoSimplex;
    std::uint32_t stratum = kNoStratum;
};

/// Runs of 64 neighbouring simplices of one stratum, with trees of boxes over the runs: one over all runs, one for each
/// label, one for each stratum. Takes about 30 bytes a simplex in addition to the simplices. Holds a reference to its
/// argument.
class StrataTree {
public:
    StrataTree(const SortedStrata& sorted, std::uint32_t threads);

    /// Finds none unless its squared distance is less than `below`, which it then returns. Starts at the simplex
    /// `guess` of another point: fast where the two points are near each other.
    Nearest nearest(Vec3 p, const Nearest& guess = {}, double below = HUGE_VAL) const;
    /// Finds none where no stratum has the label, or the stratum does not exist.
    Nearest nearest_of_label(Vec3 p, Label label, double below = HUGE_VAL) const;
    Nearest nearest_of_stratum(Vec3 p, std::uint32_t stratum, double below = HUGE_VAL) const;

    bool has_label(Label label) const { return label < by_label_.size() && !by_label_[label].is_empty(); }
    const SortedStrata& sorted() const { return sorted_; }

private:
    /// Up to eight blocks of up to eight simplices.
    struct Run {
        std::uint32_t first_simplex, first_block, stratum;
        EightBoxes blocks;
    };

    void make_runs();
    void put_boxes(Run& run);
    void make_trees();
    FloatPoint to_frame(Vec3 p) const;
    float limit_of(double squared) const;
    FloatBox outward(const Simplex& s) const;
    Nearest search(const BoxTree& tree, Vec3 p, Nearest found) const;
    void look_into(const Run& run, Vec3 p, const FloatPoint& in_frame, Nearest& found, float& limit) const;
    double squared_distance_to(Vec3 p, std::uint32_t simplex, double bound) const;

    const SortedStrata& sorted_;
    Vec3 middle_;       // origin of the single-precision coordinates,
    double scale_ = 1;  // scale whose unit is the half extent of the model
    std::vector<Run> runs_;
    std::vector<EightBoxes> blocks_;
    BoxTree all_;
    std::vector<BoxTree> by_label_, by_stratum_;
};

}  // namespace regionmesh
