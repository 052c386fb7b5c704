// Resources of the process.
#pragma once

#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>

namespace regionmesh {

/// Resident size of the process, in bytes: largest so far, and now.
struct ResidentBytes {
    std::uint64_t peak = 0, now = 0;
};

/// Read from /proc on Linux: the portable count may include the size of the program that started this one, and has no
/// size of now.
inline ResidentBytes resident_bytes() {
    ResidentBytes bytes;
    std::ifstream status("/proc/self/status");
    for (std::string word; bytes.now == 0 && status >> word;) {
        std::uint64_t kibibytes = 0;
        if (word == "VmHWM:" && status >> kibibytes) bytes.peak = kibibytes * 1024;
        if (word == "VmRSS:" && status >> kibibytes) bytes.now = kibibytes * 1024;
    }
    if (bytes.peak != 0) return bytes;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    bytes.peak = bytes.now = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return bytes;
}
inline std::uint64_t peak_resident_bytes() { return resident_bytes().peak; }

/// Returns freed memory to the system, which the C library would keep. Call after large arrays were freed.
inline void give_back_freed_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

/// Makes the C library return the memory of large arrays as soon as they are freed: otherwise it raises the size from
/// which it does so, and memory fragments. For programs: call once at the start.
inline void keep_large_arrays_apart() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

/// Adds its lifetime to a sum of seconds. For reports only: no result depends on it.
class Timer {
public:
    explicit Timer(double& sum) : sum_(sum) {}
    ~Timer() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace regionmesh
