#include "formats/vtk/vtu_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "formats/surface/corners.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_arrays.h"

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 10;
constexpr std::int64_t kDuplicateOrHidden = 1 | 32;  // of vtkGhostType: cells of another piece, or taken out

/// VTK's cells of two dimensions at most: linear, quadratic, and of Lagrange and Bezier.
constexpr std::array<std::int64_t, 24> kFlat{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  21, 22,
                                             23, 28, 30, 34, 35, 36, 68, 69, 70, 75, 76, 77};

constexpr std::array<std::pair<std::int64_t, const char*>, 8> kSolids{{{11, "a voxel"},
                                                                       {12, "a hexahedron"},
                                                                       {13, "a wedge"},
                                                                       {14, "a pyramid"},
                                                                       {24, "a quadratic tetrahedron"},
                                                                       {42, "a polyhedron"},
                                                                       {71, "a Lagrange tetrahedron"},
                                                                       {78, "a Bezier tetrahedron"}}};
constexpr std::array<std::int64_t, 3> kCurvedTetrahedra{24, 71, 78};

std::uint64_t components(pugi::xml_node array) {
    const std::string_view text = array.attribute("NumberOfComponents").value();
    return text.empty() ? 1 : parse_size(text).value_or(0);
}

std::vector<MeshArray> arrays_of(pugi::xml_node piece) {
    std::vector<MeshArray> arrays;
    for (const bool is_cell : {true, false}) {
        const pugi::xml_node data = piece.child(is_cell ? "CellData" : "PointData");
        const std::string_view ids = data.attribute("GlobalIds").value();
        for (const pugi::xml_node node : data.children("DataArray")) {
            const std::string name = node.attribute("Name").value(), type = node.attribute("type").value();
            if (!is_vtk_integer(type) && !is_vtk_real(type)) continue;
            if (!ids.empty() && name == ids) continue;
            arrays.push_back({name, is_cell, is_vtk_integer(type), type, components(node)});
        }
    }
    return arrays;
}

}  // namespace

VtuGrid::VtuGrid(const std::filesystem::path& file) : path(file), tags(InputFile(file)) {
    const pugi::xml_node grid = tags.root().child("UnstructuredGrid");
    if (!grid) fail(path, "is no VTK XML file with UnstructuredGrid, as tetrahedra need");
    const auto count = [&](pugi::xml_node piece, const char* name) {
        const std::string_view text = piece.attribute(name).value();
        const auto number = text.empty() ? 0 : parse_size(text);
        if (!number || *number > kMostPoints)
            fail(path, fmt::format("{} is '{}': a count below 2^32 is needed", name, shown(text)));
        return *number;
    };
    for (const pugi::xml_node node : grid.children("Piece")) {
        const VtuPiece piece{node, count(node, "NumberOfPoints"), count(node, "NumberOfCells"), point_count};
        if (piece.cells == 0) continue;
        point_count += piece.points;
        cell_count += piece.cells;
        pieces.push_back(piece);
    }
    if (point_count > kMostPoints) fail(path, fmt::format("has {} points; 2^32 - 1 can be read", point_count));
    if (cell_count == 0) fail(path, "has no cells; write it with tetrahedra");
}

void VtuGrid::choose_labels(const std::string& wanted) {
    const std::vector<MeshArray> arrays = arrays_of(pieces[0].node);
    labels = arrays[choose_label_array(path, arrays, wanted)];
    for (const VtuPiece& piece : pieces)
        if (label_array(piece).attribute("type").value() != labels.type || components(label_array(piece)) != 1)
            fail(path, fmt::format("array '{}' is not the same in all pieces; write the grid as one piece",
                                   shown(labels.name)));
}

pugi::xml_node VtuGrid::label_array(const VtuPiece& piece) const {
    return array_named(piece.node.child(labels.is_cell ? "CellData" : "PointData"), labels.name.c_str());
}

VtkNumbers VtuGrid::open(pugi::xml_node parent, const char* name, std::optional<std::uint64_t> count) const {
    const pugi::xml_node array = array_named(parent, name);
    if (!array) fail(path, fmt::format("needs the array '{}' in {}", name, parent.empty() ? "Cells" : parent.name()));
    return {path, tags, array, count};
}

void VtuCells::fail(const std::string& text) const {
    formats::fail(grid_.path, fmt::format("cell {} {}", cell(), text));
}

void VtuCells::refuse(std::int64_t type) const {
    const auto found = std::find_if(kSolids.begin(), kSolids.end(), [&](const auto& s) { return s.first == type; });
    const bool is_curved =
        std::find(kCurvedTetrahedra.begin(), kCurvedTetrahedra.end(), type) != kCurvedTetrahedra.end();
    fail(fmt::format("is {}: {}", found == kSolids.end() ? fmt::format("of VTK's type {}", type) : found->second,
                     is_curved ? "write the mesh with linear elements, of four nodes"
                               : "split the cells into tetrahedra, as Tetrahedralize of ParaView does"));
}

void VtuCells::open_piece(const VtuPiece& piece) {
    piece_ = piece;
    left_ = piece.cells;
    offset_ = 0;
    const pugi::xml_node cells = piece.node.child("Cells"), data = piece.node.child("CellData");
    types_.emplace(grid_.open(cells, "types", left_));
    ghosts_.reset();
    if (array_named(data, "vtkGhostType")) ghosts_.emplace(grid_.open(data, "vtkGhostType", left_));
    if (depth_ == Depth::kTypes) return;
    offsets_.emplace(grid_.open(cells, "offsets", left_));
    corners_.emplace(grid_.open(cells, "connectivity", std::nullopt));
    if (grid_.labels.is_cell) labels_.emplace(grid_.path, grid_.tags, grid_.label_array(piece), left_);
}

bool VtuCells::next(LabelledTetrahedron& tetrahedron) {
    for (;;) {
        while (left_ == 0) {
            if (next_piece_ == grid_.pieces.size()) return false;
            open_piece(grid_.pieces[next_piece_++]);
        }
        --left_;
        ++met_;
        const std::int64_t type = types_->integer();
        const bool is_copy = ghosts_ && (ghosts_->integer() & kDuplicateOrHidden) != 0;
        const bool is_wanted = type == kTetrahedron && !is_copy;
        if (type != kTetrahedron && std::find(kFlat.begin(), kFlat.end(), type) == kFlat.end()) refuse(type);
        if (depth_ == Depth::kTypes) {
            if (is_wanted) return true;
            continue;
        }
        const std::int64_t before = std::exchange(offset_, offsets_->integer());
        if (offset_ < before) fail(fmt::format("ends at offset {} and begins at {}", offset_, before));
        const auto count = static_cast<std::uint64_t>(offset_) - static_cast<std::uint64_t>(before);
        if (is_wanted) {
            read_corners(tetrahedron, count);
            return true;
        }
        corners_->skip(count);
        if (labels_) labels_->skip(1);
    }
}

void VtuCells::read_corners(LabelledTetrahedron& tetrahedron, std::uint64_t count) {
    if (count != 4) fail(fmt::format("has {} nodes; a tetrahedron has 4", count));
    for (std::uint32_t& corner : tetrahedron.corners) {
        const std::int64_t point = corners_->integer();
        if (point < 0 || static_cast<std::uint64_t>(point) >= piece_.points)
            fail(fmt::format("names point {}; there are {}, counted from 0", point, piece_.points));
        corner = static_cast<std::uint32_t>(piece_.first_point + static_cast<std::uint64_t>(point));
    }
    if (has_repeated_corner(tetrahedron.corners)) fail("names a point twice; mend or drop it");
    tetrahedron.label = labels_ ? labels_->integer() : 0;
}

}  // namespace regionmesh::formats
