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
constexpr double kSmallest = 1e-70, kLargest = 1e70;

double size(Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

bool is_usual(Vec3 a) { return size(a) > kSmallest && size(a) < kLargest; }

}  // namespace

void StarCrossing::find(const Model& model, VertexId v, std::span<const Corner> corners, std::vector<FacePair>& found) {
    if (corners.size() < 2) return;
    if (gather(model, v, corners)) {
        bool all_proved = true;
        for (int n = 0; n < labels_.size(); ++n) {
            const Label label = labels_.begin()[n];
            gather_fan(label);
            if (!is_fan_simple()) {
                all_proved = false;
                continue;
            }
            if (fan_.size() == pages_.size()) return;
            for (Page& page : pages_)
                if (page.labels[0] == label || page.labels[1] == label) page.proved |= 1u << n;
        }
        // With three labels any two faces have one in common.
        if (all_proved && labels_.size() < 4) return;
    }
    test_pairs(model, v, found);
}

/// False when nothing can be proved here.
bool StarCrossing::gather(const Model& model, VertexId v, std::span<const Corner> corners) {
    pages_.clear();
    labels_ = LabelSet();
    const Vec3 at = model.position(v);
    bool usual = true;
    for (Corner corner : corners) {
        const FaceId f{corner >> 2};
        const Face& face = model[f];
        const VertexId a = face.vertices[((corner & 3) + 1) % 3], b = face.vertices[((corner & 3) + 2) % 3];
        pages_.push_back({f, a, b, model.position(a) - at, model.position(b) - at, face.labels, 0});
        usual = usual && is_usual(pages_.back().to_a) && is_usual(pages_.back().to_b);
        for (Label label : face.labels) labels_.add(label);
    }
    return usual;
}

void StarCrossing::gather_fan(Label label) {
    fan_.clear();
    for (const Page& page : pages_) {
        if (page.labels[0] == label)
            fan_.push_back({page.a, page.b, page.to_a, page.to_b});
        else if (page.labels[1] == label)
            fan_.push_back({page.b, page.a, page.to_b, page.to_a});
    }
}

bool StarCrossing::is_fan_simple() { return fan_.size() < 2 || (order_fan() && goes_round_once()); }

/// Brings the fan in order, each page beginning where the one before ends. False when that cannot be.
bool StarCrossing::order_fan() {
    const auto is_first = [&](const FanPage& page) {
        return std::none_of(fan_.begin(), fan_.end(), [&](const FanPage& p) { return p.second == page.first; });
    };
    for (bool again : {true, false}) {
        std::size_t n = 1;
        while (n < fan_.size()) {
            const auto next = std::find_if(fan_.begin() + static_cast<std::ptrdiff_t>(n), fan_.end(),
                                           [&](const FanPage& p) { return p.first == fan_[n - 1].second; });
            if (next == fan_.end()) break;
            std::swap(fan_[n++], *next);
        }
        if (n == fan_.size()) return true;
        // An open fan has a first page.
        const auto start = std::find_if(fan_.begin(), fan_.end(), is_first);
        if (!again || start == fan_.end()) return false;
        std::swap(fan_[0], *start);
    }
    return false;
}

/// Seen along the mean normal, do all pages look up, and does none but the first (and the last, where the fan is closed)
/// come to the ray with which the first begins? Then the pages lie side by side.
bool StarCrossing::goes_round_once() const {
    const std::size_t count = fan_.size();
    Vec3 up;
    for (const FanPage& page : fan_) up += cross(page.to_first, page.to_second);
    const double up_size = size(up);
    for (const FanPage& page : fan_)
        if (!(dot(up, cross(page.to_first, page.to_second)) >
              kDoubt * up_size * size(page.to_first) * size(page.to_second)))
            return false;
    const Vec3 ray = fan_[0].to_first, left = cross(up, ray);
    const double doubt = kDoubt * up_size * size(ray);
    const bool is_closed = fan_[count - 1].second == fan_[0].first;
    for (std::size_t n = 1; n < count - is_closed; ++n) {
        const FanPage& page = fan_[n];
        // It begins left of the ray, or ends right of it: it turns by less than half a round.
        if (!(dot(left, page.to_first) > doubt * size(page.to_first)) &&
            !(dot(left, page.to_second) < -doubt * size(page.to_second)))
            return false;
    }
    return true;
}

void StarCrossing::test_pairs(const Model& model, VertexId v, std::vector<FacePair>& found) const {
    const auto placed = [&](const Page& page) { return PlacedFace{model[page.face].vertices, model.corners(page.face)}; };
    const auto has_area = [&](const Page& page) {
        const auto p = model.corners(page.face);
        return !is_degenerate({p[0], p[1], p[2]});
    };
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const Page& f = pages_[i];
        for (std::size_t j = i + 1; j < pages_.size(); ++j) {
            const Page& g = pages_[j];
            if ((f.proved & g.proved) != 0) continue;
            const bool share_a = f.a == g.a || f.a == g.b, share_b = f.b == g.a || f.b == g.b;
            if ((share_a && f.a < v) || (share_b && f.b < v)) continue;
            if (has_area(f) && has_area(g) && meet_outside_shared(placed(f), placed(g)))
                found.push_back({std::min(f.face, g.face), std::max(f.face, g.face)});
        }
    }
}

}  // namespace regionmesh
