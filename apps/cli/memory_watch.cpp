#include "memory_watch.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>

#include "commands.h"
#include "regionmesh/error.h"
#include "regionmesh/output_file.h"

namespace regionmesh::cli {
namespace {

constexpr std::chrono::microseconds kPause{250};

/// Room for what the other threads take between two looks: pages are handed out at some megabytes a millisecond.
std::uint64_t room(std::uint64_t limit) { return std::max<std::uint64_t>(limit / 32, std::uint64_t{6} << 20); }

/// In bytes; none where it cannot be read. Allocates nothing.
std::optional<std::uint64_t> resident_bytes(int statm) {
    char text[128];
    const ::ssize_t size = ::pread(statm, text, sizeof(text), 0);
    if (size <= 0) return std::nullopt;
    const char* end = text + size;
    const char* second = std::find(static_cast<const char*>(text), end, ' ');
    std::uint64_t pages = 0;
    if (second == end || std::from_chars(second + 1, end, pages).ec != std::errc{}) return std::nullopt;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

MemoryWatch::MemoryWatch(std::uint64_t limit, bool keeps)
    : limit_(limit), keeps_(keeps), statm_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)) {
    if (!resident_bytes(statm_)) {
        if (statm_ >= 0) ::close(statm_);
        throw Error(ErrorCode::kInput, "--memory-limit hard: /proc/self/statm cannot be read; use --memory-limit plan");
    }
    try {
        thread_ = std::thread([this] { watch(); });
    } catch (...) {
        ::close(statm_);
        throw;
    }
}

MemoryWatch::~MemoryWatch() {
    is_over_ = true;
    thread_.join();
    ::close(statm_);
}

/// Writes to the descriptor: another thread may hold the lock of the stream.
void MemoryWatch::watch() const {
    const std::uint64_t most = limit_ - std::min(limit_, room(limit_));
    for (; !is_over_; std::this_thread::sleep_for(kPause)) {
        const std::optional<std::uint64_t> bytes = resident_bytes(statm_);
        if (!bytes || *bytes <= most) continue;
        constexpr const char* kNothing =
            "\nregionmesh: --memory-limit hard: the run needs more than --memory, nothing was written; raise --memory, "
            "or set a lower target or fewer passes of --smooth\n";
        constexpr const char* kBlocks =
            "\nregionmesh: --memory-limit hard: the run needs more than --memory, finished blocks stay; raise --memory "
            "and go on, or give a smaller --block-size in a new folder\n";
        const bool has_progress_line = ::isatty(STDERR_FILENO) != 0;
        const char* line = (keeps_ ? kBlocks : kNothing) + (has_progress_line ? 0 : 1);
        (void)!::write(STDERR_FILENO, line, std::strlen(line));
        end_without_outputs(kBadInput);
    }
}

}  // namespace regionmesh::cli
