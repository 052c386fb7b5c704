// Progress as one line on a terminal; prints nothing into a pipe.
#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"

namespace regionmesh::cli {

class ProgressLine {
public:
    explicit ProgressLine(bool is_quiet) : is_shown_(!is_quiet && isatty(STDERR_FILENO)) {}
    ~ProgressLine() { clear(); }

    void show(const Progress& progress) {
        if (!is_shown_) return;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::milliseconds(100)) return;
        last_ = now;
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        put(fmt::format("\r\033[K{}: strip {}/{}, {:.2f} M faces read ({:.0f} k/s), {:.2f} M in memory, peak {} MB",
                        progress.stage, progress.strips_read, progress.strip_count,
                        static_cast<double>(progress.faces_read) / 1e6,
                        static_cast<double>(progress.faces_read) / 1e3 / elapsed,
                        static_cast<double>(progress.faces_held) / 1e6, peak_resident_bytes() / 1000000)
                .c_str());
    }
    void clear() {
        if (is_shown_) put("\r\033[K");
    }

private:
    /// A terminal that is gone is no reason to stop.
    static void put(const char* text) { std::fputs(text, stderr); }

    bool is_shown_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace regionmesh::cli
