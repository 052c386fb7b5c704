#include "regionmesh/io/read_tetrahedra.h"

#include "regionmesh/io/file_type.h"
#include "regionmesh/io/input_file.h"
#include "regionmesh/io/tetrahedra/read_formats.h"

namespace regionmesh {

bool holds_tetrahedra(const std::filesystem::path& path) {
    const std::string name = io::extension(path);
    return name == ".csv" || name == ".tsv" || name == ".vtu" || name == ".msh";
}

std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path,
                                                   const TetrahedraOptions& options) {
    const io::InputFile there(path);
    const std::string name = io::extension(path);
    if (name == ".vtu") return io::open_vtu(path, options);
    if (name == ".msh") return io::open_msh(path, options);
    if (name == ".csv" || name == ".tsv") return io::open_points(io::read_point_table(path, options), options);
    io::fail(path, "not a table of points (.csv .tsv) or a mesh of tetrahedra (.vtu .msh)");
}

}  // namespace regionmesh
