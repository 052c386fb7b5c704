#include "page/page_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "base/fingerprint.h"
#include "mesh/extent.h"

namespace regionmesh {
namespace {

constexpr double kLevels = 65535;  // steps of a quantised coordinate or distance

using Place = std::array<std::uint16_t, 3>;

struct SortedFace {
    std::uint64_t pair;  // places of both labels
    std::uint64_t curve;
    FaceId id;
    bool operator<(const SortedFace& other) const {
        return std::tie(pair, curve, id) < std::tie(other.pair, other.curve, other.id);
    }
};

/// The bits of x, y and z, interleaved.
std::uint64_t morton_key(const Place& place) {
    std::uint64_t key = 0;
    for (int bit = 15; bit >= 0; --bit)
        for (const std::uint16_t number : place) key = key << 1 | (number >> bit & 1);
    return key;
}

std::uint16_t quantised(double value, double low, double high) {
    if (!(high > low)) return 0;
    return static_cast<std::uint16_t>(std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * kLevels));
}

class Encoder {
public:
    Encoder(const FileView& view, std::span<const double> distances) : view_(view), distances_(distances) {
        const Box box = extent_of(view.mesh(), 0);
        if (!box.is_empty()) made_.low = box.low, made_.high = box.high;
    }

    PageGeometry encode() {
        sort_faces();
        number_vertices();
        put_positions();
        put_faces();
        put_distances();
        return std::move(made_);
    }

private:
    Place place_of(VertexId v) const {
        const Vec3 p = view_.mesh().position(v);
        return {quantised(p.x, made_.low.x, made_.high.x), quantised(p.y, made_.low.y, made_.high.y),
                quantised(p.z, made_.low.z, made_.high.z)};
    }

    std::uint32_t label_place(Label label) const {
        return is_exterior(label) ? view_.labels().size() : view_.rank(label);
    }

    /// Order by pair of labels, then along a curve: neighbours in the list are mostly neighbours on the surface.
    void sort_faces() {
        const Mesh& mesh = view_.mesh();
        view_.for_faces([&](FaceId f) {
            auto [first, second] = mesh[f].labels;
            if (view_.is_turned(f)) std::swap(first, second);
            const std::uint64_t pair = std::uint64_t{label_place(first)} << 32 | label_place(second);
            sorted_.push_back({pair, morton_key(place_of(mesh[f].vertices[0])), f});
        });
        std::sort(sorted_.begin(), sorted_.end());
        for (const SortedFace& face : sorted_) {
            const PagePair pair{static_cast<std::uint32_t>(face.pair >> 32), static_cast<std::uint32_t>(face.pair)};
            if (made_.pairs.empty() || made_.pairs.back().first != pair.first ||
                made_.pairs.back().second != pair.second)
                made_.pairs.push_back(pair);
            ++made_.pairs.back().faces;
        }
        made_.faces = static_cast<std::uint32_t>(sorted_.size());
    }

    std::array<VertexId, 3> corners_of(FaceId f) const {
        auto corners = view_.mesh()[f].vertices;
        if (view_.is_turned(f)) std::swap(corners[1], corners[2]);
        return corners;
    }

    /// Vertices in order of first use. Those without a face are left out.
    void number_vertices() {
        numbers_.assign(view_.mesh().vertex_end(), kNone);
        for (const SortedFace& face : sorted_)
            for (const VertexId v : corners_of(face.id)) {
                if (numbers_[index(v)] != kNone) continue;
                numbers_[index(v)] = static_cast<std::uint32_t>(order_.size());
                order_.push_back(v);
            }
        made_.vertices = static_cast<std::uint32_t>(order_.size());
    }

    /// Differences of 16 bits between successive vertices, sign in the lowest bit: all low bytes, then all high bytes.
    void put_differences(const std::vector<std::uint16_t>& numbers) {
        std::vector<std::uint16_t> steps;
        std::uint16_t last = 0;
        for (const std::uint16_t number : numbers) {
            const auto step = static_cast<std::int16_t>(static_cast<std::uint16_t>(number - last));
            steps.push_back(static_cast<std::uint16_t>((static_cast<std::uint16_t>(step) << 1) ^ (step >> 15)));
            last = number;
        }
        for (const std::uint16_t step : steps) made_.bytes.push_back(static_cast<std::uint8_t>(step));
        for (const std::uint16_t step : steps) made_.bytes.push_back(static_cast<std::uint8_t>(step >> 8));
    }

    void put_positions() {
        std::vector<std::uint16_t> numbers(order_.size());
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t n = 0; n < order_.size(); ++n) numbers[n] = place_of(order_[n])[axis];
            put_differences(numbers);
        }
    }

    void put_number(std::uint32_t number) {
        for (; number >= 0x80; number >>= 7) made_.bytes.push_back(static_cast<std::uint8_t>(number | 0x80));
        made_.bytes.push_back(static_cast<std::uint8_t>(number));
    }

    /// A corner is its distance back from the number of vertices used so far: 0 is a new vertex.
    void put_faces() {
        const std::size_t begin = made_.bytes.size();
        std::uint32_t used = 0;
        for (const SortedFace& face : sorted_)
            for (const VertexId v : corners_of(face.id)) {
                const std::uint32_t number = numbers_[index(v)];
                put_number(used - number);
                if (number == used) ++used;
            }
        made_.index_bytes = static_cast<std::uint32_t>(made_.bytes.size() - begin);
    }

    void put_distances() {
        if (distances_.empty()) return;
        for (const VertexId v : order_) made_.largest_distance = std::max(made_.largest_distance, distances_[index(v)]);
        std::vector<std::uint16_t> numbers;
        for (const VertexId v : order_) numbers.push_back(quantised(distances_[index(v)], 0, made_.largest_distance));
        put_differences(numbers);
    }

    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    const FileView& view_;
    std::span<const double> distances_;
    std::vector<SortedFace> sorted_;
    std::vector<std::uint32_t> numbers_;  // one per vertex id
    std::vector<VertexId> order_;
    PageGeometry made_;
};

}  // namespace

std::uint64_t model_fingerprint(const FileView& view) {
    Fingerprint print;
    view.for_vertices([&](VertexId v) {
        const Vec3 p = view.mesh().position(v);
        for (const double number : {p.x, p.y, p.z}) print.add(std::bit_cast<std::uint64_t>(number));
    });
    view.for_faces([&](FaceId f) {
        const FileFace face = view.face(f);
        for (const std::uint32_t v : face.vertices) print.add(v);
        for (const InputLabel label : face.labels) print.add(static_cast<std::uint64_t>(label));
    });
    return print.value();
}

PageGeometry page_geometry(const FileView& view, std::span<const double> distances) {
    return Encoder(view, distances).encode();
}

}  // namespace regionmesh
