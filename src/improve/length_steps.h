// Splits, collapses, flips and moves that bring edges near a wanted length.
#pragma once

#include <array>
#include <vector>

#include "judge/judge.h"

namespace regionmesh {

/// Tries steps one by one. Holds the scratch space of their tests. Requires Vertex::label_count (count_labels).
class LengthSteps {
public:
    /// Edges longer or shorter than these shares of the wanted length are split or collapsed.
    static constexpr double kLong = 4.0 / 3, kShort = 4.0 / 5;

    /// `wanted` is a length without Promises::scale_z.
    LengthSteps(Judge& judge, double wanted);

    /// In units of the wanted length.
    double length_of(Vec3 a, Vec3 b) const {
        Vec3 step = b - a;
        step.z *= inverse_z_;
        return length(step) * inverse_;
    }

    /// Splits the longest edge of the face in the middle, where it is long.
    bool try_split(FaceId f);
    /// Collapses an edge of the face that is short, the shortest first, where that makes no edge long.
    bool try_collapse(FaceId f);
    /// Flips the edge of the face opposite to `place`, where that brings vertices nearer to six faces, or makes better
    /// faces of vertices that are as near.
    bool try_flip(FaceId f, int place);
    /// Moves the vertex to where its edges are nearer to the wanted length, along its interface or line.
    bool try_move(VertexId v);

    /// The vertices whose star the last step changed.
    const std::vector<VertexId>& changed() const { return changed_; }

private:
    struct Candidate {
        Vec3 at;
        double energy;
    };

    std::array<double, 3> lengths_of(FaceId f) const;
    bool try_edge(VertexId goes, VertexId stays);
    bool try_place(Vec3 p);
    bool makes_long(Vec3 p) const;
    double valence_excess(VertexId v, const std::array<Label, 2>& labels, int change) const;
    double spoke_energy(Vec3 p) const;
    double energy_of_edges(VertexId v, VertexId other) const;
    double line_energy(Vec3 p) const;
    bool try_line_move();
    bool try_interface_move();
    bool take_best(double now);
    Vec3 spring_target() const;

    Judge& judge_;
    const Mesh& mesh_;
    double wanted_, inverse_, inverse_z_;
    double height_;  // most that one step may take the surface from where it was
    Change change_;
    std::vector<VertexId> changed_;
    std::vector<VertexId> line_ends_;
    std::vector<Candidate> candidates_;
};

}  // namespace regionmesh
