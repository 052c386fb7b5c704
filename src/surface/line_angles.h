// Dihedral angles at the edges of lines.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/file_view.h"
#include "surface/normal_fit.h"

namespace regionmesh {

/// The faces at a line are as jagged as the samples, so the angle between two of them says nothing. Here an interface
/// has at an edge the normal that its faces near there have as a linear function of position, so that a curved
/// interface has the angle at which it meets the line. Faces on a line are left out, and normals that do not agree with
/// the others count less.
class LineAngles {
public:
    /// `on_line` says for each vertex whether it is on a line; `edge_length` is the mean of edges on lines. Holds
    /// references to the view and `on_line`.
    LineAngles(const FileView& view, const std::vector<bool>& on_line, double edge_length);

    /// Looks at some of the edges of lines to tell whether the surfaces are rough: farther faces count then.
    void look_at(std::span<const std::array<VertexId, 2>> edges);

    /// The dihedral angles of labels at an edge, by their ranks in the order of files. None where a label has not two
    /// faces there, or they have no area. If all have one they add up to a full turn; noise may make a small one
    /// negative, where it exchanges interfaces round the edge.
    const std::vector<std::optional<double>>& at_edge(VertexId v, VertexId w, std::span<const std::uint32_t> ranks);
    /// Had each interface at the last edge a few faces off lines within reach? Fragments at the tip of a wedge have
    /// not.
    bool was_well_seen() const { return was_well_seen_; }

private:
    /// An interface at the edge.
    struct Plane {
        std::array<std::uint32_t, 2> ranks;  // ranks of its labels
        Vec3 normal;                         // normal from the first label to the second
        double error;                        // error of its fit
        Vec3 in_face;                        // direction from the edge across it, in the face there
        bool is_second_onward;               // anticlockwise round the edge, the second label comes after the interface
        Vec3 away = {};                      // direction from the edge, square to the axis and the normal
    };
    /// The turn from one side of a label to the other: between interfaces, and between the faces at the edge.
    struct Turn {
        double angle, of_faces;
    };

    void find_planes(VertexId v, VertexId w);
    void find_faces_near(FaceId at_edge, Vec3 middle);
    Vec3 axis_of(Vec3 along) const;
    std::optional<Turn> turn_inside(std::uint32_t rank) const;

    const FileView& view_;
    const Mesh& mesh_;
    const std::vector<bool>& on_line_;
    double edge_length_, reach_;
    int rounds_;  // rounds of fits
    std::vector<Plane> planes_;
    Vec3 along_{}, axis_{};  // unit vectors
    bool was_well_seen_ = true;
    std::vector<std::optional<double>> angles_;
    std::vector<Turn> turns_;
    std::vector<FaceId> found_;
    std::vector<NearFace> near_, off_line_;  // faces of the interface: all, and those that have no vertex on a line
    std::vector<std::uint32_t> seen_;        // one per face: the last search that met it
    std::uint32_t search_ = 0;
};

}  // namespace regionmesh
