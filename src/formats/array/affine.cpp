#include "formats/array/affine.h"

#include <cmath>
#include <string>

#include "formats/input_file.h"

namespace regionmesh::formats {

void set_affine(const std::filesystem::path& path, const char* what, const char* remedy, const Columns& columns,
                Vec3 origin, Lattice& lattice) {
    lattice.origin = origin;
    Columns units;
    for (int axis = 0; axis < 3; ++axis) {
        lattice.spacing[axis] = length(columns[axis]);
        units[axis] = columns[axis] / lattice.spacing[axis];
        for (int row = 0; row < 3; ++row) lattice.direction[3 * row + axis] = units[axis][row];
    }
    // NaN fails the first comparison, too.
    if (!(std::abs(dot(units[0], cross(units[1], units[2]))) > 1e-6) ||
        !std::isfinite(length2(lattice.spacing) + length2(origin))) {
        fail(path, std::string("the ") + what + " is no affine map (its columns lie in a plane, or are not finite); " +
                       remedy);
    }
}

Vec3 first_sample(const Columns& columns, Vec3 from, Vec3 steps, const ReadOptions& options) {
    for (int axis = 0; axis < 3; ++axis) {
        const double scale = options.spacing ? (*options.spacing)[axis] / length(columns[axis]) : 1;
        from += steps[axis] * scale * columns[axis];
    }
    return from;
}

}  // namespace regionmesh::formats
