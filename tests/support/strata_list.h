// All strata of a model, in words that decimation may not change.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <vector>

#include "regionmesh/mesh.h"

namespace regionmesh::test {

/// What is left of an interface or line without the lower strata at its rim; or the points with one label set.
struct Stratum {
    std::uint32_t components = 0;
    std::int64_t euler = 0;
    friend bool operator==(const Stratum&, const Stratum&) = default;
};
std::ostream& operator<<(std::ostream& out, const Stratum& stratum);

/// By sorted label set: two labels an interface, three a line, four a point.
using StrataList = std::map<std::vector<Label>, Stratum>;
StrataList list_strata(const Mesh& mesh);

/// Fails with one line for each stratum that differs.
void expect_same_strata(const StrataList& found, const StrataList& expected);

/// Fails unless every vertex has two, three or four labels, and as many lines end there as labels make: none
/// inside an interface, two on a line, four at a point, three at a corner of the box. Requires a capped box.
void expect_generic(const Mesh& mesh);

}  // namespace regionmesh::test
