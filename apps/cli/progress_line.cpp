#include "progress_line.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "messages.h"
#include "regionmesh/process.h"

namespace regionmesh::cli {
namespace {

constexpr double kFirstEstimate = 2;  // seconds
constexpr double kLeastShare = 0.02;

/// A terminal that is gone is no reason to stop.
void put(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

std::string rough_time(double seconds) {
    if (seconds < 10) return fmt::format("about {:.0f} s", std::max(std::ceil(seconds), 1.0));
    if (seconds < 100) return fmt::format("about {:.0f} s", 5 * std::ceil(seconds / 5));
    if (seconds < 100 * 60) return fmt::format("about {:.0f} min", std::ceil(seconds / 60));
    return fmt::format("about {:.0f} h", std::ceil(seconds / 3600));
}

std::string progress_bar(double share) {
    constexpr std::size_t kCells = 20;
    const auto full = static_cast<std::size_t>(kCells * std::clamp(share, 0.0, 1.0));
    return '[' + std::string(full, '#') + std::string(kCells - full, '.') + "] ";
}

std::string progress_text(const Progress& progress, double elapsed) {
    const double share = std::clamp(progress.share, 0.0, 0.99);  // 100 % is when the files are written
    std::string text = fmt::format("{}: {:.0f} %", progress.stage, std::floor(100 * share));
    if (elapsed >= kFirstEstimate && share >= kLeastShare)
        text += fmt::format(", {} left", rough_time(elapsed / share * (1 - share)));
    return text + fmt::format("; {:.2f} M faces in memory, peak {} MB", static_cast<double>(progress.faces_held) / 1e6,
                              peak_resident_bytes() / 1000000);
}

ProgressLine::ProgressLine(bool is_quiet) : is_shown_(!is_quiet && isatty(STDERR_FILENO)) {}

void ProgressLine::show(const Progress& progress) {
    const auto now = Clock::now();
    const bool is_new = stage_ != progress.stage;
    if (!is_new && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    const std::string text = progress_text(progress, std::chrono::duration<double>(now - start_).count());
    if (is_new) put_line(Audience::kLog, text);
    stage_ = progress.stage;
    if (is_shown_) put("\r\033[K" + progress_bar(progress.share) + text);
}

void ProgressLine::clear() {
    if (is_shown_) put("\r\033[K");
}

}  // namespace regionmesh::cli
