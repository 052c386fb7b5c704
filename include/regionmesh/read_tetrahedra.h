// Opens sources of labelled tetrahedra: tables of labelled points, and meshes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

/// How to read points or a mesh; all optional.
struct TetrahedraOptions {
    std::string columns = {};             // the meaning of the columns of a table (docs/reference/files.md)
    std::optional<double> step = {};      // drill holes: largest distance of two points of an interval
    std::filesystem::path collars = {};   // table of the places of holes; then the table of intervals has none
    std::filesystem::path surveys = {};   // table of the directions of holes; none: vertical
    double scale_z = 1;                   // z is multiplied by the nearest power of two, which is exact; kAutoScale
    std::string array = {};               // name of the array of labels in a mesh
    std::filesystem::path delaunay = {};  // the program regionmesh-delaunay, if it is not in one of the usual places
};

/// Whether the extension is that of a table or a mesh: `.csv .tsv .vtu .msh`.
bool holds_tetrahedra(const std::filesystem::path& path);

/// Whether the extension is that of a mesh of tetrahedra.
bool is_mesh(const std::filesystem::path& path);

/// ".csv .tsv .vtu .msh": the extensions that this build reads.
std::string tetrahedron_extensions();

/// Opens a table of labelled points, whose tetrahedra the program regionmesh-delaunay makes, or a mesh of labelled
/// tetrahedra. Throws Error(kInput) that names file, row or place, and what to do.
std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path,
                                                   const TetrahedraOptions& options = {});

}  // namespace regionmesh
