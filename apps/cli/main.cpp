#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <new>

#include "command_line.h"
#include "commands.h"
#include "printable.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {
namespace {

/// One line on standard error. Allocates nothing and cannot fail: the exit code says the same where nobody reads it.
void say(std::initializer_list<const char*> words) {
    std::fputs("regionmesh: ", stderr);
    for (const char* word : words)
        for_printable(word, [](const char* bytes, std::size_t count) { std::fwrite(bytes, 1, count, stderr); });
    std::fputc('\n', stderr);
}

/// Runs `action` and returns its exit code, or that of what it throws.
template <class Act>
int run(const Act& action) {
    try {
        return action();
    } catch (const Error& error) {
        say({error.what()});
        return error.code() == ErrorCode::kUsage ? kBadUsage : kBadInput;
    } catch (const std::bad_alloc&) {
        say({"out of memory; give a smaller --memory or a lower target"});
    } catch (const std::exception& error) {
        if (std::ferror(stdout)) return kBadInput;  // a write failed: finish() says so
        say({error.what()});
    }
    return kBadInput;
}

/// Results that could not be written are an error, whatever else was found.
int finish(int code) {
    errno = 0;
    std::cout.flush();
    const bool is_written = std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good();
    if (is_written) return code;
    say({"standard output cannot be written", errno == 0 ? "" : ": ", errno == 0 ? "" : std::strerror(errno)});
    return kBadInput;
}

/// Opens /dev/null on the standard streams that the caller has closed, in the direction in which they fail: otherwise
/// the next file opened would get their numbers, and messages would be written into it.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            (void)!::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

void add_commands(CLI::App& app, Action& action) {
    // In the order of command_table().
    constexpr int (*kRuns[])(const Settings&) = {run_reconstruct, run_decimate, run_smooth, run_check,
                                                 run_convert,     run_compare,  run_info,   run_voxelise};
    for (std::size_t n = 0; n < command_table().size(); ++n) add_command(app, command_table()[n], kRuns[n], action);
}

/// A flag that is not in help texts: prints docs/reference/command-line.md and ends.
void add_page(CLI::App& app) {
    const auto print_page = [] {
        fmt::print("{}", command_line_page());
        throw CLI::Success();
    };
    app.add_flag_callback("--help-markdown", print_page)->group("");
}

int parse_and_run(int argc, char** argv) {
    CLI::App app("Certified multi-region surface models from labelled sections, points and tetrahedra");
    app.name("regionmesh");
    app.set_version_flag("--version", REGIONMESH_VERSION);
    app.require_subcommand(1);
    Action action;
    add_commands(app, action);
    add_page(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        say({error.what(), "; see regionmesh --help"});
        return kBadUsage;
    }
    return action();
}

}  // namespace
}  // namespace regionmesh::cli

int main(int argc, char** argv) {
    using namespace regionmesh::cli;
    hold_standard_streams();
    regionmesh::remove_outputs_on_signals();
    regionmesh::keep_large_arrays_apart();
    return finish(run([&] { return parse_and_run(argc, argv); }));
}
