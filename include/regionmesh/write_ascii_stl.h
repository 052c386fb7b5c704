// STL as text: what write_mesh() writes in binary.
#pragma once

#include <filesystem>

#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"

namespace regionmesh {

/// Writes `path` as text: doubles, and a closed solid with a name for each region. write_mesh() writes .stl in binary
/// and single precision, with labels as attributes of faces. The file is one of `files`, which the caller commits.
/// Throws Error(kOutput) as write_mesh() does.
void write_ascii_stl(const Mesh& mesh, const LabelTable& labels, const std::filesystem::path& path,
                     const WriteOptions& options, OutputFiles& files);

}  // namespace regionmesh
