#include <fmt/core.h>

#include <new>

#include "commands.h"
#include "regionmesh/formats.h"
#include "regionmesh/process.h"
#include "regionmesh/regionmesh.h"

namespace {

constexpr int kBadInput = 1;
constexpr int kUsage = 2;

int run(const regionmesh::cli::Action& action) {
    try {
        return action();
    } catch (const regionmesh::Error& error) {
        fmt::print(stderr, "regionmesh: {}\n", error.what());
        return error.code() == regionmesh::ErrorCode::kUsage ? kUsage : kBadInput;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "regionmesh: out of memory; give a smaller --memory or a lower target\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "regionmesh: {}\n", error.what());
    }
    return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
    regionmesh::keep_large_arrays_apart();
    CLI::App app("Certified multi-region surface models from labelled sections, points and tetrahedra");
    app.name("regionmesh");
    app.set_version_flag("--version", REGIONMESH_VERSION);
    app.require_subcommand(1);
    regionmesh::cli::Action action;
    regionmesh::cli::add_reconstruct(app, action);
    regionmesh::cli::add_decimate(app, action);
    regionmesh::cli::add_smooth(app, action);
    regionmesh::cli::add_check(app, action);
    regionmesh::cli::add_convert(app, action);
    regionmesh::cli::add_compare(app, action);
    regionmesh::cli::add_info(app, action);
    regionmesh::cli::add_voxelise(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "regionmesh: {}; regionmesh --help lists what there is\n", error.what());
        return kUsage;
    }
    return run(action);
}
