// Progress as one line on a terminal, and as a line for each stage in the log.
#pragma once

#include <chrono>
#include <string>

#include "regionmesh/reconstruct.h"

namespace regionmesh::cli {

/// "[#####...............] ": a quarter.
std::string progress_bar(double share);

/// "decimate: 63 %, about 40 s left; 1.20 M faces in memory, peak 309 MB". The time is left out in the first seconds,
/// which say little about the rest.
std::string progress_text(const Progress& progress, double elapsed);

/// "about 40 s", "about 3 min", "about 2 h": of a time in seconds.
std::string rough_time(double seconds);

/// Prints nothing into a pipe.
class ProgressLine {
public:
    explicit ProgressLine(bool is_quiet);
    ~ProgressLine() { clear(); }

    void show(const Progress& progress);
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    bool is_shown_;
    Clock::time_point start_ = Clock::now(), last_{};
    std::string stage_;
};

}  // namespace regionmesh::cli
