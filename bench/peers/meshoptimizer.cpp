// Simplifies a model of ours by meshoptimizer and prints the cost as JSON:
//   meshoptimizer MESH.ply TARGET_FACES [RESULT.ply]
//
// Seconds are those of the one call of meshopt_simplify, on the mesh in memory in single precision. bench/run compiles
// this file where the header is installed (libmeshoptimizer-dev).
#include <cstdlib>
#include <cstring>

#include "mesh.h"

namespace {

// The binary PLY that regionmesh writes (docs/reference/files.md), no other.
peers::Mesh read_ply(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    peers::Mesh mesh;
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

}  // namespace

int main(int count, char** words) try {
    if (count < 3) throw std::runtime_error("meshoptimizer MESH.ply TARGET_FACES [RESULT.ply]");
    peers::Mesh mesh = read_ply(words[1]);
    const std::size_t initial_faces = mesh.face_count();
    const peers::Cost cost = peers::simplify(mesh, std::strtoull(words[2], nullptr, 10));
    std::printf(
        "{\"version\": \"%s\", \"initial_faces\": %zu, \"final_faces\": %zu, \"seconds\": %.9f, "
        "\"peak_bytes\": %llu, \"error\": %g}\n",
        peers::version().c_str(), initial_faces, mesh.face_count(), cost.seconds,
        static_cast<unsigned long long>(peers::peak_bytes()), static_cast<double>(cost.error));
    if (count > 3) peers::write_ply(mesh, words[3]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
