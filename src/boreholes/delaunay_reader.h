// Points of a table, and the tetrahedra that regionmesh-delaunay puts between them.
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

/// Sends the points away in take_points() and reads the tetrahedra as they come; apps/delaunay/README.md says how the two
/// talk. Of the size of the points it holds the numbers of their rows only.
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
    /// Its output ended too early.
    [[noreturn]] void tell_why();

    PointTable table_;  // without points once they are taken
    std::filesystem::path path_;
    std::optional<PipedProgram> program_;  // from take_points() to the last tetrahedron
    std::size_t point_count_ = 0;
    std::optional<std::uint64_t> left_;  // tetrahedra; unknown before the header
    std::vector<Corners> piece_;
};

/// Points of a table and their Delaunay tetrahedra. Throws Error(kInput) for fewer than four points.
std::unique_ptr<TetrahedronReader> open_points(PointTable table, const TetrahedraOptions& options);

}  // namespace regionmesh::formats
