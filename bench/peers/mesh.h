// What the programs of this folder share: a mesh without labels, the call to meshoptimizer, and the PLY that regionmesh
// compare reads.
#pragma once

#include <meshoptimizer.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace peers {

inline constexpr float kNoErrorLimit = 1e9f;  // it is squared

struct Mesh {
    std::vector<float> points;            // three a vertex
    std::vector<std::uint32_t> vertices;  // three a face
    std::size_t vertex_count() const { return points.size() / 3; }
    std::size_t face_count() const { return vertices.size() / 3; }
};

struct Cost {
    double seconds = 0;
    float error = 0;
};

// meshopt_simplify as its documentation shows, no border locked, and with an error limit that never ends it.
inline Cost simplify(Mesh& mesh, std::size_t target_faces) {
    std::vector<std::uint32_t> simplified(mesh.vertices.size());
    Cost cost;
    const auto start = std::chrono::steady_clock::now();
    const std::size_t count =
        meshopt_simplify(simplified.data(), mesh.vertices.data(), mesh.vertices.size(), mesh.points.data(),
                         mesh.vertex_count(), 3 * sizeof(float), 3 * target_faces, kNoErrorLimit, 0, &cost.error);
    cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    simplified.resize(count);
    mesh.vertices.swap(simplified);
    return cost;
}

// Of this process alone; rusage would count what the process held that started it.
inline std::uint64_t peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::uint64_t kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
    return 0;
}

// All faces lie between 1 and 2.
inline void write_ply(const Mesh& mesh, const std::string& path) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(mesh.vertex_count(), kUnused), used;
    for (const std::uint32_t vertex : mesh.vertices) {
        if (number[vertex] != kUnused) continue;
        number[vertex] = static_cast<std::uint32_t>(used.size());
        used.push_back(vertex);
    }
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << used.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar node_type\nelement face "
         << mesh.face_count()
         << "\nproperty list uchar uint vertex_indices\nproperty int label_first\nproperty int label_second\n"
            "end_header\n";
    const auto put = [&](const auto& value) { file.write(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const std::uint32_t vertex : used) {
        for (int axis = 0; axis < 3; ++axis) put(static_cast<double>(mesh.points[3 * vertex + axis]));
        put(std::uint8_t{0});
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        put(std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner) put(number[mesh.vertices[3 * f + corner]]);
        put(std::int32_t{1});
        put(std::int32_t{2});
    }
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

inline std::string version() {
    return std::to_string(MESHOPTIMIZER_VERSION / 1000) + "." + std::to_string(MESHOPTIMIZER_VERSION % 1000 / 10);
}

}  // namespace peers
