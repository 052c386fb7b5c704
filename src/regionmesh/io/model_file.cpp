#include "regionmesh/io/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "regionmesh/base/error.h"
#include "regionmesh/io/model_formats.h"

namespace regionmesh {
namespace {

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return extension;
}

[[noreturn]] void refuse_extension(const std::filesystem::path& path) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: no model format that can be read has the extension '{}': use .vtp or .ply",
                            path.string(), path.extension().string()));
}

Box bounding_box(const FileSurface& surface) {
    Box box;
    for (const auto& face : surface.faces)
        for (const std::uint32_t v : face) box.add(surface.points[v]);
    return box;
}

// The side of the box in whose plane the face lies, exactly.
std::optional<int> side_of_face(const FileSurface& surface, const std::array<std::uint32_t, 3>& face, const Box& box) {
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double plane = (side % 2 == 0 ? box.low : box.high)[axis];
        if (std::ranges::all_of(face, [&](std::uint32_t v) { return surface.points[v][axis] == plane; })) return side;
    }
    return std::nullopt;
}

// Whether all faces with the exterior lie in the planes of the box. Where one does not (the lattice was turned), the
// exterior is taken as a whole: side 0, and no vertex is on a side.
bool exterior_is_box(const FileSurface& surface, const Box& box) {
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        if (std::ranges::count(surface.labels[f], surface.exterior_label) > 0 &&
            !side_of_face(surface, surface.faces[f], box))
            return false;
    return true;
}

ModelFile assemble(const FileSurface& surface) {
    ModelFile file;
    file.names = surface.names;
    Model& model = file.model;
    model.reserve(surface.points.size(), surface.faces.size());
    for (const Vec3& point : surface.points) model.add_vertex(point);
    const Box box = bounding_box(surface);
    const bool has_sides = exterior_is_box(surface, box);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const auto& [a, b, c] = surface.faces[f];
        std::array<Label, 2> labels;
        for (int i = 0; i < 2; ++i) {
            const InputLabel label = surface.labels[f][i];
            if (label != surface.exterior_label) {
                labels[i] = file.labels.dense(label);
                continue;
            }
            if (!has_sides) {
                labels[i] = exterior(0);
                continue;
            }
            const int side = *side_of_face(surface, surface.faces[f], box);
            labels[i] = exterior(side);
            for (const std::uint32_t v : surface.faces[f]) model[VertexId{v}].sides |= static_cast<SideSet>(1u << side);
        }
        model.add_face(VertexId{a}, VertexId{b}, VertexId{c}, labels[0], labels[1]);
    }
    return file;
}

}  // namespace

ModelFile read_model(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (extension == ".vtp") return assemble(read_vtp(path));
    if (extension == ".ply") return assemble(read_ply(path));
    refuse_extension(path);
}

}  // namespace regionmesh
