// A volume that is larger than --memory, from end to end: bricks of labels are written section by section, modelled
// under --memory and checked. It demands exit code 0, no violation, every sample in its region, and a peak of the
// process (wait4) within --memory.
// Usage: regionmesh_large [--size SAMPLES] [--brick SAMPLES] [--memory BYTES] [--target FACES]
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace regionmesh::large {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Arguments {
    std::uint64_t size = 1500, brick = 500, memory = std::uint64_t{1} << 30, target = 1'000'000;
};

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Rows of bricks along z. Each is shifted by another part of a brick, so that no section holds all walls, and begins
/// and ends with background, so that the first and the last section have no faces.
class Bricks {
public:
    explicit Bricks(const Arguments& arguments)
        : size_(arguments.size), brick_(arguments.brick), rows_((size_ + brick_ - 1) / brick_) {}

    std::uint8_t label(std::uint64_t x, std::uint64_t y, std::uint64_t z) const {
        const std::uint64_t row = x / brick_ + y / brick_ * rows_, shift = row * brick_ / (rows_ * rows_);
        const std::uint64_t place = (z + shift) / brick_;
        if (place == 0 || place + 1 >= rows_) return 0;
        return static_cast<std::uint8_t>(1 + (row * rows_ + place) * 2654435761 % 251);
    }

private:
    std::uint64_t size_, brick_, rows_;
};

void write_bricks(const fs::path& path, const Arguments& arguments) {
    const std::uint64_t size = arguments.size, brick = arguments.brick;
    const Bricks bricks(arguments);
    const std::string extent = std::to_string(size);
    std::string header =
        "{'descr': '|u1', 'fortran_order': False, 'shape': (" + extent + ", " + extent + ", " + extent + "), }";
    header.resize(117, ' ');
    header += '\n';
    std::ofstream file(path, std::ios::binary);
    file << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size()) << '\0' << header;
    std::vector<char> section(size * size);
    for (std::uint64_t z = 0; z < size; ++z) {
        for (std::uint64_t y = 0; y < size; ++y)
            for (std::uint64_t x = 0; x < size; x += brick)
                std::memset(&section[y * size + x], bricks.label(x, y, z), std::min(brick, size - x));
        file.write(section.data(), static_cast<std::streamsize>(section.size()));
    }
    file.close();
    if (file) return;
    std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
    std::exit(1);
}

int run(const Arguments& arguments, const fs::path& folder) {
    const auto begin = Clock::now();
    write_bricks(folder / "v.npy", arguments);
    const double written = seconds_since(begin);
    std::vector<std::string> words{REGIONMESH_PROGRAM,
                                   "reconstruct",
                                   folder / "v.npy",
                                   "-o",
                                   folder / "m.vtp",
                                   "--smooth",
                                   "light",
                                   "--report",
                                   folder / "r.json",
                                   "--target-faces",
                                   std::to_string(arguments.target),
                                   "--memory",
                                   std::to_string(arguments.memory)};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const auto start = Clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
        ::execv(REGIONMESH_PROGRAM, pointers.data());
        ::_exit(98);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    const double seconds = seconds_since(start), peak = static_cast<double>(usage.ru_maxrss) * 1024;
    const auto processor = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code != 0) {
        std::printf("FAILED: exit code %d\n", code);
        return 1;
    }
    std::ifstream file(folder / "r.json");
    const nlohmann::json report = nlohmann::json::parse(file);
    std::uint64_t violations = 0;
    for (const auto& [kind, count] : report.at("violation_counts").items()) violations += count.get<std::uint64_t>();
    const auto samples = report.at("samples").get<std::uint64_t>(),
               wrong = report.at("samples_wrong").get<std::uint64_t>();
    std::printf(
        "%llu^3 bricks of %llu, written in %.0f s: %llu faces of %llu in %.0f s (%.0f s of processor), peak %.0f MB of "
        "%.0f MB, %llu violations, %llu of %llu samples wrong\n",
        static_cast<unsigned long long>(arguments.size), static_cast<unsigned long long>(arguments.brick), written,
        report.at("final_faces").get<unsigned long long>(), report.at("initial_faces").get<unsigned long long>(),
        seconds, processor, peak / 1e6, static_cast<double>(arguments.memory) / 1e6,
        static_cast<unsigned long long>(violations), static_cast<unsigned long long>(wrong),
        static_cast<unsigned long long>(samples));
    const bool is_whole = samples == arguments.size * arguments.size * arguments.size;
    const bool is_good = violations == 0 && wrong == 0 && is_whole && peak <= static_cast<double>(arguments.memory);
    if (!is_good) std::printf("FAILED\n");
    return is_good ? 0 : 1;
}

}  // namespace
}  // namespace regionmesh::large

int main(int count, char** words) {
    using namespace regionmesh::large;
    Arguments arguments;
    for (int n = 1; n + 1 < count; n += 2) {
        const std::string flag = words[n];
        const std::uint64_t value = std::strtoull(words[n + 1], nullptr, 10);
        if (flag == "--size") arguments.size = value;
        if (flag == "--brick") arguments.brick = value;
        if (flag == "--memory") arguments.memory = value;
        if (flag == "--target") arguments.target = value;
    }
    std::string folder = (fs::temp_directory_path() / "regionmesh-large-XXXXXX").string();
    if (!::mkdtemp(folder.data())) return 1;
    const int code = run(arguments, folder);
    fs::remove_all(folder);
    return code;
}
