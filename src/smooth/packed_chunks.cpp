#include "smooth/packed_chunks.h"

#include <algorithm>
#include <utility>

#include "base/reused_vector.h"

namespace regionmesh {
namespace {

/// Faces name a pair of labels by how recently it was used, or anew.
class RecentLabels {
public:
    using Pair = std::array<Label, 2>;
    static constexpr std::uint32_t kCount = 3, kNew = kCount;

    std::uint32_t place_of(const Pair& pair) const {
        return static_cast<std::uint32_t>(std::find(pairs_.begin(), pairs_.end(), pair) - pairs_.begin());
    }
    const Pair& operator[](std::uint32_t place) const { return pairs_[place]; }
    /// `pair`, which was at this place, or is new, becomes the most recent.
    void use(Pair pair, std::uint32_t place) {
        for (std::uint32_t n = std::min(place, kCount - 1); n > 0; --n) pairs_[n] = pairs_[n - 1];
        pairs_[0] = pair;
    }

private:
    std::array<Pair, kCount> pairs_{};
};

/// A vertex is its kind, a bit for each axis along which its base is not that of the vertex before, and these
/// differences. The few vertices on sides of the box begin with kHasSides and the sides.
constexpr std::uint8_t kHasSides = 31;
constexpr int kFirstAxisBit = 5;
static_assert(kKindCount <= kHasSides && kFirstAxisBit + 3 == 8);

void put_vertices(PackedBytes& to, std::span<const LatticeVertex> vertices) {
    Vec3 last;
    for (const auto& [simplex, sides] : vertices) {
        if (sides != 0) {
            to.push_back(kHasSides);
            to.push_back(sides);
        }
        const Vec3 step = simplex.base - last;
        last = simplex.base;
        unsigned head = simplex.kind;
        for (int axis = 0; axis < 3; ++axis)
            if (step[axis] != 0) head |= 1u << (kFirstAxisBit + axis);
        to.push_back(static_cast<std::uint8_t>(head));
        for (int axis = 0; axis < 3; ++axis)
            if (step[axis] != 0) put_number(to, folded(static_cast<std::int64_t>(step[axis])));
    }
}

void take_vertices(const std::uint8_t* from, std::uint32_t count, std::vector<LatticeVertex>& vertices) {
    resize_reused(vertices, count);
    Vec3 base;
    for (LatticeVertex& vertex : vertices) {
        vertex.sides = 0;
        if (*from == kHasSides) {
            vertex.sides = from[1];
            from += 2;
        }
        const unsigned head = *from++;
        for (int axis = 0; axis < 3; ++axis)
            if (head >> (kFirstAxisBit + axis) & 1) base[axis] += static_cast<double>(unfolded(take_number(from)));
        vertex.simplex = {base, static_cast<std::uint8_t>(head & ((1u << kFirstAxisBit) - 1))};
    }
}

std::int64_t difference(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
}

void put_faces(PackedBytes& to, std::span<const ChunkFace> faces) {
    RecentLabels recent;
    std::uint32_t last = 0;
    for (const auto& [v, labels] : faces) {
        const std::uint32_t place = recent.place_of(labels);
        recent.use(labels, place);
        put_number(to, folded(difference(v[0], last)) * (RecentLabels::kNew + 1) + place);
        put_number(to, folded(difference(v[1], v[0])));
        put_number(to, folded(difference(v[2], v[1])));
        last = v[2];
        if (place != RecentLabels::kNew) continue;
        for (const Label label : labels) put_number(to, is_exterior(label) ? ~label * 2 + 1 : std::uint64_t{label} * 2);
    }
}

const std::uint8_t* take_faces(const std::uint8_t* from, std::uint32_t count, std::vector<ChunkFace>& faces) {
    const auto moved = [&](std::uint32_t from_number, std::uint64_t by) {
        return static_cast<std::uint32_t>(from_number + unfolded(by));
    };
    RecentLabels recent;
    std::uint32_t last = 0;
    resize_reused(faces, count);
    for (auto& [v, labels] : faces) {
        const std::uint64_t head = take_number(from);
        const auto place = static_cast<std::uint32_t>(head % (RecentLabels::kNew + 1));
        v[0] = moved(last, head / (RecentLabels::kNew + 1));
        v[1] = moved(v[0], take_number(from));
        last = v[2] = moved(v[1], take_number(from));
        if (place == RecentLabels::kNew) {
            for (Label& label : labels) {
                const std::uint64_t coded = take_number(from);
                label = static_cast<Label>(coded & 1 ? ~(coded >> 1) : coded >> 1);
            }
        } else {
            labels = recent[place];
        }
        recent.use(labels, place);
    }
    return from;
}

}  // namespace

void PackedChunks::push_back(const Chunk& chunk, std::span<const LatticeVertex> vertices) {
    thread_local PackedBytes bytes;
    clear_reused(bytes);
    Packed packed{chunk.carried,
                  static_cast<std::uint32_t>(vertices.size()),
                  static_cast<std::uint32_t>(chunk.faces.size()),
                  static_cast<std::uint32_t>(chunk.active.size()),
                  0,
                  {}};
    put_vertices(bytes, vertices);
    packed.first_face = static_cast<std::uint32_t>(bytes.size());
    put_faces(bytes, chunk.faces);
    std::uint32_t last = 0;
    for (const std::uint32_t vertex : chunk.active) {
        put_number(bytes, folded(difference(vertex, last)));
        last = vertex;
    }
    packed.bytes.assign(bytes.begin(), bytes.end());
    bytes_ += packed.bytes.size() + sizeof(Packed);
    chunks_.push_back(std::move(packed));
}

void PackedChunks::unpack(std::uint32_t chunk, Parts& parts) const {
    const Packed& packed = of(chunk);
    parts.carried = packed.carried;
    unpack_vertices(chunk, parts.vertices);
    const std::uint8_t* from = take_faces(packed.bytes.data() + packed.first_face, packed.faces, parts.faces);
    parts.active.resize(packed.active);
    std::uint32_t last = 0;
    for (std::uint32_t& vertex : parts.active)
        last = vertex = static_cast<std::uint32_t>(last + unfolded(take_number(from)));
}

void PackedChunks::unpack_vertices(std::uint32_t chunk, std::vector<LatticeVertex>& vertices) const {
    take_vertices(of(chunk).bytes.data(), of(chunk).vertices, vertices);
}

void PackedChunks::drop_before(std::uint32_t chunk) {
    for (; first_ < chunk; ++first_) {
        bytes_ -= chunks_.front().bytes.size() + sizeof(Packed);
        chunks_.pop_front();
    }
}

}  // namespace regionmesh
