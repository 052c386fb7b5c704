#include "regionmesh/label_oracle.h"

namespace regionmesh {

LabelOracle relabelled(const LabelOracle& oracle, const LabelTable& labels, LabelTable& other) {
    LabelOracle result = oracle;
    result.euler.clear();
    for (Label label = 0; label < oracle.euler.size(); ++label) {
        const Label in_other = other.dense(labels.input(label));
        if (in_other >= result.euler.size()) result.euler.resize(in_other + 1, 0);
        result.euler[in_other] = oracle.euler[label];
    }
    return result;
}

}  // namespace regionmesh
