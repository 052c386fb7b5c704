// Models in an oblique box, turned into the axes of the box while they are changed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// simplify(), smooth(), smooth_lines() and improve() keep vertices on the sides of a box along the axes of
/// coordinates, and refuse a mesh whose box is oblique. The volume of a scanner often is, and so is the box of its
/// model: this turns the mesh so that they can keep vertices there. The box may be sheared, as that of a tilted gantry:
/// lengths are then those along its edges.
///
///     const BoxAxes axes(mesh);
///     simplify(mesh, options);
///     axes.restore(mesh);
class BoxAxes {
public:
    /// Turns the mesh, where its faces with the exterior lie in the planes of one oblique box, to a millionth of its
    /// size, and no more than four labels, sides included, meet on its edges and corners. Vertices on its sides get
    /// coordinates exactly on its planes, and they and the faces with the exterior get these sides. Ids are then dense,
    /// in the order of before. Does nothing to other meshes.
    explicit BoxAxes(Mesh& mesh);
    /// Turns the mesh of these samples into their axes, whichever they are; the box is theirs. Then samples() are those
    /// that simplify(), smooth_lines() and improve() keep in their regions. Does nothing where a face with the exterior
    /// is not on it.
    BoxAxes(Mesh& mesh, const Lattice& lattice);
    /// Turns the mesh back. Vertices that did not move get the positions of before.
    void restore(Mesh& mesh) const;

    /// How many times as large restore() makes volumes: 1 but for rounding, unless the box is sheared.
    double volume_factor() const { return is_oblique() ? std::abs(dot(axes_[0], cross(axes_[1], axes_[2]))) : 1; }

    bool is_oblique() const { return !sorted_.empty(); }
    /// The lattice given, in the axes of the turned mesh; along the axes of space, as it is. None without a lattice, or
    /// where the mesh was not turned because a face with the exterior is not on its box.
    const std::optional<Lattice>& samples() const { return samples_; }

private:
    struct Side;

    void set_axes(const std::array<Vec3, 3>& normals);
    void set_axes(const Lattice& lattice);
    bool turn(Mesh& mesh, const Box& box, bool needs_all_axes);
    void note_positions(const Mesh& mesh);
    bool find_sides(const Mesh& mesh, const Box& box, double tolerance, bool needs_all_axes,
                    std::vector<Side>& sides) const;
    void put_on_box(Mesh& mesh, const Box& box, double tolerance, const std::vector<Side>& sides);

    std::optional<Lattice> samples_;
    Vec3 origin_;
    std::array<Vec3, 3> axes_, across_;  // along the edges, of length 1; their products are 1 in pairs, else 0
    std::vector<Vec3> before_, after_;   // positions; the second ones in the axes of the box
    std::vector<std::uint32_t> sorted_;  // places in them, by the second position
};

/// Throws Error(kUsage) where most vertices on a side of the box do not lie in one plane along the axes of coordinates,
/// to a millionth of the size of the mesh. Single ones may lie beside it: in a damaged model, which is changed
/// elsewhere.
void require_along_axes(const Mesh& mesh);
/// The same where a lattice is oblique; throws what require_lattice() throws, too.
void require_along_axes(const std::string& what, const Lattice& samples);

}  // namespace regionmesh
