#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kVolumes = 20;

/// Volumes and options that use all stages: tiles, smoothing with both kinds of filters, reading ahead.
Reconstruction run_number(std::uint32_t n) {
    const test::Size size{8 + n % 4, 7 + n % 3, 6 + n % 5};
    ReconstructOptions options{.reduce = 0.8, .background = {}};
    options.threads = 1 + n % 3;
    if (n % 4 == 1) options.smooth = {.filter = SmoothFilter::kTaubin, .passes = 10};
    if (n % 4 == 2) options.smooth.passes = 0;
    options.improve = n % 5 == 0;
    return test::run(n % 2 == 0 ? test::grain_volume(size, 6, n) : test::noise_volume(size, 3, n), options);
}

TEST(ParallelRuns, twenty_volumes_at_once_give_the_bytes_of_each_alone) {
    std::vector<std::uint64_t> alone(kVolumes), together(kVolumes);
    for (std::uint32_t n = 0; n < kVolumes; ++n) {
        const Reconstruction made = run_number(n);
        test::expect_sound(made.report.check);
        alone[n] = test::digest(made.mesh);
    }
    std::vector<std::thread> threads;
    for (std::uint32_t n = 0; n < kVolumes; ++n)
        threads.emplace_back([&, n] { together[n] = test::digest(run_number(n).mesh); });
    for (std::thread& thread : threads) thread.join();
    for (std::uint32_t n = 0; n < kVolumes; ++n) EXPECT_EQ(together[n], alone[n]) << "volume " << n;
}

}  // namespace
}  // namespace regionmesh
