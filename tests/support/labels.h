// Tables of labels.
#pragma once

#include <initializer_list>

#include "regionmesh/label_table.h"

namespace regionmesh::test {

/// The labels get the dense numbers 0, 1, 2 ... in this order.
inline LabelTable labels_from(std::initializer_list<InputLabel> labels, bool is_unsigned = false) {
    LabelTable table(is_unsigned);
    for (const InputLabel label : labels) table.dense(label);
    return table;
}

}  // namespace regionmesh::test
