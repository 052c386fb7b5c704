// Surfaces in VTK XML files: polygons in PolyData, or triangles, quads and polygons in an UnstructuredGrid.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/label_array.h"
#include "formats/vtk/vtk_numbers.h"

namespace regionmesh {
namespace {

using namespace formats;

/// Names of the array of two labels per face, the first one behind the face: ours and VTK's, PyVista's, DREAM.3D's.
constexpr const char* kLabelArrays[] = {"BoundaryLabels", "boundary_labels", "FaceLabels"};

/// VTK's numbers of cells that are polygons.
constexpr std::int64_t kTriangle = 5, kPolygon = 7, kQuad = 9;

constexpr std::uint64_t kMostBackgroundLabels = 1 << 20, kMostColours = 1 << 24;
constexpr std::int64_t kMostCorners = 1 << 20;

/// Reads the pieces of a file one after the other into one surface.
class VtkSurfaceReader {
public:
    VtkSurfaceReader(const std::filesystem::path& path, const char* type) : xml_(path, type) {}
    FileSurface read(bool is_grid);

private:
    void read_names(pugi::xml_node fields);
    void read_colours(pugi::xml_node fields);
    void read_background(pugi::xml_node fields);
    void read_space(pugi::xml_node fields);
    void read_lengths();
    void refuse_other_cells(pugi::xml_node piece) const;
    void read_node_types(pugi::xml_node piece, std::uint64_t count);
    void read_types(pugi::xml_node cells, std::uint64_t count) const;
    void read_faces(pugi::xml_node piece, pugi::xml_node cells, std::uint64_t count);
    pugi::xml_node label_array(pugi::xml_node piece) const;

    VtkXml xml_;
    FileSurface surface_;
    std::uint64_t first_point_ = 0;  // of the current piece
};

std::vector<std::string> read_strings(const VtkXml& xml, pugi::xml_node array) {
    std::vector<std::string> strings;
    VtkNumbers codes(xml, array, std::nullopt);
    for (std::string open; !codes.at_end();) {
        if (const std::int64_t code = codes.integer(); code != 0)
            open += static_cast<char>(code);
        else
            strings.push_back(std::exchange(open, {}));
    }
    codes.finish();
    return strings;
}

/// Two arrays of equal length, labels and their names; other arrays with these names are ignored.
void VtkSurfaceReader::read_names(pugi::xml_node fields) {
    const pugi::xml_node labels = array_named(fields, "RegionLabels"),
                         names = fields.find_child_by_attribute("Array", "Name", "RegionNames");
    if (!labels || !names || std::string_view(names.attribute("type").value()) != "String") return;
    const std::vector<std::string> texts = read_strings(xml_, names);
    if (xml_.count(labels, "NumberOfTuples", UINT64_MAX) != texts.size()) return;
    VtkNumbers numbers = integers_of(xml_, labels, texts.size());
    for (const std::string& text : texts) {
        const std::int64_t label = numbers.integer();
        if (const std::string name = one_line(text); !name.empty()) surface_.names[label] = name;
    }
    numbers.finish();
}

/// Two arrays of equal length, labels and their red, green and blue; other arrays with these names are ignored.
void VtkSurfaceReader::read_colours(pugi::xml_node fields) {
    const pugi::xml_node labels = array_named(fields, "ColourLabels"), array = array_named(fields, "RegionColours");
    if (!labels || !array || components(labels) != 1 || components(array) != 3) return;
    const std::uint64_t count = xml_.count(labels, "NumberOfTuples", kMostColours);
    if (count == 0 || xml_.count(array, "NumberOfTuples", UINT64_MAX) != count) return;
    VtkNumbers numbers = integers_of(xml_, labels, count), parts = integers_of(xml_, array, 3 * count);
    for (std::uint64_t n = 0; n < count; ++n) {
        std::uint32_t colour = 0;
        for (int part = 0; part < 3; ++part)
            colour = colour << 8 | (static_cast<std::uint32_t>(parts.integer()) & 0xFF);
        surface_.colours[numbers.integer()] = colour;
    }
    numbers.finish();
    parts.finish();
}

void VtkSurfaceReader::read_background(pugi::xml_node fields) {
    const pugi::xml_node array = array_named(fields, "BackgroundLabels");
    if (!array) return;
    surface_.background.emplace();
    const std::uint64_t count = xml_.count(array, "NumberOfTuples", kMostBackgroundLabels);
    if (count == 0) return;
    VtkNumbers numbers = integers_of(xml_, array, count);
    for (std::uint64_t n = 0; n < count; ++n) surface_.background->push_back(numbers.integer());
    numbers.finish();
}

/// As 3D Slicer writes it; other arrays of this name are ignored.
void VtkSurfaceReader::read_space(pugi::xml_node fields) {
    const pugi::xml_node array = fields.find_child_by_attribute("Array", "Name", "SPACE");
    if (!array || std::string_view(array.attribute("type").value()) != "String") return;
    if (const auto texts = read_strings(xml_, array); texts.size() == 1)
        regionmesh::read_space(surface_, "SPACE=" + texts[0]);
}

void VtkSurfaceReader::read_lengths() {
    surface_.coordinates.metres = metres_per_unit(xml_);
    if (const auto spacing = tuple_of(xml_, "SampleSpacing", 3); !spacing.empty())
        set_spacing(surface_, {spacing[0], spacing[1], spacing[2]});
}

FileSurface VtkSurfaceReader::read(bool is_grid) {
    const pugi::xml_node fields = xml_.dataset().child("FieldData"), exterior = array_named(fields, "ExteriorLabel");
    read_names(fields);
    read_colours(fields);
    read_background(fields);
    read_space(fields);
    read_lengths();
    if (exterior) {
        VtkNumbers number = integers_of(xml_, exterior, 1);
        surface_.exterior_label = number.integer();
        number.finish();
    }
    if (!xml_.dataset().child("Piece")) xml_.fail("has no Piece");
    for (const pugi::xml_node piece : xml_.dataset().children("Piece")) {
        if (!is_grid) refuse_other_cells(piece);
        first_point_ = surface_.points.size();
        const std::uint64_t points = xml_.count(piece, "NumberOfPoints", kMostVertices - first_point_),
                            cells = xml_.count(piece, is_grid ? "NumberOfCells" : "NumberOfPolys",
                                               kMostFaces - surface_.faces.size());
        if (points > 0) {
            VtkNumbers numbers = points_of(xml_, piece, points);
            for (std::uint64_t n = 0; n < points; ++n) add_point(surface_, numbers.point(), xml_.path());
            numbers.finish();
        }
        read_node_types(piece, points);
        if (cells == 0) continue;
        const pugi::xml_node node = piece.child(is_grid ? "Cells" : "Polys");
        if (is_grid) read_types(node, cells);
        read_faces(piece, node, cells);
    }
    if (surface_.is_by_region && !surface_.background) surface_.background.emplace();
    return std::move(surface_);
}

void VtkSurfaceReader::refuse_other_cells(pugi::xml_node piece) const {
    for (const char* other : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"})
        if (xml_.count(piece, other, UINT64_MAX) != 0)
            xml_.fail(
                fmt::format("{} is not 0: only polygons can be read; vtkTriangleFilter makes them of strips", other));
}

void VtkSurfaceReader::read_node_types(pugi::xml_node piece, std::uint64_t count) {
    const pugi::xml_node array = array_named(piece.child("PointData"), "NodeType");
    if (!array || count == 0 || components(array) != 1) return;
    surface_.is_on_hull.resize(first_point_);
    VtkNumbers types = integers_of(xml_, array, count);
    for (std::uint64_t n = 0; n < count; ++n) surface_.is_on_hull.push_back(types.integer() >= kFirstHullType);
    types.finish();
}

void VtkSurfaceReader::read_types(pugi::xml_node cells, std::uint64_t count) const {
    VtkNumbers types = integers_of(xml_, xml_.required_array(cells, "types"), count);
    for (std::uint64_t cell = 0; cell < count; ++cell)
        if (const std::int64_t type = types.integer(); type != kTriangle && type != kQuad && type != kPolygon)
            xml_.fail(
                fmt::format("cell {} has VTK's type {}: only triangles, quads and polygons are a surface", cell, type));
    types.finish();
}

/// All triangles of a cell get its labels.
void VtkSurfaceReader::read_faces(pugi::xml_node piece, pugi::xml_node cells, std::uint64_t count) {
    const pugi::xml_node label_node = label_array(piece);
    const std::uint64_t sides = label_node ? components(label_node) : 0;
    if (sides != 2) {  // a region behind each face, and the exterior in front of it
        surface_.is_by_region = true;
        surface_.has_shared_points = false;
    }
    surface_.is_unsigned |= std::string_view(label_node.attribute("type").value()) == "UInt64";
    VtkNumbers offsets = integers_of(xml_, xml_.required_array(cells, "offsets"), count),
               connectivity = integers_of(xml_, xml_.required_array(cells, "connectivity"), std::nullopt);
    std::optional<VtkNumbers> labels;
    if (sides == 2) labels.emplace(integers_of(xml_, label_node, sides * count));
    if (sides == 1) labels.emplace(xml_, label_node, count);
    const std::uint64_t points = surface_.points.size() - first_point_;
    std::vector<std::uint32_t> corners;
    std::int64_t begin = 0;
    for (std::uint64_t cell = 0; cell < count; ++cell) {
        const std::int64_t end = offsets.integer();
        if (end < begin || end - begin < 3 || end - begin > kMostCorners)
            xml_.fail(fmt::format("cell {} is no polygon: its offset is {} after {}", cell, end, begin));
        corners.clear();
        for (; begin < end; ++begin) {
            const std::int64_t corner = connectivity.integer();
            if (corner < 0 || static_cast<std::uint64_t>(corner) >= points)
                xml_.fail(fmt::format("cell {} names point {} of {}", cell, corner, points));
            corners.push_back(static_cast<std::uint32_t>(first_point_ + static_cast<std::uint64_t>(corner)));
        }
        constexpr InputLabel kOnlyRegion = 1;
        const InputLabel first = labels ? labels->integer() : kOnlyRegion;
        add_polygon(surface_, corners, {first, sides == 2 ? labels->integer() : surface_.exterior_label}, xml_.path());
    }
    for (VtkNumbers* numbers : {&offsets, &connectivity}) numbers->finish();
    if (labels) labels->finish();
}

/// The labels on the two sides of each face; else those of the regions behind them: an array of one number a cell with
/// a name that means regions. An empty node where there is none: then all faces belong to one region.
pugi::xml_node VtkSurfaceReader::label_array(pugi::xml_node piece) const {
    const pugi::xml_node data = piece.child("CellData");
    for (const char* name : kLabelArrays) {
        const pugi::xml_node array = array_named(data, name);
        if (array && components(array) != 2 && components(array) != 1)
            xml_.fail(
                fmt::format("its cell array '{}' has {} components: 2 are needed, the labels on the two sides of "
                            "a face, or 1, that of the region behind it",
                            name, components(array)));
        if (array) return array;
    }
    pugi::xml_node best;
    for (const pugi::xml_node array : data.children("DataArray")) {
        const auto rank = region_rank(array.attribute("Name").value());
        const auto type = vtk_type(array);
        if (!rank || !type || is_real(*type) || components(array) != 1) continue;
        if (!best || *rank < *region_rank(best.attribute("Name").value())) best = array;
    }
    return best;
}

}  // namespace

FileSurface read_vtp(const std::filesystem::path& path) { return VtkSurfaceReader(path, "PolyData").read(false); }

FileSurface read_vtu(const std::filesystem::path& path) {
    return VtkSurfaceReader(path, "UnstructuredGrid").read(true);
}

}  // namespace regionmesh
