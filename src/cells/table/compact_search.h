// Finds the faces of compact cells (docs/explanation/compact-cells.md), which src/cells/compact_table.inc lists.
#pragma once

#include <string>
#include <vector>

#include "cells/table/cell_sheets.h"

namespace regionmesh::cell_table {

/// The fewest faces found with the sheets and lines of the tetrahedra, no vertex on a diagonal that drops_diagonal(),
/// and no two faces that meet at any position of their vertices (AnyPosition) but in what they share; among those the
/// ones with the best worst quality.
std::vector<CellFace> compact_faces(const Partition& labels, AnyPosition& positions);

/// The text of the table: the faces of the first partition, in lexicographic order, of each class under the symmetries.
std::string compact_table();

}  // namespace regionmesh::cell_table
