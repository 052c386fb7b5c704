#include "judge/error_bound.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace regionmesh {
namespace {

/// Rounding errors are far below this share of the size of the star.
constexpr double kSlack = 1e-11;
/// Faces that are steeper than this, seen along the mean normal, are not compared along it.
constexpr double kLeastCosine = 1e-3;

template <class P>
double cross2(const P& p, const P& q) {
    return p.x * q.y - p.y * q.x;
}
/// Twice the area of a, b, c.
template <class P>
double turn(const P& a, const P& b, const P& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
template <class P>
P between(const P& p, const P& q, double t) {
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z), p.bound + t * (q.bound - p.bound)};
}
template <class P>
double distance(const P& p, const P& q) {
    return length(Vec3{p.x - q.x, p.y - q.y, p.z - q.z});
}
/// The place of the point of a segment that is nearest to p, from 0 to 1; and how far it is from there.
struct Nearest {
    double at, away;
};
template <class P>
Nearest nearest(const P& p, const P& from, const P& to) {
    const Vec3 way{to.x - from.x, to.y - from.y, to.z - from.z}, own{p.x - from.x, p.y - from.y, p.z - from.z};
    const double along = dot(way, own), whole = length2(way);
    if (!(along > 0)) return {0, length(own)};
    if (along >= whole) return {1, distance(p, to)};
    return {along / whole, length(cross(way, own)) / std::sqrt(whole)};
}

}  // namespace

double ErrorBound::merged(const Mesh& mesh, const EdgeStar& star, Vec3 position) {
    goes_bound_ = mesh[star.goes].error_bound();
    stays_bound_ = mesh[star.stays].error_bound();
    demands_.clear();
    bound_ = star.keeps_stays ? stays_bound_ : 0;  // its other faces keep it
    if (stays_flat(mesh, star)) return bound_;
    is_done_.assign(star.faces.size(), false);
    std::size_t dead_done = 0;
    for (int first = 0; first < star.face_count(); ++first) {
        if (is_done_[first]) continue;
        const auto& labels = mesh[star.faces[first].face].labels;
        faces_.clear();
        dead_ids_.clear();
        for (int n = first; n < star.face_count(); ++n) {
            if (!star.is_interface && !mesh[star.faces[n].face].has_labels(labels)) continue;
            faces_.push_back(n);
            is_done_[n] = true;
        }
        for (FaceId f : star.dead)
            if (star.is_interface || mesh[f].has_labels(labels)) dead_ids_.push_back(f);
        dead_done += dead_ids_.size();
        bound_ = std::max(bound_, of_interface(mesh, star, position));
    }
    if (dead_done < star.dead.size())
        bound_ = std::max(
            {bound_, goes_bound_ + length(star.at_goes - position), stays_bound_ + length(star.at_stays - position)});
    return bound_;
}

void ErrorBound::apply(Mesh& mesh, VertexId merged) const {
    mesh[merged].set_error_bound(bound_);
    for (const Demand& demand : demands_) {
        const double of_others = demand.value - demand.share * bound_;
        if (!(of_others > demand.rest)) continue;
        for (VertexId v : demand.others) {
            Vertex& vertex = mesh[v];
            vertex.set_error_bound(
                std::max<double>(vertex.error_bound(), std::min(demand.value, of_others / (1 - demand.share))));
        }
    }
}

/// Nothing moved yet, and nothing moves: common on unsmoothed lattices.
bool ErrorBound::stays_flat(const Mesh& mesh, const EdgeStar& star) const {
    if (!star.is_flat || goes_bound_ > 0 || stays_bound_ > 0 || mesh[star.goes].label_count != 2) return false;
    if (!star.keeps_stays && mesh[star.stays].label_count != 2) return false;
    // Closed all round.
    if (star.dead.size() != (star.goes == star.stays ? 0 : 2) ||
        star.link.size() != star.faces.size() + (star.keeps_stays ? 1 : 0))
        return false;
    return std::all_of(star.link.begin(), star.link.end(), [&](VertexId v) { return mesh[v].error_bound() == 0; });
}

double ErrorBound::of_interface(const Mesh& mesh, const EdgeStar& star, Vec3 position) {
    const double far = far_bound(star, position);
    if (far <= bound_) return far;  // another interface demands as much
    const std::size_t demands = demands_.size();
    if (is_vertical(mesh, star, position) && needed_ < far) return needed_;
    demands_.resize(demands);
    return far;
}

double ErrorBound::far_bound(const EdgeStar& star, Vec3 position) const {
    double bound = 0;
    const bool has_edge = !dead_ids_.empty();
    const auto has = [&](VertexId v) {
        return has_edge || std::any_of(faces_.begin(), faces_.end(), [&](int n) { return star.faces[n].apex == v; });
    };
    if (has(star.goes)) bound = goes_bound_ + length(star.at_goes - position);
    if (has(star.stays)) bound = std::max(bound, stays_bound_ + length(star.at_stays - position));
    return bound;
}

/// Sets `needed_`, where points can be compared along the mean normal.
bool ErrorBound::is_vertical(const Mesh& mesh, const EdgeStar& star, Vec3 position) {
    needed_ = 0;
    split_at_ = kNoVertex;
    if (!project(mesh, star, position) || !bring_rim() || !find_old()) return false;
    if ((goes_is_inside_ && !put_on_new(goes_)) || (stays_is_inside_ && !put_on_new(stays_))) return false;
    if (merged_is_inside_ && !put_on_old()) return false;
    cross_edges();
    if (needed_ > 0)
        needed_ += kSlack * (length(star.link_box.high - star.link_box.low) + length(star.at_goes - position));
    return true;
}

/// Fails where a new face looks down.
bool ErrorBound::project(const Mesh& mesh, const EdgeStar& star, Vec3 position) {
    Vec3 normal;
    for (int n : faces_) normal += star.new_normal(n);
    const double size = length(normal);
    if (!(size > 0)) return false;
    normal = normal / size;
    for (int n : faces_) {
        const double up = dot(star.new_normal(n), normal);
        if (!(up > 0) || up * up < kLeastCosine * kLeastCosine * star.new_length2(n)) return false;
    }
    const Vec3 least = std::abs(normal.x) <= std::abs(normal.y) && std::abs(normal.x) <= std::abs(normal.z)
                           ? Vec3{1, 0, 0}
                       : std::abs(normal.y) <= std::abs(normal.z) ? Vec3{0, 1, 0}
                                                                  : Vec3{0, 0, 1};
    Vec3 x = cross(least, normal);
    x = x / length(x);
    const Vec3 y = cross(normal, x);
    const auto seen = [&](Vec3 p, double bound) {
        const Vec3 from = p - position;
        return Point{dot(from, x), dot(from, y), dot(from, normal), bound};
    };
    fan_.clear();
    for (int n : faces_) {
        const StarFace& face = star.faces[n];
        fan_.push_back({face.a, face.b, seen(star.at_a(n), mesh[face.a].error_bound()),
                        seen(star.at_b(n), mesh[face.b].error_bound()), face.apex == star.goes});
        if (!(cross2(fan_.back().a, fan_.back().b) > 0)) return false;
    }
    dead_.clear();
    for (FaceId f : dead_ids_) {
        const auto& v = mesh[f].vertices;
        const int at = v[0] == star.goes ? 0 : v[1] == star.goes ? 1 : 2;
        const bool is_forward = v[(at + 1) % 3] == star.stays;
        const VertexId apex = v[(at + (is_forward ? 2 : 1)) % 3];
        dead_.push_back({apex, seen(mesh.position(apex), mesh[apex].error_bound()), is_forward});
    }
    goes_ = seen(star.at_goes, goes_bound_);
    stays_ = seen(star.at_stays, stays_bound_);
    return true;
}

/// Finds whether the new faces go round the merged vertex, or the merged vertex lies on their rim; in the second case
/// brings the old rim to the new one. Fails where the interface is no disk.
bool ErrorBound::bring_rim() {
    const FanFace *first = nullptr, *last = nullptr;
    for (const FanFace& face : fan_) {
        unsigned begins = 1, ends = 1;  // without branches, which would be mispredicted
        for (const FanFace& other : fan_) {
            begins &= other.at_b != face.at_a;
            ends &= other.at_a != face.at_b;
        }
        if ((begins && first) || (ends && last)) return false;
        if (begins) first = &face;
        if (ends) last = &face;
    }
    if (!covers_once(first)) return false;
    goes_is_inside_ = stays_is_inside_ = merged_is_inside_ = !first || !last;
    if (merged_is_inside_) {
        if (dead_.size() == 2) return true;
        // A move, or faces of one end only, which then has no edge to the other.
        const bool is_of_goes = fan_.front().is_of_goes;
        (is_of_goes ? stays_is_inside_ : goes_is_inside_) = false;
        return dead_.empty() && std::all_of(fan_.begin(), fan_.end(),
                                            [&](const FanFace& face) { return face.is_of_goes == is_of_goes; });
    }
    // The vertex next to the ends of the rim: that of the face there, or beyond a dead one the other.
    const auto is_apex = [&](VertexId v) {
        return std::any_of(dead_.begin(), dead_.end(), [&](const DeadFace& face) { return face.at_apex == v; });
    };
    const bool first_is_goes = first->is_of_goes != is_apex(first->at_a);
    const bool last_is_goes = last->is_of_goes != is_apex(last->at_b);
    if ((dead_.size() == 1) != (first_is_goes != last_is_goes)) return false;
    (first_is_goes ? stays_is_inside_ : goes_is_inside_) = dead_.size() == 2;
    rim_.clear();
    rim_.push_back(first_is_goes ? &goes_ : &stays_);
    if (dead_.size() == 1) rim_.push_back(last_is_goes ? &goes_ : &stays_);
    return bring_vertices(*first, *last);
}

/// The nearest point of the old rim goes to the merged vertex; the vertices on either side of it to the nearest points
/// of the edges there.
bool ErrorBound::bring_vertices(const FanFace& first, const FanFace& last) {
    const Point merged;
    std::size_t before = 0;  // vertices before that point
    Nearest nearest_of_all{0, HUGE_VAL};
    double bound = 0;
    for (std::size_t n = 0; n <= rim_.size(); ++n) {
        const Point &from = n == 0 ? first.a : *rim_[n - 1], &to = n == rim_.size() ? last.b : *rim_[n];
        const Nearest at = nearest(merged, from, to);
        if (!(at.away < nearest_of_all.away)) continue;
        nearest_of_all = at;
        before = n;
        bound = between(from, to, at.at).bound + at.away;
    }
    demand(bound, 1, 0, {});
    split_at_ = before == 0 ? first.at_a : before == rim_.size() ? last.at_b : kNoVertex;
    split_next_ = before == 0 ? rim_.front() : rim_.back();
    for (std::size_t n = 0; n < rim_.size(); ++n)
        if (!bring(*rim_[n], n < before ? first.a : last.b, n < before ? first.at_a : last.at_b)) return false;
    return true;
}

/// Brings a vertex to the new rim, between the merged vertex and the next one.
bool ErrorBound::bring(Point& end, const Point& rim, VertexId next) {
    const Nearest at = nearest(end, Point{}, rim);
    if (at.at >= 1) return false;
    end = {at.at * rim.x, at.at * rim.y, at.at * rim.z, end.bound + at.away};
    demand(end.bound, 1 - at.at, at.at * rim.bound, {next, next});
    return true;
}

/// All new faces look up: do they go round the merged vertex once, or less than once from the first to the last?
bool ErrorBound::covers_once(const FanFace* first) const {
    const FanFace& start = first ? *first : fan_.front();
    int passed = 0;
    for (const FanFace& face : fan_) {
        const bool before = (face.at_a != start.at_a) & (cross2(start.a, face.a) < 0);
        const bool after = (face.at_b == start.at_a) | (cross2(start.a, face.b) >= 0);
        passed += before & after;
    }
    return passed == (first ? 0 : 1);
}

/// The old faces, brought to the new rim, and their edges inside. Fails where one looks down.
bool ErrorBound::find_old() {
    old_faces_.clear();
    old_edges_.clear();
    bool look_up = true, is_fan_split = split_at_ != kNoVertex;
    for (const DeadFace& face : dead_) {
        const Point &from = face.is_forward ? goes_ : stays_, &to = face.is_forward ? stays_ : goes_;
        const bool is_split = face.at_apex == split_at_;
        if (is_split) is_fan_split = false;
        if (is_split)
            look_up = look_up && (split_next_ == &to ? add_parts(to, face.apex, from) : add_parts(face.apex, from, to));
        else if (dead_.size() == 1 && split_at_ == kNoVertex)
            look_up = look_up && add_parts(from, to, face.apex);
        else
            look_up = look_up && add_old({from, to, face.apex});
        for (const Point* end : {&goes_, &stays_})
            if (!is_split || end != split_next_) old_edges_.push_back({*end, face.apex});
    }
    if (dead_.size() == 2) old_edges_.push_back({goes_, stays_});
    for (const FanFace& face : fan_) {
        const Point& end = face.is_of_goes ? goes_ : stays_;
        const bool begins = is_fan_split && face.at_a == split_at_, ends = is_fan_split && face.at_b == split_at_;
        look_up = look_up && (begins ? add_parts(end, face.a, face.b)
                              : ends ? add_parts(face.b, end, face.a)
                                     : add_old({end, face.a, face.b}));
        if (!begins) old_edges_.push_back({end, face.a});
    }
    return look_up;
}

bool ErrorBound::add_old(const OldFace& face) {
    old_faces_.push_back(face);
    return turn(face[0], face[1], face[2]) > 0;
}

/// A face in two parts: a point between its first two corners is brought to the merged vertex.
bool ErrorBound::add_parts(const Point& a, const Point& b, const Point& c) {
    const Point merged;
    return turn(a, merged, c) >= 0 && turn(merged, b, c) >= 0;
}

/// An end of the edge, above or below the new faces.
bool ErrorBound::put_on_new(const Point& end) {
    for (const FanFace& face : fan_) {
        const double of_a = cross2(end, face.b), of_b = cross2(face.a, end), all = cross2(face.a, face.b);
        if (of_a < 0 || of_b < 0) continue;
        const double a = of_a / all, b = of_b / all;
        if (!(a + b < 1)) continue;
        demand(end.bound + std::abs(end.z - a * face.a.z - b * face.b.z), 1 - a - b,
               a * face.a.bound + b * face.b.bound, {face.at_a, face.at_b});
        return true;
    }
    return false;
}

/// The merged vertex, above or below an old face.
bool ErrorBound::put_on_old() {
    for (const auto& [a, b, c] : old_faces_) {
        const double of_a = cross2(b, c), of_b = cross2(c, a), of_c = cross2(a, b);
        if (of_a < 0 || of_b < 0 || of_c < 0) continue;
        demand((of_a * a.bound + of_b * b.bound + of_c * c.bound + std::abs(of_a * a.z + of_b * b.z + of_c * c.z)) /
                   (of_a + of_b + of_c),
               1, 0, {});
        return true;
    }
    return false;
}

/// Crossings of the new edges from the merged vertex with the old ones.
void ErrorBound::cross_edges() {
    // The pairs whose lines may cross are written without branches, which would be mispredicted.
    crossings_.resize(fan_.size() * old_edges_.size() + 1);
    std::size_t count = 0;
    for (const FanFace& face : fan_)
        for (const Edge& edge : old_edges_) {
            const double from = cross2(face.a, edge.from), to = cross2(face.a, edge.to);
            crossings_[count] = {&face, &edge, from, to};
            count += from * to < 0;
        }
    for (std::size_t n = 0; n < count; ++n) {
        const auto& [face, edge, from, to] = crossings_[n];
        const Point& way = face->a;
        const Point old = between(edge->from, edge->to, from / (from - to));
        const double at = (way.x * old.x + way.y * old.y) / (way.x * way.x + way.y * way.y);
        if (!((at > 0) & (at < 1))) continue;
        demand(old.bound + std::abs(old.z - at * way.z), 1 - at, at * way.bound, {face->at_a, face->at_a});
    }
}

/// At a point that is `share` of the merged vertex the bound must be `value`. The other corners are `others`, and give
/// `rest` now.
void ErrorBound::demand(double value, double share, double rest, std::array<VertexId, 2> others) {
    needed_ = std::max(needed_, value);
    if (share < 1 && value > rest) demands_.push_back({value, share, rest, others});
}

std::optional<FlipBound> flip_bound(const Mesh& mesh, const Flip& flip) {
    const Vec3 u = mesh.position(flip.u), v = mesh.position(flip.v), c = mesh.position(flip.c),
               d = mesh.position(flip.d);
    const Vec3 up = cross(d - c, v - u);
    const double old_c = dot(up, area_vector(c, u, v)), old_d = dot(up, area_vector(d, v, u));
    const double new_u = dot(up, area_vector(c, u, d)), new_v = dot(up, area_vector(c, d, v));
    if (!(old_c >= 0 && old_d >= 0 && old_c + old_d > 0 && new_u > 0 && new_v > 0)) return {};
    FlipBound step{.height = std::abs(dot(up, c - u)) / length(up), .share = old_c / (old_c + old_d)};
    const double u_bound = mesh[flip.u].error_bound(), v_bound = mesh[flip.v].error_bound();
    step.bound = u_bound + new_u / (new_u + new_v) * (v_bound - u_bound) + step.height;
    if (step.height > 0) step.bound += kSlack * (length(v - u) + length(d - c));
    return step;
}

void FlipBound::apply(Mesh& mesh, const Flip& flip) const {
    const double c_bound = mesh[flip.c].error_bound(), d_bound = mesh[flip.d].error_bound();
    if (c_bound + share * (d_bound - c_bound) >= bound) return;
    mesh[flip.c].set_error_bound(std::max(c_bound, bound));
    mesh[flip.d].set_error_bound(std::max(d_bound, bound));
}

bool is_within(double bound, double most) {
    Vertex vertex;  // rounds up
    vertex.set_error_bound(bound);
    return vertex.error_bound() <= most;
}

double largest_error_bound(const Mesh& mesh) {
    double largest = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) largest = std::max<double>(largest, mesh[VertexId{v}].error_bound());
    return largest;
}

}  // namespace regionmesh
