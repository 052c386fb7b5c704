#include "smooth/lattice/lattice_sites.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

Float3 unit(Float3 v, Float3 otherwise) {
    const float size = length(v);
    return size > 0 ? (1 / size) * v : otherwise;
}

[[noreturn]] void refuse_place(double units, int axis) {
    throw Error(ErrorCode::kInput, "smoothing in the lattice: sample " + std::to_string(std::llround(units)) +
                                       " along " + "xyz"[axis] +
                                       " is too far from the first; use --smooth-filter taubin");
}

}  // namespace

void LatticeSites::add(const Chunk& chunk, std::span<const LatticeVertex> vertices) {
    assert(chunk.carried == locals_.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) add_vertex(chunk.vertices[v], vertices[v].simplex);
    for (const ChunkFace& face : chunk.faces) add_face(face);
    starts_.push_back({sites_.end(), corners_.end()});
    std::vector<Local> carried;
    for (const std::uint32_t local : chunk.active) carried.push_back(locals_[local]);
    locals_ = std::move(carried);
}

void LatticeSites::add_vertex(const ChunkVertex& vertex, const LatticeSimplex& simplex) {
    LatticeSite site{{}, kNoInterface | std::uint32_t{simplex.kind} << LatticeSite::kKindBit, {}};
    const Vec3 middle = simplex.base + kCentroids[simplex.kind], scale = frame_.spacing / frame_.finest();
    for (int axis = 0; axis < 3; ++axis) {
        const double steps = middle[axis] * scale[axis] / steps_.size(axis) + 0.5;
        if (steps > LatticeSteps::kMost) refuse_place(middle[axis], axis);
        site.centroid.at[axis] = static_cast<std::uint32_t>(steps);
    }
    const std::uint32_t first = sites_.end();
    for (std::uint32_t n = 0; n < count_of(simplex); ++n) sites_.push_back(site);
    locals_.push_back({vertex.position, {first, sites_.end()}});
}

void LatticeSites::add_face(const ChunkFace& face) {
    const std::uint32_t interface = interface_of(face.labels);
    if (interface == kNoInterface) return;
    const auto& [v, labels] = face;
    const Vec3 a = locals_[v[0]].position, b = locals_[v[1]].position, c = locals_[v[2]].position;
    const double per_square = 1 / (frame_.finest() * frame_.finest());
    const Float3 normal((labels[0] < labels[1] ? per_square : -per_square) * cross(b - a, c - a));
    const CornerSites sites{site_of(locals_[v[0]], interface), site_of(locals_[v[1]], interface),
                            site_of(locals_[v[2]], interface)};
    for (std::uint32_t s : sites) sites_[s].normal += normal;
    corners_.push_back(sites);
}

/// Faces that follow each other are often of one interface.
std::uint32_t LatticeSites::interface_of(std::array<Label, 2> labels) {
    if (is_exterior(labels[0]) || is_exterior(labels[1])) return kNoInterface;
    const std::uint64_t pair = std::uint64_t{std::min(labels[0], labels[1])} << 32 | std::max(labels[0], labels[1]);
    if (pair == last_pair_ && last_number_ != kNoInterface) return last_number_;
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    last_number_ = numbers_.try_emplace(pair, next).first->second;
    if (last_number_ >= kNoInterface)
        throw Error(ErrorCode::kInput, "smoothing: more than " + std::to_string(kNoInterface) +
                                           " pairs of regions touch; use --smooth-filter taubin");
    last_pair_ = pair;
    return last_number_;
}

/// The first free site of the vertex if the interface is new to it.
std::uint32_t LatticeSites::site_of(const Local& vertex, std::uint32_t interface) {
    for (std::uint32_t s = vertex.sites.first; s < vertex.sites.end; ++s) {
        std::uint32_t& code = sites_[s].code;
        if (!is_used(s)) code = (code & ~kNoInterface) | interface;
        if (sites_[s].interface() == interface) return s;
    }
    throw Error(
        ErrorCode::kInput,
        "smoothing in the lattice: more regions meet at " + std::to_string(vertex.position.x) + ", " +
            std::to_string(vertex.position.y) + ", " + std::to_string(vertex.position.z) +
            " than the vertex's lattice simplex has nodes; only an unsmoothed, undecimated reconstruction of sections "
            "can be smoothed so");
}

void LatticeSites::end_normals(std::uint32_t chunk) {
    const NumberRange own = of_chunk(chunk);
    for (std::uint32_t s = own.first; s < own.end; ++s) sites_[s].normal = unit(sites_[s].normal, {0, 0, 1});
}

/// Adds the normals at the corners of the faces of a chunk.
void LatticeSites::add_up(int pass, std::uint32_t chunk) {
    SlidingPages<Float3>& sums = sums_[pass];
    sums.grow(of_chunk(chunk).end);
    const auto normal_of = [&](std::uint32_t s) { return pass == 0 ? sites_[s].normal : sums_[0][s]; };
    for (std::uint32_t f = starts_[chunk].face; f < starts_[chunk + 1].face; ++f) {
        const auto [a, b, c] = corners_[f];
        const Float3 sum = normal_of(a) + normal_of(b) + normal_of(c);
        sums[a] += sum;
        sums[b] += sum;
        sums[c] += sum;
    }
}

void LatticeSites::average_normals(int pass, std::uint32_t chunk) {
    if (chunk == 0) add_up(pass, 0);
    if (chunk + 1 < chunk_end()) add_up(pass, chunk + 1);
    const NumberRange own = of_chunk(chunk);
    SlidingPages<Float3>& sums = sums_[pass];
    for (std::uint32_t s = own.first; s < own.end; ++s) {
        sums[s] = unit(sums[s], pass == 0 ? sites_[s].normal : sums_[0][s]);
        if (pass == 1) sites_[s].normal = sums[s];
    }
    if (pass == 0) return;
    // Pass 1 has added up the faces of the chunk that follows, too.
    sums_[0].drop_before(own.end);
    sums_[1].drop_before(own.end);
    corners_.drop_before(starts_[std::min(chunk + 2, chunk_end())].face);
}

}  // namespace regionmesh
