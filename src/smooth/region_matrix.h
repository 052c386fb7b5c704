// A sparse symmetric matrix over pairs of regions, and a solver.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace regionmesh {

/// Sparse, symmetric, positive semidefinite.
class RegionMatrix {
public:
    explicit RegionMatrix(std::uint32_t size) : diagonal_(size) {}

    /// Adds to the entries (row, column) and (column, row), or to (row, row).
    void add(std::uint32_t row, std::uint32_t column, double value);

    /// x with matrix * x = b, by conjugate gradients scaled by the diagonal. Rows whose diagonal is 0 are left out.
    /// Returns one of the solutions where the matrix is singular and b lies in its range.
    std::vector<double> solve(const std::vector<double>& b) const;

private:
    struct Entry {
        std::uint32_t row, column;
        double value;
    };
    std::vector<double> product(const std::vector<double>& x) const;

    std::vector<double> diagonal_;
    std::vector<Entry> entries_;  // row < column
    std::unordered_map<std::uint64_t, std::uint32_t> places_;
};

}  // namespace regionmesh
