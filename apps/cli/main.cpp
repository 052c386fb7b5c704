#include <fmt/core.h>

#include <new>

#include "command_line.h"
#include "commands.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {
namespace {

int run(const Action& action) {
    try {
        return action();
    } catch (const Error& error) {
        fmt::print(stderr, "regionmesh: {}\n", error.what());
        return error.code() == ErrorCode::kUsage ? kBadUsage : kBadInput;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "regionmesh: out of memory; give a smaller --memory or a lower target\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "regionmesh: {}\n", error.what());
    }
    return kBadInput;
}

void add_commands(CLI::App& app, Action& action) {
    // In the order of command_table().
    constexpr int (*kRuns[])(const Settings&) = {run_reconstruct, run_decimate, run_smooth, run_check,
                                                 run_convert,     run_compare,  run_info,   run_voxelise};
    for (std::size_t n = 0; n < command_table().size(); ++n) add_command(app, command_table()[n], kRuns[n], action);
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
    Action action;
    add_commands(app, action);
    add_page(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "regionmesh: {}; see regionmesh --help\n", error.what());
        return kBadUsage;
    }
    return run(action);
}

}  // namespace
}  // namespace regionmesh::cli

int main(int argc, char** argv) {
    regionmesh::keep_large_arrays_apart();
    return regionmesh::cli::parse_and_run(argc, argv);
}
