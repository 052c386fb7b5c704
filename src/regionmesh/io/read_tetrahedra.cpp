#include "regionmesh/io/read_tetrahedra.h"

#include "regionmesh/io/file_type.h"
#include "regionmesh/io/input_file.h"
#include "regionmesh/io/tetrahedra/read_formats.h"
#include "regionmesh/volume/exact_grid.h"

namespace regionmesh {
namespace {

constexpr double kLeastScale = 0x1p-300;

}  // namespace

bool is_mesh(const std::filesystem::path& path) {
    const std::string name = io::extension(path);
    return name == ".vtu" || name == ".msh";
}

bool holds_tetrahedra(const std::filesystem::path& path) {
    const std::string name = io::extension(path);
    return name == ".csv" || name == ".tsv" || is_mesh(path);
}

std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path, const TetrahedraOptions& given) {
    const io::InputFile there(path);
    if (!(given.scale_z >= kLeastScale && given.scale_z <= 1 / kLeastScale))
        io::fail(path, "--scale-z must be a number above 0, and within bounds; take one such as 100");
    TetrahedraOptions options = given;
    options.scale_z = nearest_power_of_two(given.scale_z);
    const std::string name = io::extension(path);
    if (name == ".vtu") return io::open_vtu(path, options);
    if (name == ".msh") return io::open_msh(path, options);
    if (name == ".csv" || name == ".tsv") {
        io::PointTable table = io::read_point_table(path, options);
        move_to_exact_grid(table.points.positions);
        return io::open_points(std::move(table), options);
    }
    io::fail(path, "not a table of points (.csv .tsv) or a mesh of tetrahedra (.vtu .msh)");
}

}  // namespace regionmesh
