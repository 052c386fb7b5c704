// Opens what gives labelled tetrahedra: tables of labelled points, and meshes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

/// How to read points or a mesh; all optional.
struct TetrahedraOptions {
    std::string columns = {};             // which columns of a table are what (docs/files.md)
    std::optional<double> step = {};      // drill holes: distance of the points that stand for an interval, at most
    double scale_z = 1;                   // z is multiplied by the power of two nearest to this: nothing is lost
    std::string array = {};               // name of the array of labels in a mesh
    std::filesystem::path delaunay = {};  // the program regionmesh-delaunay, if it is not where it is looked for
};

/// Whether the extension is that of points or of a mesh: `.csv .tsv .vtu .msh`.
bool holds_tetrahedra(const std::filesystem::path& path);

/// Whether it is that of a mesh, among these.
bool is_mesh(const std::filesystem::path& path);

/// Opens a table of labelled points (`.csv .tsv`), whose tetrahedra regionmesh-delaunay makes in a process of its own,
/// or a mesh of labelled tetrahedra (`.vtu .msh`). Throws Error(kInput) naming file, row or place, and what to do.
std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path,
                                                   const TetrahedraOptions& options = {});

}  // namespace regionmesh
