#include "regionmesh/label_table.h"

#include <algorithm>
#include <limits>

namespace regionmesh {

InputLabel LabelTable::exterior_label() const {
    const InputLabel smallest = labels_.empty() ? 0 : *std::min_element(labels_.begin(), labels_.end());
    if (smallest >= 0) return -1;
    if (smallest > std::numeric_limits<InputLabel>::min()) return smallest - 1;
    InputLabel unused = -1;
    while (dense_.contains(unused)) --unused;
    return unused;
}

}  // namespace regionmesh
