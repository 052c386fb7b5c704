// The points of a table and their Delaunay tetrahedra, which regionmesh-delaunay makes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boreholes/point_table.h"
#include "formats/piped_program.h"

namespace regionmesh::formats {

/// Sends the points to the program in take_points() and streams the tetrahedra; apps/delaunay/README.md has the
/// protocol. Keeps only the row number of each point.
class DelaunayReader : public TetrahedronReader {
public:
    DelaunayReader(PointTable table, std::filesystem::path program);

    const TetrahedraInfo& info() const override { return table_.info; }
    LabelledPoints take_points() override;
    std::string name_of_point(std::uint32_t point) const override;
    std::string name_of_tetrahedron(std::uint64_t tetrahedron) const override;
    std::size_t next(std::span<LabelledTetrahedron> tetrahedra) override;

private:
    using Corners = std::array<std::uint32_t, 4>;

    void read_header();
    void check(const Corners& corners) const;
    void finish();
    [[noreturn]] void refuse(const std::string& what) const;
    /// Reports why the output of the program ended early.
    [[noreturn]] void refuse_ending();

    PointTable table_;  // has no points after take_points()
    std::filesystem::path path_;
    std::optional<PipedProgram> program_;  // runs from take_points() to the last tetrahedron
    std::size_t point_count_ = 0;
    std::optional<std::uint64_t> left_;  // tetrahedra; unknown before the header
    std::vector<Corners> piece_;
};

/// Points of a table and their Delaunay tetrahedra. Throws Error(kInput) for fewer than four points.
std::unique_ptr<TetrahedronReader> open_points(PointTable table, const TetrahedraOptions& options);

}  // namespace regionmesh::formats
