// Moves of vertices within their stratum that make the faces round them better.
#pragma once

#include <vector>

#include "improve/fan_shape.h"
#include "improve/surface_drift.h"
#include "judge/judge.h"

namespace regionmesh {

/// Tries moves one by one. Holds the scratch space of their tests. Requires Vertex::label_count (count_labels).
class VertexMoves {
public:
    /// `poor` is the bound on quality below which faces count as poor (SurfaceDrift).
    VertexMoves(Judge& judge, SurfaceDrift& drift, double poor);

    /// Moves the vertex to the best place found that no test refuses. The vertices around it are then those of link().
    bool try_move(VertexId v);
    /// The same in any direction that the sides of the box leave, for a vertex of any stratum: lines and points where
    /// regions meet move, too. For the corners of a face that nothing else cures.
    bool try_any_direction(VertexId v);
    const std::vector<VertexId>& link() const { return change_.star.link; }

private:
    struct Candidate {
        Vec3 at;
        double energy;  // of the faces with the vertex there
        double step;    // by which the surface moves
    };

    bool gather(VertexId v);
    bool take_best(VertexId v, std::size_t attempts);
    FanShape shape_at(Vec3 p) const;
    void gather_line();
    void gather_interface();
    void add_steps_to(Vec3 target, Vec3 up);
    void add_candidate(Vec3 p, double step);

    Judge& judge_;
    const Mesh& mesh_;
    SurfaceDrift& drift_;
    double poor3_;  // to the third power
    Change change_;
    FanShape now_;
    float drift_now_ = 0;
    std::vector<Candidate> candidates_;
    std::vector<VertexId> line_ends_;
};

}  // namespace regionmesh
