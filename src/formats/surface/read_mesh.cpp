#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/input_file.h"
#include "formats/registry.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"
#include "formats/text/natural_order.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using formats::Format;

bool is_surface(const std::filesystem::path& path) {
    const Format* format = formats::find_format(path);
    return format && format->read_surface;
}

/// The surfaces in a folder, in natural order of their names. Each is a region, called what the file is.
FileSurface read_folder(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (is_surface(at->path()) && !at->path().filename().string().starts_with('.')) paths.push_back(at->path());
    if (error) formats::fail(folder, "cannot be read: " + error.message());
    if (paths.empty())
        formats::fail(folder, "holds no surfaces: a file for each region, one of " + readable_extensions());
    std::ranges::sort(paths, [](const auto& a, const auto& b) {
        return formats::natural_less(a.filename().string(), b.filename().string());
    });
    FileSurface all{.is_by_region = true, .has_shared_points = false};
    RegionGroups groups;
    for (const auto& path : paths) {
        FileSurface surface = formats::find_format(path)->read_surface(path);
        if (!surface.is_by_region)
            formats::fail(path,
                          "has labels on both sides of its faces, which a file for one region has not: name it alone");
        const std::uint32_t group = groups.add(formats::one_line(path.stem().string()), true);
        for (auto& labels : surface.labels) labels = {group, 0};
        surface.names.clear();
        append(all, surface);
        if (all.points.size() > kMostVertices || all.faces.size() > kMostFaces)
            formats::fail(folder, "has more points or faces than a model can hold");
    }
    groups.put_labels(all);
    return all;
}

FileSurface read_surface(const std::filesystem::path& path) {
    if (is_surface(path)) return formats::find_format(path)->read_surface(path);
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return read_folder(path);
    if (const Format* format = formats::find_format(path); format && format->holds_surface)
        formats::require_readable(path, format);
    formats::fail(path, fmt::format("no model format that can be read has the extension '{}': use one of {}",
                                    path.extension().string(), readable_extensions()));
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

// Whether all faces with the exterior lie in the planes of the box, and no more than four labels meet on an edge
// or corner of it, with those of sides. Else (the lattice was turned, or cells of a mesh had the labels) the exterior
// is taken as a whole: side 0, and no vertex is on a side; or kHull, where node types say what lies on it.
bool exterior_is_box(const FileSurface& surface, const Box& box) {
    std::vector<SideSet> sides(surface.points.size());
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        if (std::ranges::count(surface.labels[f], surface.exterior_label) == 0) continue;
        const auto side = side_of_face(surface, surface.faces[f], box);
        if (!side) return false;
        for (const std::uint32_t v : surface.faces[f]) sides[v] |= static_cast<SideSet>(1u << *side);
    }
    // Corners of the box are few.
    constexpr int kMostLabels = 4;
    std::map<std::uint32_t, std::set<InputLabel>> labels_of;
    for (std::uint32_t v = 0; v < sides.size(); ++v)
        if (std::popcount(sides[v]) > 1) labels_of[v];
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        for (const std::uint32_t v : surface.faces[f])
            if (std::popcount(sides[v]) > 1)
                for (const InputLabel label : surface.labels[f])
                    if (label != surface.exterior_label) labels_of[v].insert(label);
    return std::ranges::all_of(labels_of, [&](const auto& item) {
        return static_cast<int>(item.second.size()) + std::popcount(sides[item.first]) <= kMostLabels;
    });
}

MeshFile assemble(const FileSurface& surface) {
    MeshFile file{.mesh = {}, .labels = LabelTable(), .names = surface.names};
    Mesh& mesh = file.mesh;
    mesh.reserve(surface.points.size(), surface.faces.size());
    for (const Vec3& point : surface.points) mesh.add_vertex(point);
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
                labels[i] = exterior(surface.is_on_hull.empty() ? 0 : kHull);
                continue;
            }
            const int side = *side_of_face(surface, surface.faces[f], box);
            labels[i] = exterior(side);
            for (const std::uint32_t v : surface.faces[f]) mesh[VertexId{v}].sides |= static_cast<SideSet>(1u << side);
        }
        mesh.add_face(VertexId{a}, VertexId{b}, VertexId{c}, labels[0], labels[1]);
    }
    // Where no face tells on which side of the box a vertex is, it may be on an open one, or a hull of another shape.
    for (std::uint32_t v = 0; v < surface.is_on_hull.size(); ++v)
        if (surface.is_on_hull[v] && mesh[VertexId{v}].sides == 0) mesh[VertexId{v}].sides = kOnHull;
    return file;
}

}  // namespace

std::string readable_extensions() { return formats::extensions_with(&Format::read_surface); }

MeshFile read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
    FileSurface surface = read_surface(path);
    if (options.weld || !surface.has_shared_points) {
        surface.is_on_hull.clear();  // points get other numbers
        weld_points(surface, options.weld.value_or(0));
    }
    if (options.weld || surface.is_by_region) join_back_to_back(surface);
    if (options.orient) orient_faces(surface);
    return assemble(surface);
}

}  // namespace regionmesh
