#include <cmath>
#include <system_error>
#include <utility>

#include "formats/registry.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/mesh_file.h"

namespace regionmesh {
namespace {

constexpr double kNear = 1e-5;  // samples; files of single precision move points by less

/// The sides of the box of samples that a point lies on, as bits.
unsigned sides_at(const Lattice& lattice, Vec3 point) {
    const Vec3 along = IntoAxes(lattice)(point);
    unsigned sides = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double index = along[axis] / lattice.spacing[axis];
        if (std::abs(index) < kNear) sides |= 1u << (2 * axis);
        if (std::abs(index - (lattice.size[axis] - 1.0)) < kNear) sides |= 2u << (2 * axis);
    }
    return sides;
}

}  // namespace

bool lacks_background(const MeshFile& file, const std::filesystem::path& path, InputLabel background) {
    std::error_code ignored;
    if (formats::extension(path) != ".stl" && !std::filesystem::is_directory(path, ignored)) return false;
    return file.background && file.background->empty() && !file.labels.find(background);
}

void restore_background(MeshFile& file, const Lattice& lattice, InputLabel background) {
    MeshArrays arrays = export_arrays(file.mesh, file.labels);
    for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
        unsigned sides = ~0u;
        for (const std::uint32_t v : arrays.faces[f]) sides &= sides_at(lattice, arrays.points[v]);
        for (InputLabel& label : arrays.labels[f])
            if (label == arrays.exterior_label && sides == 0) label = background;
    }
    arrays.node_types.clear();
    LabelledMesh restored = import_arrays(arrays);
    file.mesh = std::move(restored.mesh);
    file.labels = std::move(restored.labels);
    file.background = std::vector<InputLabel>{background};
}

}  // namespace regionmesh
