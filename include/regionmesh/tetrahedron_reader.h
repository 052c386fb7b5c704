// Labelled tetrahedra, read in pieces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Points, numbered from 0 in their order; several may lie at the same place.
struct LabelledPoints {
    std::vector<Vec3> positions;     // finite; z times TetrahedraInfo::scale_z
    std::vector<InputLabel> labels;  // one for each point; empty if the tetrahedra have the labels
};

struct LabelledTetrahedron {
    std::array<std::uint32_t, 4> corners;  // point numbers, in any order
    InputLabel label = 0;                  // if the tetrahedra have the labels
};

/// What a reader knows before the first tetrahedron is read.
struct TetrahedraInfo {
    std::string source = {};            // path as given, for messages
    std::string format = {};            // "csv", "vtu", "msh"
    bool has_cell_labels = false;       // the tetrahedra have the labels, not the points
    bool is_unsigned = false;           // labels are unsigned 64-bit numbers
    bool hull_is_convex = false;        // the tetrahedra fill their convex hull without gaps
    double scale_z = 1;                 // factor by which z was multiplied
    std::optional<double> metres = {};  // metres in a unit of length, where the file says it
    LabelNames names = {};              // given by the file
    std::string warning = {};           // what the reader decided that the user may not expect: a line, or empty
};

/// What a model made of the tetrahedra says of its coordinates.
inline Coordinates coordinates_of(const TetrahedraInfo& info) { return {.metres = info.metres}; }

/// Pull interface of every source of labelled tetrahedra: a mesh from a file, or labelled points with their Delaunay
/// tetrahedra.
class TetrahedronReader {
public:
    virtual ~TetrahedronReader() = default;

    virtual const TetrahedraInfo& info() const = 0;

    /// Returns all points. Call once, before next().
    virtual LabelledPoints take_points() = 0;

    /// Where the user finds a point or a tetrahedron in the file: "row 12", "node 17"; "cell 5". Valid also after
    /// take_points().
    virtual std::string name_of_point(std::uint32_t point) const = 0;
    virtual std::string name_of_tetrahedron(std::uint64_t tetrahedron) const = 0;

    /// Writes the next tetrahedra to the front of `tetrahedra` and returns their number; 0 at the end. Holds a bounded
    /// number of tetrahedra. Throws Error(kInput) naming file and place.
    virtual std::size_t next(std::span<LabelledTetrahedron> tetrahedra) = 0;
};

}  // namespace regionmesh
