#include "regionmesh/read_tetrahedra.h"

#include "formats/input_file.h"
#include "formats/registry.h"
#include "volume/exact_grid.h"

namespace regionmesh {
namespace {

constexpr double kLeastScale = 0x1p-300;

/// A table is one even in a build that cannot read it, so that the error says so.
bool is_table_format(const formats::Format* format) { return format && format->is_table; }

}  // namespace

bool is_mesh(const std::filesystem::path& path) {
    const formats::Format* format = formats::find_format(path);
    return format && format->open_tetrahedra && !format->is_table;
}

bool holds_tetrahedra(const std::filesystem::path& path) {
    return is_mesh(path) || is_table_format(formats::find_format(path));
}

std::string tetrahedron_extensions() { return formats::extensions_with(&formats::Format::open_tetrahedra); }

std::unique_ptr<TetrahedronReader> open_tetrahedra(const std::filesystem::path& path, const TetrahedraOptions& given) {
    const formats::InputFile there(path);
    const bool is_auto = given.scale_z == kAutoScale;
    if (!is_auto && !(given.scale_z >= kLeastScale && given.scale_z <= 1 / kLeastScale))
        formats::fail(path, "--scale-z must be a number above 0, and within bounds; take one such as 100");
    TetrahedraOptions options = given;
    if (!is_auto) options.scale_z = nearest_power_of_two(given.scale_z);
    if (is_auto && is_mesh(path)) formats::fail(path, "--scale-z auto is for drill holes; give a number");
    const formats::Format* format = formats::find_format(path);
    if (is_table_format(format)) formats::require_readable(path, format);
    if (format && format->open_tetrahedra) return format->open_tetrahedra(path, options);
    formats::fail(path, "not a table of points or a mesh of tetrahedra; regionmesh reads " + tetrahedron_extensions());
}

}  // namespace regionmesh
