// What the process has used.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <cstdint>

namespace regionmesh {

/// Largest resident size so far, in bytes.
inline std::uint64_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Adds the time from its construction to its end to a sum of seconds. For reports only: no result depends on it.
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
