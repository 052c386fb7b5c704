#include "smooth_arguments.h"

#include "input_options.h"

namespace regionmesh::cli {

void SmoothArguments::add_options(CLI::App& command) {
    command.add_option("--smooth", passes, "passes of smoothing; 20 if not given, 0 for none")
        ->check(CLI::Range(0, 100000));
    command
        .add_option("--smooth-filter", filter, "taubin keeps volumes, laplacian shrinks, nifpms keeps edges (one pass)")
        ->check(CLI::IsMember({"taubin", "laplacian", "nifpms", "none"}));
    command.add_option("--smooth-lambda", lambda,
                       "share of the way to the mean of the neighbours, of taubin and laplacian");
    command.add_flag("--smooth-points", points, "let quadruple points follow their lines");
}

SmoothOptions SmoothArguments::options() const {
    SmoothOptions options;
    options.passes = filter == "none" ? 0 : passes;
    options.filter = filter == "laplacian" ? SmoothFilter::kLaplacian
                     : filter == "nifpms"  ? SmoothFilter::kNifpms
                                           : SmoothFilter::kTaubin;
    options.lambda = parse_number("--smooth-lambda", lambda);
    if (options.lambda > 1)
        throw Error(ErrorCode::kInput, "--smooth-lambda " + lambda + ": not a share of the way, such as 0.6");
    options.move_points = points;
    return options;
}

}  // namespace regionmesh::cli
