// What a command says: on standard output, and in the file of --log.
#pragma once

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Follows --quiet and --verbose from here on, and begins the file of --log with the command line. Throws
/// Error(kOutput) where the file cannot be written, or is read-only without --force. The log is written in place, so
/// that it can be read while the run goes on.
void begin_messages(Command command, const Settings& settings);

/// Who gets a line. Those for --verbose, and all with --quiet, go into the log only, where they are not shown.
enum class Audience { kAll, kVerbose, kLog };

/// Says one line; a newline is added. A log that cannot be written is said once on standard error, and does not end the
/// run.
void put_line(Audience audience, std::string_view line);

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
    put_line(Audience::kAll, fmt::format(format, std::forward<T>(values)...));
}
template <class... T>
void say_more(fmt::format_string<T...> format, T&&... values) {
    put_line(Audience::kVerbose, fmt::format(format, std::forward<T>(values)...));
}

/// A warning on standard error and in the log; not on standard error with --quiet.
void warn(std::string_view text);

/// Warnings while it lives wait for show(), but in the log: a run that is refused says that alone.
class HeldWarnings {
public:
    HeldWarnings();
    ~HeldWarnings();  // those that were not shown are forgotten
    HeldWarnings(const HeldWarnings&) = delete;
    HeldWarnings& operator=(const HeldWarnings&) = delete;

    /// Shows all; later ones do not wait.
    void show();
};

/// One line for the log alone, where there is one. Allocates nothing.
void log_line(const char* text);

}  // namespace regionmesh::cli
