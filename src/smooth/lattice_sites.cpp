#include "smooth/lattice_sites.h"

#include <unordered_map>
#include <utility>

namespace regionmesh {
namespace {

/// Times that normals are averaged with those of the faces' other corners: the unsmoothed surface is a staircase.
constexpr int kNormalPasses = 2;

Vec3 unit(Vec3 v, Vec3 otherwise) {
    const double size = length(v);
    return size > 0 ? v / size : otherwise;
}

}  // namespace

LatticeSites find_sites(std::span<const Vec3> positions, std::span<const LatticeSimplex> simplices,
                        std::span<const LatticeFace> faces) {
    LatticeSites found;
    found.first.assign(positions.size(), kNoSite);
    std::vector<std::array<std::uint32_t, 3>> corners;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;  // of interfaces, in order of first use
    const auto interface_of = [&](std::array<Label, 2> labels) {
        const std::uint64_t key = std::uint64_t{labels[0]} << 32 | labels[1];
        return numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
    };
    const auto site_of = [&](std::uint32_t vertex, std::uint32_t interface) {
        for (std::uint32_t s = found.first[vertex]; s != kNoSite; s = found.next[s])
            if (found.sites[s].interface == interface) return s;
        const auto made = static_cast<std::uint32_t>(found.sites.size());
        found.sites.push_back({positions[vertex], {}, interface, simplices[vertex].kind});
        found.next.push_back(std::exchange(found.first[vertex], made));
        return made;
    };
    for (LatticeFace face : faces) {
        if (is_exterior(face.labels[0]) || is_exterior(face.labels[1])) continue;
        if (face.labels[0] > face.labels[1]) {
            std::swap(face.labels[0], face.labels[1]);
            std::swap(face.vertices[1], face.vertices[2]);
        }
        const auto& [a, b, c] = face.vertices;
        const Vec3 normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
        const std::uint32_t interface = interface_of(face.labels);
        corners.push_back({site_of(a, interface), site_of(b, interface), site_of(c, interface)});
        for (std::uint32_t s : corners.back()) found.sites[s].normal += normal;
    }
    for (LatticeSite& site : found.sites) site.normal = unit(site.normal, {0, 0, 1});
    std::vector<Vec3> sums(found.sites.size());
    for (int pass = 0; pass < kNormalPasses; ++pass) {
        for (std::uint32_t s = 0; s < sums.size(); ++s) sums[s] = {};
        for (const auto& corner : corners) {
            const Vec3 sum =
                found.sites[corner[0]].normal + found.sites[corner[1]].normal + found.sites[corner[2]].normal;
            for (std::uint32_t s : corner) sums[s] += sum;
        }
        for (std::uint32_t s = 0; s < sums.size(); ++s) found.sites[s].normal = unit(sums[s], found.sites[s].normal);
    }
    return found;
}

}  // namespace regionmesh
