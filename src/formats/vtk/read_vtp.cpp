#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_arrays.h"
#include "formats/vtk/vtk_xml_file.h"

namespace regionmesh {
namespace {

using formats::array_named;

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

/// Names of the array of two labels a face, the first behind it: ours and VTK's, PyVista's, DREAM.3D's.
constexpr const char* kLabelArrays[] = {"BoundaryLabels", "boundary_labels", "FaceLabels"};

/// VTK's numbers of cells that are polygons.
constexpr std::int64_t kTriangle = 5, kPolygon = 7, kQuad = 9;

/// Reads the pieces of a file one after the other into one surface.
class VtkSurfaceReader {
public:
    VtkSurfaceReader(const std::filesystem::path& path, const char* type) : file_(path, type) {}
    FileSurface read(bool is_grid);

private:
    void read_names();
    void refuse_other_cells(pugi::xml_node piece) const;
    void read_points(pugi::xml_node piece, std::uint64_t count);
    void read_node_types(pugi::xml_node piece, std::uint64_t count);
    void read_types(pugi::xml_node cells, std::uint64_t count) const;
    std::uint64_t read_offsets(pugi::xml_node cells, std::uint64_t count);
    void read_faces(pugi::xml_node cells, std::uint64_t corner_count);
    void read_labels(pugi::xml_node piece, std::uint64_t count);

    VtkXmlFile file_;
    FileSurface surface_;
    std::uint64_t first_point_ = 0;             // of the piece at hand
    std::vector<std::uint32_t> corner_counts_;  // of its cells
};

/// Labels and names side by side; other arrays with these names are left.
void VtkSurfaceReader::read_names() {
    const pugi::xml_node fields = file_.dataset().child("FieldData"), labels = array_named(fields, "RegionLabels"),
                         names = fields.find_child_by_attribute("Array", "Name", "RegionNames");
    if (!labels || !names || std::string_view(names.attribute("type").value()) != "String") return;
    const std::vector<std::string> texts = file_.read_strings(names);
    if (file_.number(labels, "NumberOfTuples", 0) != texts.size()) return;
    std::size_t n = 0;
    file_.read_integers(labels, texts.size(), [&](std::span<const std::int64_t> values) {
        for (const std::int64_t label : values)
            if (const std::string name = formats::one_line(texts[n++]); !name.empty()) surface_.names[label] = name;
    });
}

FileSurface VtkSurfaceReader::read(bool is_grid) {
    read_names();
    const pugi::xml_node exterior = array_named(file_.dataset().child("FieldData"), "ExteriorLabel");
    if (exterior)
        file_.read_integers(exterior, 1, [&](std::span<const std::int64_t> values) {
            if (!values.empty()) surface_.exterior_label = values[0];
        });
    if (!file_.dataset().child("Piece")) file_.fail("has no Piece");
    for (const pugi::xml_node piece : file_.dataset().children("Piece")) {
        if (!is_grid) refuse_other_cells(piece);
        const std::uint64_t points = file_.number(piece, "NumberOfPoints", 0),
                            cells = file_.number(piece, is_grid ? "NumberOfCells" : "NumberOfPolys", 0);
        if (points > kMostVertices - surface_.points.size() || cells > kMostFaces - surface_.faces.size())
            file_.fail(fmt::format("{} points and {} faces are more than a model can hold", points, cells));
        first_point_ = surface_.points.size();
        read_points(piece, points);
        read_node_types(piece, points);
        if (cells == 0) continue;
        const pugi::xml_node node = piece.child(is_grid ? "Cells" : "Polys");
        if (is_grid) read_types(node, cells);
        read_faces(node, read_offsets(node, cells));
        read_labels(piece, cells);
    }
    return std::move(surface_);
}

void VtkSurfaceReader::refuse_other_cells(pugi::xml_node piece) const {
    for (const char* other : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"})
        if (file_.number(piece, other, 0) != 0)
            file_.fail(
                fmt::format("{} is not 0: only polygons can be read; vtkTriangleFilter makes them of strips", other));
}

void VtkSurfaceReader::read_points(pugi::xml_node piece, std::uint64_t count) {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (count == 0) return;
    if (!array || file_.number(array, "NumberOfComponents", 1) != 3)
        file_.fail("needs an array of points with three components");
    file_.read_reals(
        array, 3 * count, by_groups<3, double>([&](const std::array<double, 3>& p) {
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
                file_.fail(fmt::format("point {} has a coordinate that is not finite", surface_.points.size()));
            surface_.points.push_back({p[0], p[1], p[2]});
        }));
}

void VtkSurfaceReader::read_node_types(pugi::xml_node piece, std::uint64_t count) {
    const pugi::xml_node array = array_named(piece.child("PointData"), "NodeType");
    if (!array || count == 0 || file_.number(array, "NumberOfComponents", 1) != 1) return;
    surface_.is_on_hull.resize(first_point_);
    file_.read_integers(array, count, [&](std::span<const std::int64_t> types) {
        for (const std::int64_t type : types) surface_.is_on_hull.push_back(type >= kFirstHullType);
    });
}

void VtkSurfaceReader::read_types(pugi::xml_node cells, std::uint64_t count) const {
    const pugi::xml_node array = array_named(cells, "types");
    if (!array) file_.fail("needs the array 'types' in Cells");
    std::uint64_t cell = 0;
    file_.read_integers(
        array, count, by_groups<1, std::int64_t>([&](const std::array<std::int64_t, 1>& type) {
            if (type[0] != kTriangle && type[0] != kQuad && type[0] != kPolygon)
                file_.fail(fmt::format("cell {} has VTK's type {}: only triangles, quads and polygons are a surface",
                                       cell, type[0]));
            ++cell;
        }));
}

/// Returns how many corners the cells have together.
std::uint64_t VtkSurfaceReader::read_offsets(pugi::xml_node cells, std::uint64_t count) {
    constexpr std::int64_t kMostCorners = 1 << 20;
    const pugi::xml_node array = array_named(cells, "offsets");
    if (!array) file_.fail(fmt::format("needs the array 'offsets' in {}", cells.name()));
    corner_counts_.clear();
    std::int64_t before = 0;
    file_.read_integers(array, count, by_groups<1, std::int64_t>([&](const std::array<std::int64_t, 1>& offset) {
                            if (offset[0] < before || offset[0] - before < 3 || offset[0] - before > kMostCorners)
                                file_.fail(fmt::format("cell {} is no polygon: its offset is {} after {}",
                                                       corner_counts_.size(), offset[0], before));
                            corner_counts_.push_back(static_cast<std::uint32_t>(offset[0] - before));
                            before = offset[0];
                        }));
    return static_cast<std::uint64_t>(before);
}

void VtkSurfaceReader::read_faces(pugi::xml_node cells, std::uint64_t corner_count) {
    const pugi::xml_node array = array_named(cells, "connectivity");
    if (!array) file_.fail(fmt::format("needs the array 'connectivity' in {}", cells.name()));
    const std::uint64_t points = surface_.points.size() - first_point_;
    std::vector<std::uint32_t> corners;
    std::size_t cell = 0;
    file_.read_integers(array, corner_count, [&](std::span<const std::int64_t> values) {
        for (const std::int64_t corner : values) {
            if (corner < 0 || static_cast<std::uint64_t>(corner) >= points)
                file_.fail(fmt::format("cell {} names point {} of {}", cell, corner, points));
            corners.push_back(static_cast<std::uint32_t>(first_point_ + static_cast<std::uint64_t>(corner)));
            if (corners.size() < corner_counts_[cell]) continue;
            add_polygon(surface_, corners, {});
            corners.clear();
            ++cell;
        }
        if (surface_.faces.size() > kMostFaces) file_.fail("has more faces than a model can hold");
    });
}

/// Each cell gives its labels to all the triangles that were made of it.
void VtkSurfaceReader::read_labels(pugi::xml_node piece, std::uint64_t count) {
    pugi::xml_node array;
    for (const char* name : kLabelArrays)
        if (!array) array = array_named(piece.child("CellData"), name);
    if (!array) file_.fail("needs the cell array 'BoundaryLabels': two integers a face, the labels on its two sides");
    const std::uint64_t components = file_.number(array, "NumberOfComponents", 1);
    if (components != 2)
        file_.fail(fmt::format("its cell array '{}' has {} components: 2 are needed", array.attribute("Name").value(),
                               components));
    std::uint64_t made = 0;
    for (const std::uint32_t corners : corner_counts_) made += corners - 2;
    std::size_t cell = 0, face = surface_.faces.size() - made;
    file_.read_integers(array, 2 * count, by_groups<2, std::int64_t>([&](const std::array<InputLabel, 2>& labels) {
                            for (std::uint32_t n = 2; n < corner_counts_[cell]; ++n) surface_.labels[face++] = labels;
                            ++cell;
                        }));
}

}  // namespace

FileSurface read_vtp(const std::filesystem::path& path) { return VtkSurfaceReader(path, "PolyData").read(false); }

FileSurface read_vtu(const std::filesystem::path& path) {
    return VtkSurfaceReader(path, "UnstructuredGrid").read(true);
}

}  // namespace regionmesh
