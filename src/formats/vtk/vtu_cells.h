// The cells of a VTK unstructured grid, piece after piece.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/vtk/vtk_numbers.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh::formats {

/// A part of a grid with points of its own; those of all pieces are counted one after the other.
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

/// Passes through the cells of a grid, which it holds a reference to. Cells of less than three dimensions, and those
/// that are copies of another piece's, are passed over; other solids are refused.
class VtuCells {
public:
    enum class Depth { kTypes, kCornersAndLabels };

    VtuCells(const VtuGrid& grid, Depth depth) : grid_(grid), depth_(depth) {}

    /// Goes to the next tetrahedron and fills it, where the depth is enough; false once there are no more.
    bool next(LabelledTetrahedron& tetrahedron);
    /// The number of the tetrahedron met last among all cells, from 0.
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
    std::int64_t offset_ = 0;           // where the corners of the last cell end
    std::optional<VtkNumbers> types_, ghosts_, offsets_, corners_, labels_;
};

}  // namespace regionmesh::formats
