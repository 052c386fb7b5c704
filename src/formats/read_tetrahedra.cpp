#include "regionmesh/read_tetrahedra.h"

#include "formats/file_type.h"
#include "formats/input_file.h"
#include "formats/surface/tetrahedron_formats.h"
#include "volume/exact_grid.h"

namespace regionmesh {
namespace {

constexpr double kLeastScale = 0x1p-300;

}  // namespace

bool is_mesh(const std::filesystem::path& path) {
    const std::string name = formats::extension(path);
    return name == ".vtu" || name == ".msh";
}

bool holds_tetrahedra(const std::filesystem::path& path) {
    const std::string name = formats::extension(path);
    return name == ".csv" || name == ".tsv" || is_mesh(path);
}

std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path, const TetrahedraOptions& given) {
    const formats::InputFile there(path);
    if (!(given.scale_z >= kLeastScale && given.scale_z <= 1 / kLeastScale))
        formats::fail(path, "--scale-z must be a number above 0, and within bounds; take one such as 100");
    TetrahedraOptions options = given;
    options.scale_z = nearest_power_of_two(given.scale_z);
    const std::string name = formats::extension(path);
    if (name == ".vtu") return formats::open_vtu(path, options);
    if (name == ".msh") return formats::open_msh(path, options);
    if (name == ".csv" || name == ".tsv") return formats::open_table(path, options);
    formats::fail(path, "not a table of points (.csv .tsv) or a mesh of tetrahedra (.vtu .msh)");
}

}  // namespace regionmesh
