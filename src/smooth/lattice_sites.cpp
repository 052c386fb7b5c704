#include "smooth/lattice_sites.h"

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

constexpr std::array<Vec3, kKindCount> kCentroids = [] {
    std::array<Vec3, kKindCount> centroids{};
    for (int kind = 0; kind < kKindCount; ++kind) centroids[kind] = centroid(kind);
    return centroids;
}();

Float3 unit(Float3 v, Float3 otherwise) {
    const float size = length(v);
    return size > 0 ? (1 / size) * v : otherwise;
}

}  // namespace

void LatticeSites::add_chunk(std::uint32_t chunk) {
    const NumberRange vertices = window_.vertices_of(chunk), faces = window_.faces_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) add_vertex(v);
    for (std::uint32_t f = faces.first; f < faces.end; ++f) corners_.push_back(add_face(window_.faces[f]));
}

void LatticeSites::add_vertex(std::uint32_t v) {
    constexpr std::uint32_t kPairs[] = {0, 0, 1, 3, 6};  // by labels
    const LatticeSimplex simplex = simplex_of(window_.origin[v], frame_);
    LatticeSite site{{}, {}, kNoInterface, simplex.kind};
    const Vec3 middle = simplex.base + kCentroids[simplex.kind], scale = frame_.spacing / frame_.finest();
    for (int axis = 0; axis < 3; ++axis)
        site.centroid.at[axis] = static_cast<std::uint32_t>(
            static_cast<std::int64_t>(middle[axis] * scale[axis] * (1 / LatticePoint::kStep) + 0.5));
    for (std::uint32_t n = 0; n < kPairs[simplex.node_count()]; ++n) sites_.push_back(site);
    kinds_.push_back(simplex.kind);
    first_site_.push_back(sites_.end());
}

LatticeSites::CornerSites LatticeSites::add_face(const ChunkFace& face) {
    const std::uint32_t interface = interface_of(face.labels);
    if (interface == kNoInterface) return {kNoSite, kNoSite, kNoSite};
    const auto& [v, labels] = face;
    const Vec3 a = window_.origin[v[0]], b = window_.origin[v[1]], c = window_.origin[v[2]];
    const double per_square = 1 / (frame_.finest() * frame_.finest());
    const Float3 normal((labels[0] < labels[1] ? per_square : -per_square) * cross(b - a, c - a));
    const CornerSites sites{site_of(v[0], interface), site_of(v[1], interface), site_of(v[2], interface)};
    for (std::uint32_t s : sites) sites_[s].normal += normal;
    return sites;
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
std::uint32_t LatticeSites::site_of(std::uint32_t vertex, std::uint32_t interface) {
    const NumberRange own = of_vertex(vertex);
    for (std::uint32_t s = own.first; s < own.end; ++s) {
        if (sites_[s].interface == kNoInterface) sites_[s].interface = interface;
        if (sites_[s].interface == interface) return s;
    }
    throw Error(ErrorCode::kInput,
                "smoothing in the lattice: more regions meet at vertex " + std::to_string(vertex) +
                    " than its lattice simplex has nodes; only an unsmoothed, undecimated reconstruction of sections "
                    "can be smoothed so");
}

void LatticeSites::end_normals(std::uint32_t chunk) {
    const NumberRange own = of_chunk(chunk);
    for (std::uint32_t s = own.first; s < own.end; ++s) sites_[s].normal = unit(sites_[s].normal, {0, 0, 1});
}

/// Adds the normals at the corners of the faces of a chunk.
void LatticeSites::add_up(int pass, std::uint32_t chunk) {
    SlidingArray<Float3>& sums = sums_[pass];
    sums.grow(of_chunk(chunk).end);
    const auto normal_of = [&](std::uint32_t s) { return pass == 0 ? sites_[s].normal : sums_[0][s]; };
    const NumberRange faces = window_.faces_of(chunk);
    for (std::uint32_t f = faces.first; f < faces.end; ++f) {
        const auto [a, b, c] = corners_[f];
        if (a == kNoSite) continue;
        const Float3 sum = normal_of(a) + normal_of(b) + normal_of(c);
        sums[a] += sum;
        sums[b] += sum;
        sums[c] += sum;
    }
}

void LatticeSites::average_normals(int pass, std::uint32_t chunk) {
    if (chunk == 0) add_up(pass, 0);
    if (chunk + 1 < window_.chunk_end()) add_up(pass, chunk + 1);
    const NumberRange own = of_chunk(chunk);
    SlidingArray<Float3>& sums = sums_[pass];
    for (std::uint32_t s = own.first; s < own.end; ++s) {
        sums[s] = unit(sums[s], pass == 0 ? sites_[s].normal : sums_[0][s]);
        if (pass == 1) sites_[s].normal = sums[s];
    }
    if (pass == 0) return;
    // Pass 1 of the chunk that follows reads the normals of this one.
    sums_[1].drop_before(own.end);
    if (chunk == 0) return;
    sums_[0].drop_before(own.first);
    corners_.drop_before(window_.faces_of(chunk).first);
}

void LatticeSites::drop_before(std::uint32_t v) {
    const std::uint32_t site = first_site_[v];
    kinds_.drop_before(v);
    first_site_.drop_before(v);
    sites_.drop_before(site);
}

}  // namespace regionmesh
