// Simplifies a model of ours by meshoptimizer and prints the cost as JSON:
//   meshoptimizer MESH.ply TARGET_FACES [RESULT.ply]
//
// Seconds are those of the one call of meshopt_simplify, on the mesh in memory in single precision. It is called as its
// documentation shows, no border locked, and with an error limit that never ends it. bench/run compiles this file where
// the header is installed (libmeshoptimizer-dev). The result has no labels of its own: all faces lie between 1 and 2.
#include <meshoptimizer.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr float kNoErrorLimit = 1e9f;  // it is squared

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

// The binary PLY that regionmesh writes (docs/files.md), no other.
Mesh read_ply(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    Mesh mesh;
    std::size_t face_bytes = 0;  // of its labels and colours
    for (std::string line; std::getline(file, line) && line != "end_header";) {
        if (line.starts_with("element vertex ")) mesh.points.resize(3 * std::stoull(line.substr(15)));
        if (line.starts_with("element face ")) mesh.vertices.resize(3 * std::stoull(line.substr(13)));
        if (line.starts_with("property int label_")) face_bytes += 4;
        if (face_bytes > 0 && line.starts_with("property uchar ")) face_bytes += 1;
    }
    if (!file || face_bytes == 0) throw std::runtime_error(path + " is no PLY file of regionmesh");
    char bytes[64];
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        double point[3];
        file.read(bytes, sizeof point + 1);
        std::memcpy(point, bytes, sizeof point);
        for (int axis = 0; axis < 3; ++axis) mesh.points[3 * v + axis] = static_cast<float>(point[axis]);
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        file.read(bytes, static_cast<std::streamsize>(1 + 3 * sizeof(std::uint32_t) + face_bytes));
        std::memcpy(&mesh.vertices[3 * f], bytes + 1, 3 * sizeof(std::uint32_t));
    }
    if (!file) throw std::runtime_error(path + " cannot be read to its end");
    return mesh;
}

Cost simplify(Mesh& mesh, std::size_t target_faces) {
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
std::uint64_t peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::uint64_t kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
    return 0;
}

void write_ply(const Mesh& mesh, const std::string& path) {
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

}  // namespace

int main(int count, char** words) try {
    if (count < 3) throw std::runtime_error("meshoptimizer MESH.ply TARGET_FACES [RESULT.ply]");
    Mesh mesh = read_ply(words[1]);
    const std::size_t initial_faces = mesh.face_count();
    const Cost cost = simplify(mesh, std::strtoull(words[2], nullptr, 10));
    std::printf(
        "{\"version\": \"%d.%d\", \"initial_faces\": %zu, \"final_faces\": %zu, \"seconds\": %.9f, "
        "\"peak_bytes\": %llu, \"error\": %g}\n",
        MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION % 1000 / 10, initial_faces, mesh.face_count(), cost.seconds,
        static_cast<unsigned long long>(peak_bytes()), static_cast<double>(cost.error));
    if (count > 3) write_ply(mesh, words[3]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
