#include "smooth/lattice_sites.h"

#include "base/parallel_for.h"
#include "regionmesh/error.h"
#include "smooth/chunk_stars.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kTask = 2048;  // vertices

Float3 unit(Float3 v, Float3 otherwise) {
    const float size = length(v);
    return size > 0 ? (1 / size) * v : otherwise;
}

}  // namespace

void LatticeSites::add_chunk(std::uint32_t chunk) {
    const NumberRange vertices = window_.vertices_of(chunk), faces = window_.faces_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        kinds_.push_back(simplex_of(window_.origin[v], frame_).kind);
    for (std::uint32_t f = faces.first; f < faces.end; ++f)
        interfaces_.push_back(interface_of(window_.faces[f].labels));
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

std::uint32_t LatticeSites::site_of(std::uint32_t vertex, std::uint32_t interface) const {
    std::uint32_t s = first_site_[vertex];
    while (sites_[s].interface != interface) ++s;
    return s;
}

void LatticeSites::make(std::uint32_t chunk) {
    const ChunkStars stars(window_, chunk);
    const NumberRange vertices = stars.vertices();
    const double finest = frame_.finest();
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const Vec3 at = window_.origin[v] - frame_.origin;
        LatticeSite site{{}, {}, 0, kinds_[v]};
        for (int axis = 0; axis < 3; ++axis)
            site.centroid.at[axis] = static_cast<std::uint32_t>(std::llround(at[axis] / finest / LatticePoint::kStep));
        const std::uint32_t first = sites_.end();
        for (std::uint32_t corner : stars.of(v)) {
            const std::uint32_t f = corner >> 2;
            if (interfaces_[f] == kNoInterface) continue;
            const auto& [corners, labels] = window_.faces[f];
            const Vec3 a = window_.origin[corners[0]], b = window_.origin[corners[1]], c = window_.origin[corners[2]];
            const Vec3 normal =
                (labels[0] < labels[1] ? 1 / (finest * finest) : -1 / (finest * finest)) * cross(b - a, c - a);
            std::uint32_t s = first;
            while (s < sites_.end() && sites_[s].interface != interfaces_[f]) ++s;
            site.interface = interfaces_[f];
            if (s == sites_.end()) sites_.push_back(site);
            sites_[s].normal += Float3(normal);
        }
        first_site_.push_back(sites_.end());
    }
    const NumberRange made = of_chunk(chunk);
    for (std::uint32_t s = made.first; s < made.end; ++s) sites_[s].normal = unit(sites_[s].normal, {0, 0, 1});
}

void LatticeSites::average_normals(int pass, std::uint32_t chunk, std::uint32_t threads) {
    const ChunkStars stars(window_, chunk);
    const NumberRange vertices = stars.vertices();
    if (pass == 0) averaged_.grow(of_chunk(chunk).end);
    const auto normal_of = [&](std::uint32_t s) { return pass == 0 ? sites_[s].normal : averaged_[s]; };
    parallel_for((vertices.size() + kTask - 1) / kTask, threads, [&](std::uint32_t task) {
        const std::uint32_t first = vertices.first + task * kTask, end = std::min(vertices.end, first + kTask);
        for (std::uint32_t v = first; v < end; ++v) {
            std::array<Float3, 6> sums{};
            const NumberRange own = of_vertex(v);
            for (std::uint32_t corner : stars.of(v)) {
                const std::uint32_t f = corner >> 2;
                if (interfaces_[f] == kNoInterface) continue;
                Float3& sum = sums[site_of(v, interfaces_[f]) - own.first];
                for (std::uint32_t other : window_.faces[f].vertices) sum += normal_of(site_of(other, interfaces_[f]));
            }
            for (std::uint32_t s = own.first; s < own.end; ++s) {
                const Float3 normal = unit(sums[s - own.first], normal_of(s));
                if (pass == 0)
                    averaged_[s] = normal;
                else
                    sites_[s].normal = normal;
            }
        }
    });
    // Pass 1 of the chunk that follows reads the normals of this one.
    if (pass == 1 && chunk > 0) averaged_.drop_before(first_site_[window_.vertices_of(chunk).first]);
    if (pass == 1 && chunk > 0) interfaces_.drop_before(window_.faces_of(chunk).first);
}

void LatticeSites::drop_before(std::uint32_t v) {
    const std::uint32_t site = first_site_[v];
    kinds_.drop_before(v);
    first_site_.drop_before(v);
    sites_.drop_before(site);
}

}  // namespace regionmesh
