#pragma once

namespace regionmesh::test {

/// A number as single precision has it. GCC 12 leaves out conversions there and back that it vectorises (-O2).
inline double in_single(double number) {
    const volatile float single = static_cast<float>(number);
    return static_cast<double>(single);
}

}  // namespace regionmesh::test
