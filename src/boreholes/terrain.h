// Heights of the ground from a raster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "formats/codec/byte_reader.h"

namespace regionmesh::formats {

/// An ESRI ASCII grid (.asc): a header of names and numbers (ncols, nrows, xllcorner or xllcenter, yllcorner or
/// yllcenter, cellsize, NODATA_value), then heights, rows from north to south. A height of NaN, and one that equals
/// NODATA_value, which may be NaN, is none.
class Terrain {
public:
    /// Throws Error(kInput) for a file that is no such grid, or that holds other than ncols * nrows numbers; before
    /// they take memory where they would take more than `most_bytes`.
    explicit Terrain(const std::filesystem::path& path, std::uint64_t most_bytes = UINT64_MAX);

    /// The height, interpolated between the four nearest centres of cells. In the outer half of the outermost cells it
    /// is that of the nearest place between centres. None beyond the cells, and next to a centre without a height.
    std::optional<double> at(double x, double y) const;

private:
    void read_heights(ByteReader& file, double none);

    std::size_t columns_ = 0, rows_ = 0;
    double x_ = 0, y_ = 0;  // centre of the first cell of the last row
    double cell_ = 0;
    std::vector<double> heights_;  // rows from north to south; NaN: none
};

}  // namespace regionmesh::formats
