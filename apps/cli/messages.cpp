#include "messages.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>

#include "page_output.h"
#include "printable.h"
#include "regionmesh/error.h"
#include "regionmesh/output_file.h"

namespace regionmesh::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the process: errors end up in main(), which has no settings.
struct State {
    bool is_quiet = false, is_verbose = false;
    std::FILE* log = nullptr;  // closed by the end of the process: a line is flushed as it is written
    Clock::time_point start;
    std::optional<std::string> held = {};  // lines of warnings that wait
};
State state;
std::mutex log_mutex;  // a model is written while another thread reports the check

void put_into_log(std::string_view line) {
    const std::scoped_lock lock(log_mutex);
    if (!state.log) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - state.start).count();
    std::fprintf(state.log, "%9.2f s  ", seconds);
    std::fwrite(line.data(), 1, line.size(), state.log);
    std::fputc('\n', state.log);
    if (std::fflush(state.log) == 0 && !std::ferror(state.log)) return;
    std::fputs("regionmesh: --log: the file cannot be written further\n", stderr);
    state.log = nullptr;
}

}  // namespace

void begin_messages(Command command, const Settings& settings) {
    state = {.is_quiet = settings.quiet, .is_verbose = settings.verbose, .start = Clock::now()};
    if (settings.log.empty()) return;
    require_writable(settings.log, settings.writing);
    state.log = std::fopen(settings.log.c_str(), "we");
    if (!state.log)
        throw Error(ErrorCode::kOutput, "--log " + settings.log + ": cannot be written: " + std::strerror(errno));
    put_into_log(printable(command_line_of(command, settings)));
}

void put_line(Audience audience, std::string_view line) {
    put_into_log(line);
    if (audience == Audience::kLog || state.is_quiet || (audience == Audience::kVerbose && !state.is_verbose)) return;
    fmt::print("{}\n", line);
}

void warn(std::string_view text) {
    const std::string line = fmt::format("warning: {}", printable(std::string(text)));
    put_into_log(line);
    if (state.is_quiet) return;
    const std::string shown = "regionmesh: " + line + "\n";
    if (state.held)
        *state.held += shown;
    else
        std::fputs(shown.c_str(), stderr);
}

HeldWarnings::HeldWarnings() { state.held.emplace(); }
HeldWarnings::~HeldWarnings() { state.held.reset(); }

void HeldWarnings::show() {
    if (state.held) std::fputs(state.held->c_str(), stderr);
    state.held.reset();
}

void log_line(const char* text) { put_into_log(text); }

}  // namespace regionmesh::cli
