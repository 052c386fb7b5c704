// Resources of the process.
#pragma once

#include <sys/resource.h>

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

/// How much memory there is beyond what the work that follows needs.
enum class MemoryRoom { kShort, kSome, kAmple };

/// For the whole process; kAmple at first. With more room there are fewer page faults, each of which takes
/// microseconds: freed memory is kept for the next arrays, and large arrays are put on huge pages, which may waste 2
/// MiB each. `later`: bytes that the process will hold at some time in any case; returning freed memory while it holds
/// less would not lower its peak. No result depends on either. Returns freed memory to the system, as the next
/// function.
void note_memory_room(MemoryRoom room, std::uint64_t later = 0);

/// Returns freed memory to the system, which the C library would keep. Unless memory is short, it does so only where
/// the process holds what it will hold later in any case, and has grown beyond its largest size after an earlier call
/// in the same room. Call after large arrays were freed.
void give_back_freed_memory();

/// Makes the C library return the memory of large arrays as soon as they are freed, since memory fragments otherwise,
/// and keep that of small ones for the next. For programs: call once at the start.
void keep_large_arrays_apart();

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
