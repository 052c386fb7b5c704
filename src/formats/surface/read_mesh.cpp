#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/option_range.h"
#include "formats/input_file.h"
#include "formats/registry.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"
#include "formats/text/natural_order.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/write_report.h"
#include "surface/assemble.h"

namespace regionmesh {
namespace {

using formats::Format;

bool is_surface(const std::filesystem::path& path) {
    const Format* format = formats::find_format(path);
    return format && format->read_surface;
}

/// Half a turn about z leads from RAS to LPS and back.
void turn(FileSurface& surface, Space space) {
    Space& own = surface.coordinates.space;
    if (space == Space::kUnknown || space == own) return;
    if (own != Space::kUnknown)
        for (Vec3& point : surface.points) point = {-point.x, -point.y, point.z};
    own = space;
}

/// Adds what a further file of a folder says to what those before it say: one unit, and a spacing if all have the same.
void join_coordinates(const Coordinates& own, const std::filesystem::path& path, bool is_first, Coordinates& all) {
    if (own.metres && all.metres && *own.metres != *all.metres)
        formats::fail(path, fmt::format("is in {}, and other files of the folder are in {}; convert it, or take it out",
                                        length_symbol(*own.metres), length_symbol(*all.metres)));
    all.space = own.space;
    if (own.metres) all.metres = own.metres;
    if (is_first) all.spacing = own.spacing;
    if (own.spacing != all.spacing) all.spacing.reset();
}

/// The surfaces in a folder, in natural order of their names. Each is a region, called what the file is. Files in
/// another space than the first that names one are turned into it.
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
    FileSurface all{.background = std::vector<InputLabel>{}, .is_by_region = true, .has_shared_points = false};
    RegionGroups groups;
    for (const auto& path : paths) {
        FileSurface surface = formats::find_format(path)->read_surface(path);
        if (!surface.is_by_region)
            formats::fail(path,
                          "has labels on both sides of its faces, which a file for one region has not: name it alone");
        const std::uint32_t group = groups.add(formats::one_line(path.stem().string()), true);
        for (auto& labels : surface.labels) labels = {group, 0};
        surface.names.clear();
        surface.colours.clear();
        turn(surface, all.coordinates.space);
        join_coordinates(surface.coordinates, path, path == paths.front(), all.coordinates);
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
    if (!path.has_extension() && !std::filesystem::exists(path, error))
        formats::fail(path,
                      fmt::format("no such file or folder: use one of {}, or a folder of them", readable_extensions()));
    formats::fail(path, fmt::format("no model format that can be read has the extension '{}': use one of {}",
                                    path.extension().string(), readable_extensions()));
}

MeshFile assemble(FileSurface&& surface) {
    MeshArrays arrays{.points = std::move(surface.points),
                      .faces = std::move(surface.faces),
                      .labels = std::move(surface.labels),
                      .exterior_label = surface.exterior_label,
                      .is_unsigned = surface.is_unsigned};
    for (const bool is_on_hull : surface.is_on_hull) arrays.node_types.push_back(is_on_hull ? kFirstHullType : 0);
    auto [mesh, labels] = regionmesh::assemble(arrays);
    return {.mesh = std::move(mesh),
            .labels = std::move(labels),
            .names = std::move(surface.names),
            .colours = std::move(surface.colours),
            .coordinates = surface.coordinates,
            .background = std::move(surface.background)};
}

}  // namespace

std::string readable_extensions() { return formats::extensions_with(&Format::read_surface); }

MeshFile read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
    if (options.weld) require_number("weld", *options.weld, kNotNegative);
    FileSurface surface = read_surface(path);
    Box box;
    for (const Vec3 p : surface.points) box.add(p);
    if (!surface.faces.empty()) require_extent(path.string(), box);
    turn(surface, options.space);
    if (options.weld || !surface.has_shared_points) {
        surface.is_on_hull.clear();  // points get other numbers
        weld_points(surface, options.weld.value_or(0));
    }
    if (options.weld || surface.is_by_region) join_back_to_back(surface);
    if (options.orient) orient_faces(surface);
    return assemble(std::move(surface));
}

}  // namespace regionmesh
