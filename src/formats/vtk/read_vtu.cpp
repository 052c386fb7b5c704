// Labelled tetrahedra in a VTK unstructured grid, piece after piece.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/surface/file_surface.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_numbers.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 10;
constexpr std::uint64_t kMostCells = 0xFFFFFFFFu;
constexpr std::int64_t kDuplicateOrHidden =
    1 | 32;  // flags of vtkGhostType: a copy of a cell of another piece, or a removed cell

/// VTK's cell types of at most two dimensions: linear, quadratic, Lagrange and Bezier.
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

/// The arrays that may have the labels: all except those that the grid declares as global ids.
std::vector<MeshArray> label_candidates(pugi::xml_node piece) {
    std::vector<MeshArray> arrays;
    for (const pugi::xml_node node : arrays_of(piece, true))
        if (const std::string_view ids = node.parent().attribute("GlobalIds").value();
            ids.empty() || node.attribute("Name").value() != ids)
            arrays.push_back(describe(node));
    return arrays;
}

/// A part of a grid with its own points; points are numbered through all pieces.
struct VtuPiece {
    pugi::xml_node node;
    std::uint64_t points = 0, cells = 0;
    std::uint64_t first_point = 0;
};

/// The pieces of a file. Throws Error(kInput) that names the file.
struct VtuGrid {
    explicit VtuGrid(const std::filesystem::path& file);

    void choose_labels(const std::string& wanted);

    /// The array with labels in one of the pieces.
    pugi::xml_node label_array(const VtuPiece& piece) const;

    VtkXml xml;
    std::vector<VtuPiece> pieces;  // that have cells
    MeshArray labels;
    std::uint64_t point_count = 0, cell_count = 0;
};

/// Iterates over the cells of a grid; holds a reference to it. Skips cells of fewer than three dimensions and copies of
/// cells of another piece; refuses other solids.
class VtuCells {
public:
    enum class Depth { kTypes, kCornersAndLabels };

    VtuCells(const VtuGrid& grid, Depth depth) : grid_(grid), depth_(depth) {}

    /// Moves to the next tetrahedron and, with kCornersAndLabels, fills it; false after the last.
    bool next(LabelledTetrahedron& tetrahedron);
    /// The number of the current tetrahedron among all cells, from 0.
    std::uint64_t cell() const { return met_ - 1; }

private:
    void open_piece(const VtuPiece& piece);
    void read_corners(LabelledTetrahedron& tetrahedron, std::uint64_t count);
    [[noreturn]] void refuse(std::int64_t type) const;
    [[noreturn]] void fail(const std::string& text) const;

    const VtuGrid& grid_;
    Depth depth_;
    std::size_t next_piece_ = 0;
    VtuPiece piece_;
    std::uint64_t left_ = 0, met_ = 0;  // cells, of the piece and of the file
    std::int64_t offset_ = 0;           // end of the corners of the last cell
    std::optional<VtkNumbers> types_, ghosts_, offsets_, corners_, labels_;
};

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

/// Reads the types of all cells when a file is opened, to refuse other solids before long work; and again for the name
/// of a tetrahedron in a grid with other cells: names are for messages only.
class VtuReader final : public TetrahedronReader {
public:
    VtuReader(const std::filesystem::path& path, const TetrahedraOptions& options);

    const TetrahedraInfo& info() const override { return info_; }
    LabelledPoints take_points() override;
    std::string name_of_point(std::uint32_t point) const override { return fmt::format("point {}", point); }
    std::string name_of_tetrahedron(std::uint64_t tetrahedron) const override;
    std::size_t next(std::span<LabelledTetrahedron> tetrahedra) override;

private:
    void read_points(const VtuPiece& piece, LabelledPoints& points) const;

    TetrahedraInfo info_;
    VtuGrid grid_;
    VtuCells cells_;
    std::uint64_t count_ = 0;  // of tetrahedra
};

VtuReader::VtuReader(const std::filesystem::path& path, const TetrahedraOptions& options)
    : grid_(path), cells_(grid_, VtuCells::Depth::kCornersAndLabels) {
    VtuCells types(grid_, VtuCells::Depth::kTypes);
    for (LabelledTetrahedron none; types.next(none);) ++count_;
    if (count_ == 0) fail(path, "has no tetrahedra: a surface model? `regionmesh check` reads those");
    grid_.choose_labels(options.array);
    info_ = {.source = path.string(),
             .format = "vtu",
             .has_cell_labels = grid_.labels.is_cell,
             .is_unsigned = grid_.labels.type == "UInt64",
             .scale_z = options.scale_z,
             .metres = metres_per_unit(grid_.xml)};
}

void VtuReader::read_points(const VtuPiece& piece, LabelledPoints& points) const {
    VtkNumbers numbers = points_of(grid_.xml, piece.node, piece.points);
    for (std::uint64_t i = 0; i < piece.points; ++i) {
        Vec3 p = numbers.point();
        p.z *= info_.scale_z;
        if (!is_finite(p))
            grid_.xml.fail(fmt::format("point {} has a coordinate that is not finite", points.positions.size()));
        points.positions.push_back(p);
    }
    numbers.finish();
    if (info_.has_cell_labels) return;
    VtkNumbers labels(grid_.xml, grid_.label_array(piece), piece.points);
    for (std::uint64_t i = 0; i < piece.points; ++i) points.labels.push_back(labels.integer());
    labels.finish();
}

LabelledPoints VtuReader::take_points() {
    LabelledPoints points;
    for (const VtuPiece& piece : grid_.pieces) read_points(piece, points);
    return points;
}

std::string VtuReader::name_of_tetrahedron(std::uint64_t tetrahedron) const {
    if (count_ == grid_.cell_count) return fmt::format("cell {}", tetrahedron);
    VtuCells types(grid_, VtuCells::Depth::kTypes);
    LabelledTetrahedron none;
    for (std::uint64_t i = 0; i <= tetrahedron; ++i)
        if (!types.next(none)) return fmt::format("tetrahedron {}", tetrahedron);
    return fmt::format("cell {}", types.cell());
}

std::size_t VtuReader::next(std::span<LabelledTetrahedron> tetrahedra) {
    std::size_t count = 0;
    while (count < tetrahedra.size() && cells_.next(tetrahedra[count])) ++count;
    return count;
}

}  // namespace

std::unique_ptr<TetrahedronReader> open_vtu(const std::filesystem::path& path, const TetrahedraOptions& options) {
    return std::make_unique<VtuReader>(path, options);
}

}  // namespace regionmesh::formats
