#include "regionmesh/label_table.h"

#include <algorithm>
#include <limits>

namespace regionmesh {

void LabelTable::dense(std::span<const InputLabel> labels, std::span<Label> result) {
    Label last = 0;
    for (std::size_t n = 0; n < labels.size(); ++n) {
        if (n == 0 || labels[n] != labels[n - 1]) last = dense(labels[n]);
        result[n] = last;
    }
}

bool LabelTable::has_large() const {
    return is_unsigned_ && std::any_of(labels_.begin(), labels_.end(), [](InputLabel label) { return label < 0; });
}

InputLabel LabelTable::exterior_label() const {
    const InputLabel smallest = labels_.empty() ? 0 : *std::min_element(labels_.begin(), labels_.end());
    if (smallest >= 0) return -1;
    if (smallest > std::numeric_limits<InputLabel>::min()) return smallest - 1;
    InputLabel unused = -1;
    while (dense_.contains(unused)) --unused;
    return unused;
}

}  // namespace regionmesh
