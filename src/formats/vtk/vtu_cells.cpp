#include "formats/vtk/vtu_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 10;
constexpr std::uint64_t kMostCells = 0xFFFFFFFFu;
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

/// The arrays that may have the labels: no numbers of cells and points that the grid declares.
std::vector<MeshArray> label_candidates(pugi::xml_node piece) {
    std::vector<MeshArray> arrays;
    for (const pugi::xml_node node : arrays_of(piece, true))
        if (const std::string_view ids = node.parent().attribute("GlobalIds").value();
            ids.empty() || node.attribute("Name").value() != ids)
            arrays.push_back(describe(node));
    return arrays;
}

}  // namespace

VtuGrid::VtuGrid(const std::filesystem::path& file) : xml(file, "UnstructuredGrid") {
    for (const pugi::xml_node node : xml.dataset().children("Piece")) {
        const VtuPiece piece{node, xml.count(node, "NumberOfPoints", kMostPoints),
                             xml.count(node, "NumberOfCells", kMostCells), point_count};
        if (piece.cells == 0) continue;
        point_count += piece.points;
        cell_count += piece.cells;
        pieces.push_back(piece);
    }
    if (point_count > kMostPoints) xml.fail(fmt::format("has {} points; 2^32 - 2 can be read", point_count));
    if (cell_count == 0) xml.fail("has no cells; write it with tetrahedra");
}

void VtuGrid::choose_labels(const std::string& wanted) {
    const std::vector<MeshArray> arrays = label_candidates(pieces[0].node);
    labels = arrays[choose_label_array(xml.path(), arrays, wanted)];
    for (const VtuPiece& piece : pieces)
        if (const MeshArray other = describe(label_array(piece)); other.type != labels.type || other.components != 1)
            xml.fail(fmt::format("array '{}' is not the same in all pieces; write the grid as one piece",
                                 shown(labels.name)));
}

pugi::xml_node VtuGrid::label_array(const VtuPiece& piece) const {
    return array_named(piece.node.child(labels.is_cell ? "CellData" : "PointData"), labels.name.c_str());
}

void VtuCells::fail(const std::string& text) const { grid_.xml.fail(fmt::format("cell {} {}", cell(), text)); }

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
    const auto array = [&](const char* name) { return grid_.xml.required_array(cells, name); };
    types_.emplace(grid_.xml, array("types"), left_);
    ghosts_.reset();
    if (const auto ghosts = array_named(data, "vtkGhostType")) ghosts_.emplace(grid_.xml, ghosts, left_);
    if (depth_ == Depth::kTypes) return;
    offsets_.emplace(grid_.xml, array("offsets"), left_);
    corners_.emplace(grid_.xml, array("connectivity"), std::nullopt);
    if (grid_.labels.is_cell) labels_.emplace(grid_.xml, grid_.label_array(piece), left_);
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
