// Small meshes of labelled tetrahedra in memory.
#pragma once

#include <functional>
#include <vector>

#include "cells/tetrahedron_mesher.h"
#include "regionmesh/tetrahedron_reader.h"
#include "support/volumes.h"

namespace regionmesh::test {

/// Tetrahedra in memory, as a reader hands them out.
class ArrayMesh : public TetrahedronReader {
public:
    /// Labels are the points', unless there are none.
    ArrayMesh(LabelledPoints points, std::vector<LabelledTetrahedron> tetrahedra);

    const TetrahedraInfo& info() const override { return info_; }
    LabelledPoints take_points() override { return points_; }
    std::string name_of_point(std::uint32_t point) const override { return "node " + std::to_string(point); }
    std::string name_of_tetrahedron(std::uint64_t n) const override { return "cell " + std::to_string(n); }
    std::size_t next(std::span<LabelledTetrahedron> tetrahedra) override;
    /// From the first tetrahedron.
    void rewind() { next_ = 0; }

    /// The same mesh with points and tetrahedra in another order, and corners turned.
    ArrayMesh shuffled(std::uint64_t seed) const;
    ArrayMesh& scaled(double scale_z);

    const LabelledPoints& points() const { return points_; }
    const std::vector<LabelledTetrahedron>& tetrahedra() const { return tetrahedra_; }

private:
    TetrahedraInfo info_;
    LabelledPoints points_;
    std::vector<LabelledTetrahedron> tetrahedra_;
    std::size_t next_ = 0;
};

/// Kuhn's six tetrahedra of every cell of a volume, with its labels at the points.
ArrayMesh mesh_of(const ArrayVolume& volume);

/// The same with a label for each cell: that of its first sample.
ArrayMesh cell_mesh_of(const ArrayVolume& volume);

/// Points here and there in a box, with the labels of the nearest of `label_count` others, and the tetrahedra of a
/// lattice whose points were moved: slivers among them, and a hull that is no box.
ArrayMesh bent_mesh(Size size, std::uint32_t label_count, std::uint64_t seed);

/// The same tetrahedra with the label of their first corner.
ArrayMesh by_cells(const ArrayMesh& mesh);

/// The tetrahedra of those cells of a lattice that the test keeps.
using KeepsCell = std::function<bool(std::uint32_t, std::uint32_t, std::uint32_t)>;
ArrayMesh carved(const ArrayMesh& mesh, Size size, const KeepsCell& keeps);

/// Meshes them in strips of `per_strip` tetrahedra each; end_strip() takes the strip from the mesher.
template <class EndStrip>
void mesh_in_strips(RankedTetrahedra& ranked, TetrahedronMesher& mesher, std::uint32_t per_strip,
                    EndStrip&& end_strip) {
    std::uint32_t count = 0, strip = 0;
    const auto end = [&] {
        end_strip();
        mesher.finalized().clear();
        mesher.begin_strip(++strip);
    };
    for (RankedTetrahedron t; ranked.sorted.next(t);) {
        mesher.finalize_before(t.corners[0]);
        if (++count % per_strip == 0) end();
        mesher.add(t);
    }
    mesher.finalize_all();
    end();
}

}  // namespace regionmesh::test
