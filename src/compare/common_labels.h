// One numbering for the labels of two models: the same label of the input has the same number in both.
#pragma once

#include <array>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_table.h"

namespace regionmesh {

/// Numbers the labels of both tables in ascending order, as numbers: where one has labels of 2^63 and more, they are
/// not the negative labels of the other, for which there is no room then. All sides of the box are one label,
/// exterior(0).
class CommonLabels {
public:
    /// Throws Error(kInput) where one table has labels of 2^63 and more, and the other negative ones.
    CommonLabels(const LabelTable& a, const LabelTable& b);

    /// The common label of a dense label of model 0 or 1.
    Label common(int mesh, Label dense) const {
        return is_exterior(dense) ? exterior(0) : common_[static_cast<std::size_t>(mesh)][dense];
    }
    const LabelTable& table() const { return table_; }
    /// The common labels of the input labels that at least one model has.
    std::vector<Label> common_of(const std::vector<InputLabel>& labels) const;

private:
    LabelTable table_;
    std::array<std::vector<Label>, 2> common_;
};

}  // namespace regionmesh
