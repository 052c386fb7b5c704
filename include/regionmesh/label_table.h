// Maps the labels of the input to dense labels, and back.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "regionmesh/label.h"

namespace regionmesh {

/// Numbers input labels densely in order of first appearance. 64-bit labels are carried bit for bit.
class LabelTable {
public:
    explicit LabelTable(bool is_unsigned = false) : is_unsigned_(is_unsigned) {}

    Label dense(InputLabel label) {
        if (label == last_ && !labels_.empty()) return last_dense_;
        const auto [place, is_new] = dense_.try_emplace(label, static_cast<Label>(labels_.size()));
        if (is_new) labels_.push_back(label);
        last_ = label;
        return last_dense_ = place->second;
    }
    /// The same for each label of a row, into a row as long. Looks up only those that differ from the label before.
    void dense(std::span<const InputLabel> labels, std::span<Label> result);
    /// Nothing for a label that is not in the table.
    std::optional<Label> find(InputLabel label) const {
        const auto place = dense_.find(label);
        return place == dense_.end() ? std::nullopt : std::optional(place->second);
    }
    InputLabel input(Label dense) const { return labels_[dense]; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(labels_.size()); }
    bool is_unsigned() const { return is_unsigned_; }
    /// Whether a label is 2^63 or more.
    bool has_large() const;

    /// The label that stands for the exterior in files and arrays; it is never a label of the table. -1 unless a label
    /// is negative as a signed number (an unsigned label of 2^63 or more is); then the smallest label minus 1; if that
    /// is out of range, the first free label counting down from -1.
    InputLabel exterior_label() const;
    /// Decimal text of a label, signed or unsigned as in the input.
    std::string text(InputLabel label) const {
        return is_unsigned_ ? std::to_string(static_cast<std::uint64_t>(label)) : std::to_string(label);
    }
    /// Numeric order of labels, signed or unsigned as in the input.
    bool less(InputLabel a, InputLabel b) const { return InputLabelOrder{is_unsigned_}(a, b); }

private:
    std::unordered_map<InputLabel, Label> dense_;
    std::vector<InputLabel> labels_;
    InputLabel last_ = 0;
    Label last_dense_ = 0;
    bool is_unsigned_;
};

}  // namespace regionmesh
