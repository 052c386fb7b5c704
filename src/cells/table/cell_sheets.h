// The surface in a cell as six tetrahedra make it, and its sheets: the starting point of compact cells.
#pragma once

#include <vector>

#include "cells/table/any_position.h"

namespace regionmesh::cell_table {

/// A face between the labels of two nodes; its normal points from the first to the second. The first has the lower
/// number in the partition.
struct CellFace {
    Triangle vertices;
    std::uint8_t first, second;

    friend bool operator==(const CellFace&, const CellFace&) = default;
};

/// The faces that the tetrahedra make: marching_tetrahedra.h.
std::vector<CellFace> tetrahedra_faces(const Partition& labels);

using Loop = std::vector<NodeSet>;

/// Faces between two labels that are joined by edges.
struct Sheet {
    std::uint8_t first, second;
    std::vector<Loop> boundary;  // loops in the sense of the faces
    int euler;                   // vertices - edges + faces
    bool has_main_diagonal;      // the main diagonal has one of its inner vertices
};

std::vector<Sheet> sheets_of(const std::vector<CellFace>& faces);

}  // namespace regionmesh::cell_table
