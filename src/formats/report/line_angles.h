// Dihedral angles at the edges of lines.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/file_view.h"

namespace regionmesh {

/// The faces at a line are as jagged as the samples, so the angle between two of them says nothing. Here an interface
/// has at an edge the normal that its faces up to `reach` away have on average, extrapolated to the edge: those that
/// lie near the edge are left out, and the others are taken as a linear function of their distance, so that a curved
/// interface has the angle at which it meets the line.
class LineAngles {
public:
    LineAngles(const FileView& view, double reach);

    /// The edge whose angles are wanted.
    void set_edge(VertexId v, VertexId w);
    /// The dihedral angle of a label at the edge, by its place in the order of files, from 0 to a full turn. None where
    /// it has not two faces there, or they have no area.
    std::optional<double> angle_inside(std::uint32_t rank) const;

private:
    /// Of an interface at the edge.
    struct Plane {
        std::array<std::uint32_t, 2> ranks;  // of its labels
        Vec3 normal;                         // from the first label to the second
        bool is_second_onward;               // anticlockwise round the edge, the second label comes after the interface
        Vec3 away = {};                      // from the edge, square to the axis and the normal
    };

    Vec3 normal_near(FaceId at_edge, Vec3 middle);
    Vec3 axis_of(Vec3 along) const;

    const FileView& view_;
    const Mesh& mesh_;
    double reach_;
    std::vector<Plane> planes_;
    Vec3 axis_{};
    std::vector<FaceId> waiting_;
    std::vector<std::uint32_t> seen_;  // by face: the last search that met it
    std::uint32_t search_ = 0;
};

}  // namespace regionmesh
