#include "mesh/star_crossing.h"

#include <algorithm>
#include <cmath>

#include "base/exact_predicates.h"
#include "mesh/face_meeting.h"

namespace regionmesh {
namespace {

/// The sign of a . (b x c) is reliable if its absolute value exceeds this share of the product of the three sizes: the
/// rounding error is below 2e-15 of that product.
constexpr double kDoubt = 1e-12;

}  // namespace

void StarCrossing::find(VertexId v, Vec3 at, std::span<const StarPage> pages, std::vector<FacePair>& found) {
    if (pages.size() < 2) return;
    at_ = at;
    pages_ = pages;
    if (is_interface() && is_fan_simple(pages_[0].labels[0])) return;
    gather_labels();
    proved_.assign(pages_.size(), 0);
    bool all_proved = true;
    for (int n = 0; n < labels_.size(); ++n) {
        const Label label = labels_.begin()[n];
        if (is_fan_simple(label)) {
            for (const FanPage& page : fan_) proved_[page.name >> 1] |= 1u << n;
        } else {
            all_proved = false;
        }
    }
    // Three labels: any two faces have a label in common if each has two different ones.
    if (!all_proved || is_odd_ || labels_.size() > 3) test_pairs(v, found);
}

bool StarCrossing::is_interface() const {
    return std::all_of(pages_.begin(), pages_.end(),
                       [&](const StarPage& page) { return page.labels == pages_[0].labels; });
}

void StarCrossing::gather_labels() {
    labels_ = LabelSet();
    is_odd_ = false;
    for (const StarPage& page : pages_) {
        for (Label label : page.labels) labels_.add(label);
        is_odd_ |= page.labels[0] == page.labels[1];
    }
}

/// Do the faces of the label form a closed or open fan without overlap? A page is named by its index, doubled, plus its
/// side.
bool StarCrossing::is_fan_simple(Label label) {
    fan_.clear();
    for (std::uint32_t n = 0; n < pages_.size(); ++n) {
        if (pages_[n].labels[0] == label)
            fan_.push_back({pages_[n].a, pages_[n].b, 2 * n});
        else if (pages_[n].labels[1] == label)
            fan_.push_back({pages_[n].b, pages_[n].a, 2 * n + 1});
    }
    if (fan_.size() < 2) return true;
    if (!order_fan(fan_)) return false;
    return is_simple(at_, fan_.size(), is_closed(fan_), [&](std::size_t n) {
        const bool is_end = n == fan_.size();
        const FanPage& page = fan_[is_end ? n - 1 : n];
        const StarPage& star_page = pages_[page.name >> 1];
        return ((page.name & 1) != 0) == is_end ? star_page.at_a : star_page.at_b;
    });
}

/// Seen from above, do all pages face upward, and does none but the first (and the last, in a closed fan) touch the ray
/// on which the first begins? Then they do not overlap.
bool StarCrossing::goes_round_once(bool is_closed) {
    if (!find_up()) return false;
    const Vec3 left = cross(up_, spokes_[0].to);
    const double doubt = kDoubt * size_of(up_) * spokes_[0].size;
    const std::size_t end = is_closed ? count_ - 1 : count_;
    bool is_once = true;
    for (std::size_t n = 1; n < end; ++n) {
        // The page begins left of the ray or ends right of it, since it turns by less than 180 degrees.
        const Spoke &first = spokes_[n], &second = spokes_[n + 1];
        is_once &= (dot(left, first.to) > doubt * first.size) | (dot(left, second.to) < -doubt * second.size);
    }
    return is_once;
}

/// Is there a direction that all pages face? Begins with up_, the sum of their normals, and moves it repeatedly toward
/// the page that faces it least (Rosenblatt's perceptron, 1958). Any direction that passes the test will do.
bool StarCrossing::find_up() {
    if (all_face_up()) return true;
    weights_.clear();
    up_ = Vec3{};
    for (std::size_t n = 0; n < count_; ++n) {
        weights_.push_back(1 / length(normals_[n]));
        up_ += weights_.back() * normals_[n];
    }
    constexpr int kAttempts = 4;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        double least = HUGE_VAL;
        std::size_t worst = 0;
        for (std::size_t n = 0; n < count_; ++n) {
            const double look = weights_[n] * dot(up_, normals_[n]);
            worst = look < least ? n : worst;
            least = std::min(look, least);
        }
        if (least > 0) return all_face_up();
        up_ += (0.1 - 1.5 * least) * weights_[worst] * normals_[worst];
    }
    return false;
}

bool StarCrossing::all_face_up() const {
    const double doubt = kDoubt * size_of(up_);
    bool all = true;
    for (std::size_t n = 0; n < count_; ++n)
        all &= dot(up_, normals_[n]) > doubt * spokes_[n].size * spokes_[n + 1].size;
    return all;
}

/// Tests the pairs about which nothing is proved yet.
void StarCrossing::test_pairs(VertexId v, std::vector<FacePair>& found) {
    gather_planes();
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        for (std::size_t j = i + 1; j < pages_.size(); ++j) {
            if ((proved_[i] & proved_[j]) != 0 || are_apart(i, j)) continue;
            const StarPage &f = pages_[i], &g = pages_[j];
            const bool share_a = f.a == g.a || f.a == g.b, share_b = f.b == g.a || f.b == g.b;
            const bool is_earlier = (share_a && f.a < v) || (share_b && f.b < v);  // found at another vertex
            if (!is_earlier && cross_exactly(v, f, g))
                found.push_back({std::min(f.face, g.face), std::max(f.face, g.face)});
        }
    }
}

void StarCrossing::gather_planes() {
    planes_.clear();
    for (const StarPage& page : pages_) {
        const Vec3 a = page.at_a - at_, b = page.at_b - at_;
        // Sizes out of range: the sides stay undecided.
        const bool usual = is_usual(size_of(a)) && is_usual(size_of(b));
        planes_.push_back({cross(a, b), {a, usual ? size_of(a) : HUGE_VAL}, {b, usual ? size_of(b) : HUGE_VAL}});
    }
}

int StarCrossing::Plane::side(const Spoke& spoke) const {
    const double ahead = dot(normal, spoke.to), doubt = kDoubt * to_a.size * to_b.size * spoke.size;
    return ahead > doubt ? 1 : ahead < -doubt ? -1 : 0;
}

/// Does one page lie on one side of the other's plane, except for the shared vertex or edge?
bool StarCrossing::are_apart(std::size_t i, std::size_t j) const { return is_off(i, j) || is_off(j, i); }

bool StarCrossing::is_off(std::size_t i, std::size_t j) const {
    const StarPage &f = pages_[i], &g = pages_[j];
    const bool has_a = g.a == f.a || g.a == f.b, has_b = g.b == f.a || g.b == f.b;
    const int a = has_a ? 0 : planes_[i].side(planes_[j].to_a), b = has_b ? 0 : planes_[i].side(planes_[j].to_b);
    return has_a ? !has_b && b != 0 : has_b ? a != 0 : a != 0 && a == b;
}

bool StarCrossing::cross_exactly(VertexId v, const StarPage& f, const StarPage& g) const {
    return !is_degenerate({at_, f.at_a, f.at_b}) && !is_degenerate({at_, g.at_a, g.at_b}) &&
           meet_outside_shared({{v, f.a, f.b}, {at_, f.at_a, f.at_b}}, {{v, g.a, g.b}, {at_, g.at_a, g.at_b}});
}

}  // namespace regionmesh
