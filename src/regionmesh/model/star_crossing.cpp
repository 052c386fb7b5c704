#include "regionmesh/model/star_crossing.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"

namespace regionmesh {
namespace {

/// A product of three vectors a . (b x c) whose value is more than this share of the product of their sizes has the sign
/// computed: its rounding error is below 2e-15 of it.
constexpr double kDoubt = 1e-12;

/// Sizes between which no product of four overflows, or loses more than kDoubt where numbers get too small.
constexpr double kSmallest = 1e-60, kLargest = 1e60;

bool is_usual(double size) { return size > kSmallest && size < kLargest; }

double size(Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

}  // namespace

void StarCrossing::find(const Model& model, VertexId v, std::span<const Corner> corners, std::vector<FacePair>& found) {
    if (corners.size() < 2) return;
    gather(model, corners);
    if (is_interface() && is_fan_simple(model, v, pages_[0].labels[0])) return;
    bool all_proved = !is_odd_;
    for (int n = 0; n < labels_.size(); ++n) {
        const Label label = labels_.begin()[n];
        const bool proved = is_fan_simple(model, v, label);
        all_proved &= proved;
        if (!proved) continue;
        for (Page& page : pages_)
            if (page.labels[0] == label || page.labels[1] == label) page.proved |= 1u << n;
    }
    // Of three labels any two faces have one in common, if each has two.
    if (!all_proved || labels_.size() > 3) test_pairs(model, v, found);
}

void StarCrossing::gather(const Model& model, std::span<const Corner> corners) {
    pages_.clear();
    labels_ = LabelSet();
    is_odd_ = false;
    for (Corner corner : corners) {
        const Face& face = model[FaceId{corner >> 2}];
        const std::uint32_t place = corner & 3;
        pages_.push_back(
            {FaceId{corner >> 2}, face.vertices[(place + 1) % 3], face.vertices[(place + 2) % 3], face.labels, 0});
        for (Label label : face.labels) labels_.add(label);
        is_odd_ |= face.labels[0] == face.labels[1];
    }
}

bool StarCrossing::is_interface() const {
    return std::all_of(pages_.begin(), pages_.end(), [&](const Page& page) { return page.labels == pages_[0].labels; });
}

/// Do the faces of the label go round v, or a part of the way, side by side?
bool StarCrossing::is_fan_simple(const Model& model, VertexId v, Label label) {
    fan_.clear();
    for (const Page& page : pages_) {
        if (page.labels[0] == label)
            fan_.push_back({page.a, page.b, 0});
        else if (page.labels[1] == label)
            fan_.push_back({page.b, page.a, 0});
    }
    return fan_.size() < 2 || (order_fan(fan_) && gather_spokes(model, v) && goes_round_once());
}

/// False where sizes are so unusual that nothing can be proved.
bool StarCrossing::gather_spokes(const Model& model, VertexId v) {
    const Vec3 at = model.position(v);
    bool usual = true;
    spokes_.clear();
    const auto add = [&](VertexId w) {
        const Vec3 to = model.position(w) - at;
        spokes_.push_back({to, size(to)});
        usual = usual && is_usual(spokes_.back().size);
    };
    for (const FanPage& page : fan_) add(page.first);
    add(fan_.back().second);
    return usual;
}

/// Seen from above, do all pages look up, and does none but the first (and the last, where the fan is closed) come to
/// the ray with which the first begins? Then they lie side by side.
bool StarCrossing::goes_round_once() {
    const std::size_t count = fan_.size();
    normals_.clear();
    for (std::size_t n = 0; n < count; ++n) normals_.push_back(cross(spokes_[n].to, spokes_[n + 1].to));
    Vec3 up;
    if (!find_up(up)) return false;
    const Vec3 left = cross(up, spokes_[0].to);
    const double doubt = kDoubt * size(up) * spokes_[0].size;
    const std::size_t end = is_closed(fan_) ? count - 1 : count;
    for (std::size_t n = 1; n < end; ++n) {
        // It begins left of the ray, or ends right of it: it turns by less than half a round.
        const Spoke &first = spokes_[n], &second = spokes_[n + 1];
        if (!(dot(left, first.to) > doubt * first.size) && !(dot(left, second.to) < -doubt * second.size)) return false;
    }
    return true;
}

/// A direction to which all pages look: the mean of their normals, or one drawn again and again to the page that looks
/// away most (Rosenblatt 1958). Any will do that passes the test.
bool StarCrossing::find_up(Vec3& up) {
    up = Vec3{};
    for (Vec3 normal : normals_) up += normal;
    if (all_look(up)) return true;
    weights_.clear();
    up = Vec3{};
    for (Vec3 normal : normals_) {
        weights_.push_back(1 / length(normal));
        up += weights_.back() * normal;
    }
    constexpr int kAttempts = 4;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        double least = HUGE_VAL;
        std::size_t worst = 0;
        for (std::size_t n = 0; n < normals_.size(); ++n) {
            const double look = weights_[n] * dot(up, normals_[n]);
            worst = look < least ? n : worst;
            least = std::min(look, least);
        }
        if (least > 0) return all_look(up);
        up += (0.1 - 1.5 * least) * weights_[worst] * normals_[worst];
    }
    return false;
}

bool StarCrossing::all_look(Vec3 up) const {
    const double doubt = kDoubt * size(up);
    for (std::size_t n = 0; n < normals_.size(); ++n)
        if (!(dot(up, normals_[n]) > doubt * spokes_[n].size * spokes_[n + 1].size)) return false;
    return true;
}

int StarCrossing::Plane::side(const Spoke& spoke) const {
    const double ahead = dot(normal, spoke.to);
    return ahead > doubt * spoke.size ? 1 : ahead < -doubt * spoke.size ? -1 : 0;
}

/// Looks at the pairs that nothing has been proved of.
void StarCrossing::test_pairs(const Model& model, VertexId v, std::vector<FacePair>& found) {
    gather_planes(model, v);
    const auto cross = [&](FaceId f, FaceId g) {
        const auto p = model.corners(f), q = model.corners(g);
        return !is_degenerate({p[0], p[1], p[2]}) && !is_degenerate({q[0], q[1], q[2]}) &&
               meet_outside_shared({model[f].vertices, p}, {model[g].vertices, q});
    };
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const Page& f = pages_[i];
        for (std::size_t j = i + 1; j < pages_.size(); ++j) {
            const Page& g = pages_[j];
            if ((f.proved & g.proved) != 0 || are_pages_apart(i, j)) continue;
            const bool share_a = f.a == g.a || f.a == g.b, share_b = f.b == g.a || f.b == g.b;
            const bool is_earlier = (share_a && f.a < v) || (share_b && f.b < v);  // another vertex's pair
            if (!is_earlier && cross(f.face, g.face))
                found.push_back({std::min(f.face, g.face), std::max(f.face, g.face)});
        }
    }
}

void StarCrossing::gather_planes(const Model& model, VertexId v) {
    const Vec3 at = model.position(v);
    planes_.clear();
    for (const Page& page : pages_) {
        const Vec3 a = model.position(page.a) - at, b = model.position(page.b) - at;
        // What is of unusual size is on no side of anything.
        const bool usual = is_usual(size(a)) && is_usual(size(b));
        const Spoke to_a{a, usual ? size(a) : HUGE_VAL}, to_b{b, usual ? size(b) : HUGE_VAL};
        planes_.push_back({cross(a, b), to_a, to_b, kDoubt * to_a.size * to_b.size});
    }
}

/// One page lies on one side of the other's plane, but for the vertex or the edge that they share.
bool StarCrossing::are_pages_apart(std::size_t i, std::size_t j) const {
    const auto is_off = [&](std::size_t m, std::size_t n) {
        const Page &f = pages_[m], &g = pages_[n];
        const bool has_a = g.a == f.a || g.a == f.b, has_b = g.b == f.a || g.b == f.b;
        const int a = has_a ? 0 : planes_[m].side(planes_[n].to_a), b = has_b ? 0 : planes_[m].side(planes_[n].to_b);
        return has_a ? !has_b && b != 0 : has_b ? a != 0 : a != 0 && a == b;
    };
    return is_off(i, j) || is_off(j, i);
}

}  // namespace regionmesh
