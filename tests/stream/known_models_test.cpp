// Models of this version, each as one number: a change of the code that changes a byte of a model changes a number
// here. Whoever means to change models writes the new numbers, and says in the change log what changed.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "regionmesh/reconstruct.h"
#include "support/digest.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

struct KnownModel {
    const char* name;
    test::ArrayVolume volume;
    ReconstructOptions options;
    std::uint64_t digest;
};

ReconstructOptions reduced_by(double share) {
    ReconstructOptions options;
    options.reduce = share;
    return options;
}

/// A ball some of whose samples beside the boundary have the other label.
test::ArrayVolume ragged_ball() {
    const test::ArrayVolume ball = test::ball_volume({32, 32, 32}, 11);
    std::vector<InputLabel> labels = ball.labels();
    for (std::size_t n = 1; n + 1 < labels.size(); ++n)
        if (ball.labels()[n - 1] != ball.labels()[n + 1] && mix64(n) % 6 == 0) labels[n] = 1 - labels[n];
    return {ball.size(), std::move(labels)};
}

std::vector<KnownModel> known_models() {
    std::vector<KnownModel> models;
    models.push_back({"ball", test::ball_volume({24, 24, 24}, 9), reduced_by(0), 8612776148871636271u});
    models.push_back({"grains", test::grain_volume({28, 28, 28}, 20, 3, 1), reduced_by(0.9), 17998744666468724555u});
    models.push_back({"noise", test::noise_volume({12, 12, 12}, 4, 5), reduced_by(0.5), 3606873273359670371u});
    models.push_back({"ragged ball", ragged_ball(), reduced_by(0.8), 11693034115909570739u});
    models.back().options.denoise = {};
    models.push_back({"flat grains", test::grain_volume({24, 24, 12}, 9, 8).spaced({1, 1, 2.5}), reduced_by(0.8),
                      13169658632361257063u});
    models.back().options.smooth_lines = models.back().options.improve = true;
    return models;
}

TEST(KnownModels, have_the_bytes_of_this_version) {
    for (KnownModel& known : known_models()) {
        const Reconstruction made = reconstruct(known.volume, known.options);
        EXPECT_EQ(test::digest(made.mesh), known.digest) << known.name << ", " << made.mesh.face_count() << " faces";
    }
}

}  // namespace
}  // namespace regionmesh
