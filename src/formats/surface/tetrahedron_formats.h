// One opener per format; open_tetrahedra selects among them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "regionmesh/limits.h"
#include "regionmesh/read_layers.h"
#include "regionmesh/read_tetrahedra.h"

namespace regionmesh::formats {

inline bool has_repeated_corner(const std::array<std::uint32_t, 4>& c) {
    return c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3];
}

/// The Delaunay tetrahedra of a table of labelled points or drill holes. Defined in src/boreholes.
std::unique_ptr<TetrahedronReader> open_table(const std::filesystem::path& path, const TetrahedraOptions& options);

/// Drill holes as layers. Defined in src/boreholes.
std::unique_ptr<SectionReader> open_layer_sections(const std::filesystem::path& path, const TetrahedraOptions& table,
                                                   const LayerOptions& layers, LayerSummary* summary);

/// A VTK unstructured grid of tetrahedra; skips its faces, lines and vertices.
std::unique_ptr<TetrahedronReader> open_vtu(const std::filesystem::path& path, const TetrahedraOptions& options);

/// A Gmsh mesh, MSH 2.2 or 4.1, as text or binary; skips its faces, lines and points.
std::unique_ptr<TetrahedronReader> open_msh(const std::filesystem::path& path, const TetrahedraOptions& options);

}  // namespace regionmesh::formats
