// All ways to cut a sheet of a cell into triangles without further vertices.
#pragma once

#include <functional>
#include <vector>

#include "cells/table/cell_sheets.h"

namespace regionmesh::cell_table {

using Cut = std::vector<Triangle>;

/// Edges that a cut may add between two vertices of a boundary.
using IsChord = std::function<bool(NodeSet, NodeSet)>;

/// The cuts whose triangles are apart from each other at any position, best worst quality first. The boundary is one
/// loop, or two, round an annulus.
std::vector<Cut> cuts_of(const std::vector<Loop>& boundary, const IsChord& is_chord, AnyPosition& positions);

/// The worst quality of a triangle at the centroids, with unit spacing.
double quality_of(const Cut& cut);

}  // namespace regionmesh::cell_table
