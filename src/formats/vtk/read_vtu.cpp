#include <fmt/format.h>

#include <utility>

#include "formats/surface/file_surface.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/vtk/vtu_cells.h"

namespace regionmesh::formats {
namespace {

/// The types of all cells are looked at when a file is opened, so that one of another kind is found before long work,
/// and again for the name of a tetrahedron that is not the only kind of cell: names are for messages.
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
             .scale_z = options.scale_z};
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
