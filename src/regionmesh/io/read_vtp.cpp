#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "regionmesh/io/model_formats.h"
#include "regionmesh/io/vtk_xml_file.h"

namespace regionmesh {
namespace {

pugi::xml_node array_named(pugi::xml_node parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

// Reads components in groups of N, which may be spread over two spans.
template <std::size_t N, class T, class Visit>
ArraySink<T> by_groups(Visit visit) {
    return [visit, group = std::array<T, N>{}, filled = std::size_t{0}](std::span<const T> values) mutable {
        for (const T value : values) {
            group[filled++] = value;
            if (filled < N) continue;
            filled = 0;
            visit(group);
        }
    };
}

pugi::xml_node the_piece(const VtkXmlFile& file) {
    const pugi::xml_node piece = file.dataset().child("Piece");
    if (!piece) file.fail("has no Piece");
    if (piece.next_sibling("Piece")) file.fail("has more than one Piece: write it as one");
    for (const char* other : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"})
        if (file.number(piece, other, 0) != 0) file.fail(fmt::format("{} is not 0: only triangles can be read", other));
    return piece;
}

void read_points(const VtkXmlFile& file, pugi::xml_node piece, std::uint64_t count, FileSurface& surface) {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (count == 0) return;
    if (!array || file.number(array, "NumberOfComponents", 1) != 3)
        file.fail("needs an array of points with three components");
    file.read_reals(
        array, 3 * count, by_groups<3, double>([&](const std::array<double, 3>& p) {
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
                file.fail(fmt::format("point {} has a coordinate that is not finite", surface.points.size()));
            surface.points.push_back({p[0], p[1], p[2]});
        }));
}

void check_offsets(const VtkXmlFile& file, pugi::xml_node polys, std::uint64_t count) {
    const pugi::xml_node array = array_named(polys, "offsets");
    if (!array) file.fail("needs the array 'offsets' in Polys");
    std::int64_t before = 0;
    std::uint64_t cell = 0;
    file.read_integers(
        array, count, by_groups<1, std::int64_t>([&](const std::array<std::int64_t, 1>& offset) {
            if (offset[0] < before || offset[0] - before != 3)
                file.fail(fmt::format("cell {} is no triangle: its offset is {} after {}", cell, offset[0], before));
            before = offset[0];
            ++cell;
        }));
}

void read_faces(const VtkXmlFile& file, pugi::xml_node piece, std::uint64_t count, FileSurface& surface) {
    const pugi::xml_node polys = piece.child("Polys");
    check_offsets(file, polys, count);
    const pugi::xml_node array = array_named(polys, "connectivity");
    if (!array) file.fail("needs the array 'connectivity' in Polys");
    file.read_integers(array, 3 * count, by_groups<3, std::int64_t>([&](const std::array<std::int64_t, 3>& corners) {
                           std::array<std::uint32_t, 3> face;
                           for (int i = 0; i < 3; ++i) {
                               if (corners[i] < 0 || static_cast<std::uint64_t>(corners[i]) >= surface.points.size())
                                   file.fail(fmt::format("cell {} names point {} of {}", surface.faces.size(),
                                                         corners[i], surface.points.size()));
                               face[i] = static_cast<std::uint32_t>(corners[i]);
                           }
                           surface.faces.push_back(face);
                       }));
}

void read_labels(const VtkXmlFile& file, pugi::xml_node piece, std::uint64_t count, FileSurface& surface) {
    const pugi::xml_node array = array_named(piece.child("CellData"), "BoundaryLabels");
    if (!array) file.fail("needs the cell array 'BoundaryLabels': two integers a face, the labels on its two sides");
    const std::uint64_t components = file.number(array, "NumberOfComponents", 1);
    if (components != 2)
        file.fail(fmt::format("its cell array 'BoundaryLabels' has {} components: 2 are needed", components));
    file.read_integers(array, 2 * count, by_groups<2, std::int64_t>([&](const std::array<InputLabel, 2>& labels) {
                           surface.labels.push_back(labels);
                       }));
    const pugi::xml_node exterior = array_named(file.dataset().child("FieldData"), "ExteriorLabel");
    if (exterior)
        file.read_integers(exterior, 1, [&](std::span<const std::int64_t> values) {
            if (!values.empty()) surface.exterior_label = values[0];
        });
}

// Labels and names side by side; names of other programs' making, in other numbers, are left.
void read_names(const VtkXmlFile& file, FileSurface& surface) {
    const pugi::xml_node fields = file.dataset().child("FieldData"), labels = array_named(fields, "RegionLabels"),
                         names = array_named(fields, "RegionNames");
    if (!labels || !names) return;
    const std::vector<std::string> texts = file.read_strings(names);
    if (file.number(labels, "NumberOfTuples", 0) != texts.size()) return;
    std::size_t n = 0;
    file.read_integers(labels, texts.size(), [&](std::span<const std::int64_t> values) {
        for (const std::int64_t label : values)
            if (const std::string& name = texts[n++]; !name.empty()) surface.names[label] = name;
    });
}

}  // namespace

FileSurface read_vtp(const std::filesystem::path& path) {
    const VtkXmlFile file(path, "PolyData");
    const pugi::xml_node piece = the_piece(file);
    const std::uint64_t points = file.number(piece, "NumberOfPoints", 0),
                        faces = file.number(piece, "NumberOfPolys", 0);
    if (points > kMostVertices || faces > kMostFaces)
        file.fail(fmt::format("{} points and {} faces are more than a model can hold", points, faces));
    FileSurface surface;
    read_names(file, surface);
    read_points(file, piece, points, surface);
    if (faces > 0) {
        read_faces(file, piece, faces, surface);
        read_labels(file, piece, faces, surface);
    }
    return surface;
}

}  // namespace regionmesh
