#include "compare/common_labels.h"

#include <algorithm>

#include "regionmesh/error.h"

namespace regionmesh {

namespace {

bool has_negative(const LabelTable& table) {
    for (Label dense = 0; dense < table.size(); ++dense)
        if (!table.is_unsigned() && table.input(dense) < 0) return true;
    return false;
}

}  // namespace

CommonLabels::CommonLabels(const LabelTable& a, const LabelTable& b) : table_(a.has_large() || b.has_large()) {
    if (table_.is_unsigned() && (has_negative(a) || has_negative(b)))
        throw Error(ErrorCode::kInput,
                    "one model has labels of 2^63 and more, and the other negative labels; give both the same labels");
    std::vector<InputLabel> labels;
    for (const LabelTable* table : {&a, &b})
        for (Label dense = 0; dense < table->size(); ++dense) labels.push_back(table->input(dense));
    std::ranges::sort(labels, [&](InputLabel x, InputLabel y) { return table_.less(x, y); });
    for (const InputLabel label : labels) table_.dense(label);
    for (Label dense = 0; dense < a.size(); ++dense) common_[0].push_back(table_.dense(a.input(dense)));
    for (Label dense = 0; dense < b.size(); ++dense) common_[1].push_back(table_.dense(b.input(dense)));
}

std::vector<Label> CommonLabels::common_of(const std::vector<InputLabel>& labels) const {
    std::vector<Label> found;
    for (Label label = 0; label < table_.size(); ++label)
        if (std::ranges::find(labels, table_.input(label)) != labels.end()) found.push_back(label);
    return found;
}

}  // namespace regionmesh
