// --memory-limit hard: ends the program before its resident size passes a limit.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace regionmesh::cli {

/// While it lives, a thread of its own reads the resident size of the process several times a millisecond. Near the
/// limit it prints one line, removes the temporary files of all outputs and ends the process with exit code 1.
class MemoryWatch {
public:
    /// `limit` in bytes; `keeps` for runs whose finished parts stay. Throws Error(kInput) where the system does not
    /// tell the resident size (/proc/self/statm).
    explicit MemoryWatch(std::uint64_t limit, bool keeps = false);
    ~MemoryWatch();
    MemoryWatch(const MemoryWatch&) = delete;
    MemoryWatch& operator=(const MemoryWatch&) = delete;

private:
    void watch() const;

    std::uint64_t limit_;
    bool keeps_;
    int statm_;  // file descriptor
    std::atomic<bool> is_over_ = false;
    std::thread thread_;
};

}  // namespace regionmesh::cli
