#include "regionmesh/decimate/obstruction.h"

#include <algorithm>

#include "regionmesh/base/triangle.h"
#include "regionmesh/model/exact_predicates.h"

namespace regionmesh {
namespace {

bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) == side && orientation(a, d, b, q) == side &&
           orientation(b, d, c, q) == side && orientation(c, d, a, q) == side;
}

std::uint64_t bit_of(VertexId v) { return std::uint64_t{1} << (index(v) & 63); }

/// All faces of the star lie in one plane square to an axis, exactly, and stay there: an interface or a side of the
/// box. Since none folds, the new faces tile the very polygon that the old ones did, and nothing can be in their way.
bool is_flat(const Model& model, const EdgeStar& star, Vec3 position) {
    const auto& labels = model[star.dead.front()].labels;
    for (int axis = 0; axis < 3; ++axis) {
        const double level = position[axis];
        if (model.position(star.goes)[axis] != level || model.position(star.stays)[axis] != level) continue;
        return std::all_of(star.faces.begin(), star.faces.end(), [&](const StarFace& f) {
            return f.at_a[axis] == level && f.at_b[axis] == level && model[f.face].labels == labels;
        });
    }
    return false;
}

}  // namespace

bool Obstruction::blocks(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position) {
    if (is_flat(model, star, position)) return false;
    prepare(model, tree, star, position);
    if (!is_simple_disk(model, star) && meets_itself()) return true;
    bool blocked = false;
    tree.search(box_, [&](FaceId f, const FaceTree::GridBox& box) {
        if (!is_near(box)) return true;
        const auto& v = model[f].vertices;
        if (v[0] == star.goes || v[1] == star.goes || v[2] == star.goes) return true;
        if (v[0] == star.stays || v[1] == star.stays || v[2] == star.stays) return true;
        const OldFace old = look_at(model, f);
        if (is_clear(old)) return true;
        blocked = meets_new_face(old, box) || (old.shared == 0 && is_swept(model, star, old.corners[0], box));
        return !blocked;
    });
    return blocked;
}

void Obstruction::prepare(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position) {
    position_ = position;
    ends_ = {model.position(star.goes), model.position(star.stays)};
    normal_ = Vec3{};
    faces_.clear();
    cells_.clear();
    cell_count_ = 0;
    for (const StarFace& f : star.faces) {
        normal_ += f.new_normal;
        NewFace made{f.a, f.b, {position, f.at_a, f.at_b}, {}, NewFace::kUnknown};
        Box cell;
        cell.add(model.position(f.apex));
        for (int n = 0; n < 3; ++n) {
            cell.add(made.corners[n]);
            made.walls[n] = {made.corners[n], cross(made.corners[(n + 1) % 3] - made.corners[n], f.new_normal)};
        }
        faces_.push_back(made);
        add_cell(tree, cell);
    }
    for (VertexId apex : star.apexes) {
        Box cell;
        for (Vec3 p : {position, ends_[0], ends_[1], model.position(apex)}) cell.add(p);
        add_cell(tree, cell);
    }
    box_ = Box{};
    low_ = high_ = 0;
    const auto reach = [&](Vec3 p) {
        box_.add(p);
        const double along = dot(normal_, p - position);
        low_ = std::min(low_, along);
        high_ = std::max(high_, along);
    };
    reach(position);
    for (Vec3 end : ends_) reach(end);
    link_.assign(star.link.begin(), star.link.end());
    link_at_.clear();
    link_bits_ = 0;
    for (VertexId v : link_) {
        link_at_.push_back(model.position(v));
        reach(link_at_.back());
        link_bits_ |= bit_of(v);
    }
}

/// The new star is a disk of one interface whose faces, seen along their mean normal, all look up and go round the
/// merged vertex once: no two of them meet but in what they share. The ray that is counted lies in the first face.
bool Obstruction::is_simple_disk(const Model& model, const EdgeStar& star) const {
    const auto& labels = model[star.dead.front()].labels;
    const Vec3 ray = 0.5 * (faces_[0].corners[1] + faces_[0].corners[2]) - position_;
    const Vec3 right = cross(ray, normal_);
    for (std::size_t n = 0; n < faces_.size(); ++n) {
        if (model[star.faces[n].face].labels != labels || !is_ahead(normal_, star.faces[n].new_normal)) return false;
        const Vec3 a = faces_[n].corners[1] - position_, b = faces_[n].corners[2] - position_;
        if (n > 0 && !is_ahead(-right, a) && !is_ahead(right, b)) return false;
    }
    return true;
}

/// Do two new faces meet outside the merged vertex or the edge that they share?
bool Obstruction::meets_itself() const {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const NewFace& f = faces_[i];
        for (std::size_t j = i + 1; j < faces_.size(); ++j) {
            const NewFace& g = faces_[j];
            const Corners &s = f.corners, &t = g.corners;
            const bool f_a = f.a == g.a || f.a == g.b, f_b = f.b == g.a || f.b == g.b;
            const Vec3 other = g.a == f.a || g.a == f.b ? t[2] : t[1];
            if (f_a   ? meet_beyond_edge(position_, s[1], s[2], other)
                : f_b ? meet_beyond_edge(position_, s[2], s[1], other)
                      : meet_beyond_vertex(position_, s[1], s[2], t[1], t[2]))
                return true;
        }
    }
    return false;
}

void Obstruction::add_cell(const FaceTree& tree, const Box& box) {
    const std::uint32_t lane = cell_count_++ % FaceTree::kFan;
    if (lane == 0) cells_.push_back(FaceTree::Boxes::none());
    cells_.back().put(lane, tree.outward(box));
}

/// Does any cell of the star reach the box?
bool Obstruction::is_near(const FaceTree::GridBox& box) const {
    return std::any_of(cells_.begin(), cells_.end(),
                       [&](const FaceTree::Boxes& cells) { return cells.meeting(box) != 0; });
}

Obstruction::OldFace Obstruction::look_at(const Model& model, FaceId f) const {
    OldFace old;
    old.vertices = model[f].vertices;
    old.corners = model.corners(f);
    int own = 0;
    for (int n = 0; n < 3; ++n) {
        const VertexId v = old.vertices[n];
        if ((link_bits_ & bit_of(v)) != 0 && std::find(link_.begin(), link_.end(), v) != link_.end()) {
            old.shared_at = old.corners[n];
            old.shared_vertices[old.shared++] = v;
        } else {
            old.own[own++] = old.corners[n];
        }
    }
    return old;
}

/// Cheap proofs that a face cannot meet the new star outside what they share: a wall on a link edge that has the star
/// behind it and the face before it but for shared corners; or the face lies above or below everything. Where the face
/// shares nothing they hold for all that is swept, too.
bool Obstruction::is_clear(const OldFace& old) {
    if (old.shared == 3) return false;
    if (old.shared == 0) return is_off_slab(old.corners);
    for (NewFace& face : faces_) {
        const auto is_end = [&](VertexId v) { return v == face.a || v == face.b; };
        if (!is_end(old.shared_vertices[0]) || (old.shared == 2 && !is_end(old.shared_vertices[1]))) continue;
        bool before = true;
        for (int n = 0; n < 3 - old.shared && before; ++n)
            before = is_ahead(face.walls[1].out, old.own[n] - old.shared_at);
        if (before && supports(face)) return true;
    }
    return false;
}

/// Is all that the star sweeps, but the ends of its link edge, behind the wall on that edge?
bool Obstruction::supports(NewFace& face) const {
    if (face.support == NewFace::kUnknown) {
        const Wall& wall = face.walls[1];
        bool all = is_ahead(wall.out, wall.at - ends_[0]) && is_ahead(wall.out, wall.at - ends_[1]);
        for (std::size_t n = 0; n < link_.size() && all; ++n)
            all = link_[n] == face.a || link_[n] == face.b || is_ahead(wall.out, wall.at - link_at_[n]);
        face.support = all ? NewFace::kSupports : NewFace::kDoesNot;
    }
    return face.support == NewFace::kSupports;
}

/// The face lies above or below all that the star sweeps, along the mean new normal.
bool Obstruction::is_off_slab(const Corners& p) const {
    const auto size = [](Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); };
    const double slack = 1e-10 * size(normal_) * size(box_.high - box_.low);
    bool above = true, below = true;
    for (Vec3 q : p) {
        const double along = dot(normal_, q - position_);
        const double own_slack = slack + 1e-10 * size(normal_) * size(q - position_);
        above &= along > high_ + own_slack;
        below &= along < low_ - own_slack;
    }
    return above || below;
}

bool Obstruction::meets_new_face(const OldFace& old, const FaceTree::GridBox& box) const {
    const Corners& p = old.corners;
    for (std::uint32_t group = 0; group * FaceTree::kFan < faces_.size(); ++group) {
        for (unsigned mask = cells_[group].meeting(box); mask; mask &= mask - 1) {
            const std::uint32_t n = group * FaceTree::kFan + static_cast<std::uint32_t>(__builtin_ctz(mask));
            if (n >= faces_.size()) break;
            const NewFace& face = faces_[n];
            const Corners& t = face.corners;
            int at_a = -1, at_b = -1;
            for (int place = 0; place < 3 && old.shared > 0; ++place) {
                if (old.vertices[place] == face.a) at_a = place;
                if (old.vertices[place] == face.b) at_b = place;
            }
            if (at_a >= 0 && at_b >= 0) {
                if (meet_beyond_edge(t[1], t[2], t[0], p[3 - at_a - at_b])) return true;
            } else if (at_a >= 0) {
                if (meets_at_corner(face, 1, p, at_a)) return true;
            } else if (at_b >= 0) {
                if (meets_at_corner(face, 2, p, at_b)) return true;
            } else {
                const auto is_before = [&](const Wall& wall) {
                    return is_ahead(wall.out, p[0] - wall.at) && is_ahead(wall.out, p[1] - wall.at) &&
                           is_ahead(wall.out, p[2] - wall.at);
                };
                if (is_before(face.walls[1]) || is_before(face.walls[0]) || is_before(face.walls[2])) continue;
                if (meet({t[0], t[1], t[2]}, {p[0], p[1], p[2]})) return true;
            }
        }
    }
    return false;
}

/// Do the new face and the old one, which share corner `corner` of the first and `place` of the second, meet outside
/// it?
bool Obstruction::meets_at_corner(const NewFace& face, int corner, const Corners& p, int place) {
    const Vec3 at = p[place], x = p[(place + 1) % 3], y = p[(place + 2) % 3];
    const Wall &before = face.walls[corner - 1], &after = face.walls[corner];
    if ((is_ahead(after.out, x - at) && is_ahead(after.out, y - at)) ||
        (is_ahead(before.out, x - at) && is_ahead(before.out, y - at)))
        return false;
    const Vec3 a = face.corners[(corner + 1) % 3], b = face.corners[(corner + 2) % 3];
    return meet_beyond_vertex(at, a, b, x, y);
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone.
bool Obstruction::is_swept(const Model& model, const EdgeStar& star, Vec3 q, const FaceTree::GridBox& box) const {
    for (std::uint32_t group = 0; group < cells_.size(); ++group) {
        for (unsigned mask = cells_[group].meeting(box); mask; mask &= mask - 1) {
            const std::uint32_t n = group * FaceTree::kFan + static_cast<std::uint32_t>(__builtin_ctz(mask));
            if (n < star.faces.size()) {
                const StarFace& f = star.faces[n];
                if (is_in_tetrahedron(position_, model.position(f.apex), f.at_a, f.at_b, q)) return true;
            } else if (is_in_tetrahedron(position_, ends_[0], ends_[1],
                                         model.position(star.apexes[n - star.faces.size()]), q)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace regionmesh
