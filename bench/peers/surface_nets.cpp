// Surface nets (Gibson 1998) of a labelled volume, smoothed, then simplified by meshoptimizer; prints the cost as JSON:
//   surface_nets VOLUME.npy TARGET_FACES [PREFIX]
//
// A vertex in each cell of eight samples with two labels or more, two faces across each pair of neighbouring samples
// whose labels differ, so that each interface is there once; 16 rounds of relaxation by a half, each vertex held in its
// cell. No faces on the sides of the box. Seconds are those of nets, smoothing and simplification, from labels in
// memory, on one thread. With PREFIX, writes PREFIX-full.ply and PREFIX-reduced.ply for regionmesh compare. Exit code
// 3: this kind of file is not read here. bench/run compiles this file where libmeshoptimizer-dev is installed.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "mesh.h"

namespace {

constexpr int kRounds = 16, kCannotRead = 3;
constexpr float kRelaxation = 0.5f, kReach = 0.5f;

struct Volume {
    std::array<std::size_t, 3> size{};  // x, y, z
    std::vector<std::int64_t> labels;
    std::size_t at(std::size_t x, std::size_t y, std::size_t z) const { return (z * size[1] + y) * size[0] + x; }
};

template <class T>
void read_labels(std::ifstream& file, std::vector<std::int64_t>& labels) {
    std::vector<T> row(labels.size());
    file.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(T)));
    std::copy(row.begin(), row.end(), labels.begin());
}

// A .npy of three axes in C order.
Volume read_npy(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    char head[10];
    file.read(head, sizeof head);
    if (!file || std::memcmp(head, "\x93NUMPY\x01", 7) != 0) std::exit(kCannotRead);
    std::string text(static_cast<unsigned char>(head[8]) + 256u * static_cast<unsigned char>(head[9]), ' ');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    Volume volume;
    if (text.find("'fortran_order': False") == std::string::npos ||
        std::sscanf(text.c_str() + text.find('('), "(%zu, %zu, %zu)", &volume.size[2], &volume.size[1],
                    &volume.size[0]) != 3)
        std::exit(kCannotRead);
    volume.labels.resize(volume.size[0] * volume.size[1] * volume.size[2]);
    const std::string type = text.substr(text.find("'descr': '") + 11, 2);
    if (type == "u1")
        read_labels<std::uint8_t>(file, volume.labels);
    else if (type == "i1")
        read_labels<std::int8_t>(file, volume.labels);
    else if (type == "u2")
        read_labels<std::uint16_t>(file, volume.labels);
    else if (type == "i2")
        read_labels<std::int16_t>(file, volume.labels);
    else if (type == "u4")
        read_labels<std::uint32_t>(file, volume.labels);
    else if (type == "i4")
        read_labels<std::int32_t>(file, volume.labels);
    else if (type == "u8" || type == "i8")
        read_labels<std::int64_t>(file, volume.labels);
    else
        std::exit(kCannotRead);
    if (!file) throw std::runtime_error(path + " cannot be read to its end");
    return volume;
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class SurfaceNets {
public:
    explicit SurfaceNets(const Volume& volume) : volume_(volume) {
        for (int axis = 0; axis < 3; ++axis) cells_[axis] = volume.size[axis] - 1;
        make_vertices();
        for (int axis = 0; axis < 3; ++axis) cross(axis);
    }
    void relax() {
        const std::vector<float> start = mesh_.points;
        std::vector<float> sums(start.size());
        std::vector<std::uint32_t> counts(start.size() / 3);
        for (int round = 0; round < kRounds; ++round) {
            std::fill(sums.begin(), sums.end(), 0.0f);
            std::fill(counts.begin(), counts.end(), 0u);
            for (const auto& [a, b] : edges_) {
                ++counts[a], ++counts[b];
                for (int axis = 0; axis < 3; ++axis) {
                    sums[3 * a + axis] += mesh_.points[3 * b + axis];
                    sums[3 * b + axis] += mesh_.points[3 * a + axis];
                }
            }
            for (std::size_t n = 0; n < sums.size(); ++n) {
                if (counts[n / 3] == 0) continue;
                float& x = mesh_.points[n];
                const float mean = sums[n] / static_cast<float>(counts[n / 3]);
                x = std::clamp(x + kRelaxation * (mean - x), start[n] - kReach, start[n] + kReach);
            }
        }
    }
    peers::Mesh& mesh() { return mesh_; }

private:
    std::size_t cell(const std::array<std::size_t, 3>& c) const { return (c[2] * cells_[1] + c[1]) * cells_[0] + c[0]; }

    void make_vertices() {
        number_.assign(cells_[0] * cells_[1] * cells_[2], kNone);
        const auto& labels = volume_.labels;
        const std::size_t dy = volume_.size[0], dz = dy * volume_.size[1];
        std::uint32_t count = 0;
        for (std::size_t z = 0; z < cells_[2]; ++z)
            for (std::size_t y = 0; y < cells_[1]; ++y)
                for (std::size_t x = 0; x < cells_[0]; ++x) {
                    const std::size_t s = volume_.at(x, y, z);
                    const std::int64_t first = labels[s];
                    bool is_mixed = false;
                    for (const std::size_t step : {std::size_t{1}, dy, dy + 1, dz, dz + 1, dz + dy, dz + dy + 1})
                        is_mixed |= labels[s + step] != first;
                    if (!is_mixed) continue;
                    number_[cell({x, y, z})] = count++;
                    for (const std::size_t c : {x, y, z}) mesh_.points.push_back(static_cast<float>(c) + 0.5f);
                }
    }

    // Two faces for each pair of samples along the axis whose labels differ, where all four cells round it are there;
    // edges from each of their cells to the next, along the other axes, each once.
    void cross(int axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::size_t, 3> at{}, step{};
        step[axis] = 1;
        for (at[2] = 0; at[2] + step[2] < volume_.size[2]; ++at[2])
            for (at[1] = 0; at[1] + step[1] < volume_.size[1]; ++at[1])
                for (at[0] = 0; at[0] + step[0] < volume_.size[0]; ++at[0]) {
                    const std::size_t s = volume_.at(at[0], at[1], at[2]);
                    if (volume_.labels[s] ==
                        volume_.labels[volume_.at(at[0] + step[0], at[1] + step[1], at[2] + step[2])])
                        continue;
                    if (at[u] == 0 || at[v] == 0 || at[u] == cells_[u] || at[v] == cells_[v]) continue;
                    add_faces(at, u, v);
                }
        // Cells that share a side with two labels are neighbours.
        std::array<std::size_t, 3> c{};
        for (c[2] = 0; c[2] + step[2] < cells_[2]; ++c[2])
            for (c[1] = 0; c[1] + step[1] < cells_[1]; ++c[1])
                for (c[0] = 0; c[0] + step[0] < cells_[0]; ++c[0]) {
                    const std::uint32_t low = number_[cell(c)];
                    if (low == kNone) continue;
                    std::array<std::size_t, 3> next = c;
                    ++next[axis];
                    if (number_[cell(next)] != kNone && is_side_mixed(next, u, v))
                        edges_.push_back({low, number_[cell(next)]});
                }
    }

    // The side of a cell at its low end of the third axis.
    bool is_side_mixed(std::array<std::size_t, 3> c, int u, int v) const {
        const auto label = [&](std::size_t du, std::size_t dv) {
            std::array<std::size_t, 3> s = c;
            s[u] += du, s[v] += dv;
            return volume_.labels[volume_.at(s[0], s[1], s[2])];
        };
        const std::int64_t first = label(0, 0);
        return label(1, 0) != first || label(0, 1) != first || label(1, 1) != first;
    }

    void add_faces(std::array<std::size_t, 3> at, int u, int v) {
        const auto number = [&](std::size_t du, std::size_t dv) {
            std::array<std::size_t, 3> c = at;
            c[u] -= du, c[v] -= dv;
            return number_[cell(c)];
        };
        const std::uint32_t a = number(1, 1), b = number(0, 1), c = number(0, 0), d = number(1, 0);
        for (const std::uint32_t vertex : {a, b, c, a, c, d}) mesh_.vertices.push_back(vertex);
    }

    const Volume& volume_;
    std::array<std::size_t, 3> cells_{};
    std::vector<std::uint32_t> number_;  // of the vertex of a cell
    std::vector<std::array<std::uint32_t, 2>> edges_;
    peers::Mesh mesh_;
};

}  // namespace

int main(int count, char** words) try {
    if (count < 3) throw std::runtime_error("surface_nets VOLUME.npy TARGET_FACES [PREFIX]");
    const Volume volume = read_npy(words[1]);
    const auto start = std::chrono::steady_clock::now();
    SurfaceNets nets(volume);
    nets.relax();
    const double nets_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    peers::Mesh& mesh = nets.mesh();
    const std::size_t initial_faces = mesh.face_count();
    if (count > 3) peers::write_ply(mesh, words[3] + std::string("-full.ply"));
    const peers::Cost cost = peers::simplify(mesh, std::strtoull(words[2], nullptr, 10));
    std::printf(
        "{\"version\": \"%s\", \"initial_faces\": %zu, \"final_faces\": %zu, \"seconds\": %.9f, "
        "\"nets_seconds\": %.9f, \"peak_bytes\": %llu}\n",
        peers::version().c_str(), initial_faces, mesh.face_count(), nets_seconds + cost.seconds, nets_seconds,
        static_cast<unsigned long long>(peers::peak_bytes()));
    if (count > 3) peers::write_ply(mesh, words[3] + std::string("-reduced.ply"));
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
