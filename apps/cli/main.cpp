#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "arguments.h"
#include "command_line.h"
#include "commands.h"
#include "messages.h"
#include "printable.h"
#include "program.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {
namespace {

/// What begins each line on standard error, and whether this process says what all others of a run would say, too.
std::string process_name = "regionmesh: ";
bool says_usage = true;

/// What helps when memory runs out: options that the command has.
const char* advice = "end other programs, or take a part of the input";

/// One line on standard error, at once where it is not very long: lines of several processes stay apart. Allocates
/// nothing and cannot fail: the exit code says the same where nobody reads it.
void complain(std::initializer_list<const char*> words) {
    std::array<char, 4096> line;
    std::size_t size = 0;
    const auto put = [&](const char* bytes, std::size_t count) {
        if (size + count > line.size()) std::fwrite(line.data(), 1, std::exchange(size, 0), stderr);
        if (count > line.size()) return static_cast<void>(std::fwrite(bytes, 1, count, stderr));
        std::copy_n(bytes, count, line.data() + size);
        size += count;
    };
    put(process_name.data(), process_name.size());
    for (const char* word : words) for_printable(word, put);
    put("\n", 1);
    std::fwrite(line.data(), 1, size, stderr);
}

void say_out_of_memory() {
    log_line("out of memory");
    complain({"out of memory; ", advice});
}

/// Libraries allocate in destructors, from which no exception can leave: memory that runs out there ends up here.
[[noreturn]] void end_without_destructors() noexcept {
    const bool is_exception = std::current_exception() != nullptr;
    try {
        if (is_exception) throw;
    } catch (const std::bad_alloc&) {
        say_out_of_memory();
        remove_outputs();
        ::_exit(kBadInput);
    } catch (...) {
    }
    remove_outputs();
    std::abort();
}

/// Runs `action` and returns its exit code, or that of what it throws.
template <class Act>
int run(const Act& action) {
    try {
        return action();
    } catch (const Error& error) {
        log_line(error.what());
        const bool is_usage = error.code() == ErrorCode::kUsage;
        if (!is_usage || says_usage) complain({error.what()});
        return is_usage ? kBadUsage : kBadInput;
    } catch (const std::bad_alloc&) {
        say_out_of_memory();
    } catch (const std::system_error& error) {
        if (std::ferror(stdout)) return kBadInput;
        const bool is_busy = error.code() == std::errc::resource_unavailable_try_again;
        complain({error.what(), is_busy
                                    ? ": a thread cannot start; end other programs, or raise the limit of processes "
                                      "(ulimit -u)"
                                    : ""});
    } catch (const std::exception& error) {
        if (std::ferror(stdout)) return kBadInput;  // a write failed: finish() says so
        complain({error.what()});
    }
    return kBadInput;
}

/// Results that could not be written are an error, whatever else was found.
int finish(int code) {
    errno = 0;
    std::cout.flush();
    const bool is_written = std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good();
    if (is_written) return code;
    complain({"standard output cannot be written", errno == 0 ? "" : ": ", errno == 0 ? "" : std::strerror(errno)});
    return kBadInput;
}

/// Opens /dev/null on the standard streams that the caller has closed, in the direction in which they fail: otherwise
/// the next file opened would get their numbers, and messages would be written into it.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            (void)!::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// A file at its limit of size and a pipe that nobody reads are errors of the write, not the end of the process.
void let_writes_fail() {
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

void add_commands(CLI::App& app, const Typed& typed, Action& action) {
    const auto run_of = [](Command command) {
        switch (command) {
            case kReconstruct:
                return run_reconstruct;
            case kDecimate:
                return run_decimate;
            case kRemesh:
                return run_remesh;
            case kSmooth:
                return run_smooth;
            case kCheck:
                return run_check;
            case kConvert:
                return run_convert;
            case kCompare:
                return run_compare;
            case kInfo:
                return run_info;
            case kVoxelise:
                return run_voxelise;
            case kView:
                break;
        }
        return run_view;
    };
    for (const CommandSpec& spec : command_table()) add_command(app, spec, run_of(spec.command), typed, action);
}

/// Options that are not in help texts: each prints docs/reference/command-line.md, the page for man(1), or a script for
/// completion, and ends.
void add_page(CLI::App& app) {
    const auto print_page = [] {
        fmt::print("{}", command_line_page());
        throw CLI::Success();
    };
    app.add_flag_callback("--help-markdown", print_page)->group("");
    const auto print_manual = [] {
        fmt::print("{}", manual_page());
        throw CLI::Success();
    };
    app.add_flag_callback("--help-man", print_manual)->group("");
    const auto print_completion = [](const std::string& shell) {
        fmt::print("{}", completion_script(shell));
        throw CLI::Success();
    };
    app.add_option_function<std::string>("--completion", print_completion)
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->group("");
}

int parse_and_run(int argc, char** argv) {
    CLI::App app("Certified multi-region surface models from labelled sections, points and tetrahedra");
    app.name("regionmesh");
    app.set_version_flag("--version", REGIONMESH_VERSION);
    app.require_subcommand(1);
    app.footer("Example: " + std::string(command_table().front().example) +
               "\nregionmesh help COMMAND, or COMMAND --help, lists the options that most runs need, with defaults and "
               "units; --help-all lists all.");
    Action action;
    std::vector<std::string> arguments = arguments_of(argc, argv);
    const auto is_config = [](const std::string& text) { return text == "--config" || text.starts_with("--config="); };
    const Typed typed{.has_config = std::ranges::any_of(arguments, is_config),
                      .wants_all = std::ranges::find(arguments, "--help-all") != arguments.end()};
    std::ranges::replace(arguments, std::string("--help-all"), std::string("--help"));
    add_commands(app, typed, action);
    add_page(app);
    const CommandSpec* const command = command_in(arguments);
    const std::string help = fmt::format("regionmesh{}{} --help", command ? " " : "", command ? command->name : "");
    try {
        std::ranges::reverse(arguments);  // as CLI11 wants them
        app.parse(arguments);
    } catch (const CLI::Success& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        const std::string unknown = unknown_word(arguments_of(argc, argv));
        if (says_usage) complain({unknown.empty() ? error.what() : unknown.c_str(), "; see ", help.c_str()});
        return kBadUsage;
    }
    if (app.got_subcommand("reconstruct")) advice = "give a smaller --memory, fewer --threads or a lower target";
    return action();
}

}  // namespace

void name_process(std::string name, bool says_all) {
    process_name = std::move(name);
    says_usage = says_all;
}

int run_program(int argc, char** argv) {
    hold_standard_streams();
    let_writes_fail();
    std::set_terminate(end_without_destructors);
    keep_large_arrays_apart();
    return finish(run([&] { return parse_and_run(argc, argv); }));
}

}  // namespace regionmesh::cli
