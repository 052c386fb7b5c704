// One of two models that are compared, part by part.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compare/sample.h"
#include "compare/sorted_strata.h"
#include "compare/strata_tree.h"
#include "regionmesh/compare.h"

namespace regionmesh {

/// The strata of all parts: interfaces or lines.
struct ModelStrata {
    std::vector<std::vector<Label>> labels;  // common labels, ascending; in ascending order
    std::vector<double> measures;            // area or length of each
    std::vector<Box> boxes;                  // box of the simplices in each part

    /// The stratum with these labels, or kNoStratum.
    std::uint32_t find(const std::vector<Label>& of_stratum) const;
    /// The stratum with the same labels, for each of a part, or of another model, the one with the same labels.
    std::vector<std::uint32_t> numbers_of(const SortedStrata& part) const;
};

/// A part, with trees where it is searched.
struct SearchedPart {
    const SortedStrata interfaces, lines;
    std::optional<StrataTree> face_tree, line_tree;
};

/// Settings of the comparison, the same for both models.
struct SideOptions {
    std::vector<Label> background;  // common labels
    bool sides_apart = true;        // sides of the box are distinct, as in lines_of()
    std::uint64_t samples = 0;      // number on faces; a tenth of it on lines
    std::uint32_t threads = 0;
};

/// Holds the sums over the model, and the part read last. Holds references to its arguments.
class ModelSide {
public:
    /// Reads all parts. `which` is 0 or 1, as in `labels`.
    ModelSide(const ComparedModel& model, const CommonLabels& labels, int which, const SideOptions& options);

    const ModelStrata& interfaces() const { return interfaces_; }
    const ModelStrata& lines() const { return lines_; }
    const Samples& face_samples() const { return *face_samples_; }
    const Samples& line_samples() const { return *line_samples_; }
    const std::vector<Label>& background() const { return options_.background; }
    /// Box of all vertices; empty where there are no faces.
    const Box& bounds() const { return bounds_; }
    std::uint32_t part_count() const { return model_.part_count(); }

    struct Points {
        std::vector<Vec3> faces, lines;
    };
    /// The points of all samples. Reads all parts.
    Points sample();
    /// Valid until the next call of another function.
    const SearchedPart& searched(std::uint32_t part);
    /// Ends a search: frees the trees.
    void drop_trees();

private:
    SearchedPart& read(std::uint32_t part);

    const ComparedModel& model_;
    const CommonLabels& labels_;
    int which_;
    const SideOptions& options_;
    ModelStrata interfaces_, lines_;
    Box bounds_;
    std::optional<Samples> face_samples_, line_samples_;
    std::unique_ptr<SearchedPart> part_;
    std::uint32_t number_ = 0;  // number of part_
};

}  // namespace regionmesh
