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

void keep_steps(const ReadOptions& options, Vec3 steps, Lattice& lattice) {
    if (!options.spacing) return;
    for (int axis = 0; axis < 3; ++axis) {
        const double change = steps[axis] * ((*options.spacing)[axis] - lattice.spacing[axis]);
        for (int row = 0; row < 3; ++row) lattice.origin[row] += change * lattice.direction[3 * row + axis];
    }
}

}  // namespace regionmesh::formats
