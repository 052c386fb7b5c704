// Labelled tetrahedra, pulled some at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Points in the order in which tetrahedra count them, from 0; several may lie at one place.
struct LabelledPoints {
    std::vector<Vec3> positions;     // finite; z times TetrahedraInfo::scale_z
    std::vector<InputLabel> labels;  // one each, or none where the tetrahedra have the labels
};

struct LabelledTetrahedron {
    std::array<std::uint32_t, 4> corners;  // points, in any order
    InputLabel label = 0;                  // where the tetrahedra have the labels
};

/// What a reader knows before the first tetrahedron is read.
struct TetrahedraInfo {
    std::string source;            // path as given, for messages
    std::string format;            // "csv", "vtu", "msh"
    bool has_cell_labels = false;  // the tetrahedra have the labels, not the points
    bool is_unsigned = false;      // labels are unsigned numbers of 64 bits
    bool hull_is_convex = false;   // there are no gaps between the tetrahedra, nor do they touch themselves
    double scale_z = 1;            // z was multiplied by this
    LabelNames names = {};         // of labels, where the file has any
};

/// Pull interface of all that gives labelled tetrahedra: a mesh from a file, or labelled points and the tetrahedra that
/// Delaunay's rule puts between them.
class TetrahedronReader {
public:
    virtual ~TetrahedronReader() = default;

    virtual const TetrahedraInfo& info() const = 0;

    /// All points. To be called once, before next().
    virtual LabelledPoints take_points() = 0;

    /// How the user finds a point or a tetrahedron in the file: "row 12", "node 17"; "cell 5". Also after
    /// take_points().
    virtual std::string name_of_point(std::uint32_t point) const = 0;
    virtual std::string name_of_tetrahedron(std::uint64_t tetrahedron) const = 0;

    /// Fills the first of `tetrahedra` with the next ones and returns how many; 0 once there are no more. Holds a
    /// bounded number of them. Throws Error(kInput) naming file and place.
    virtual std::size_t next(std::span<LabelledTetrahedron> tetrahedra) = 0;
};

}  // namespace regionmesh
