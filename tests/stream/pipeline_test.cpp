#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "regionmesh/regionmesh.h"
#include "stream/footprint.h"
#include "support/digest.h"
#include "support/random.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::reduced;
using test::run;
using testing::HasSubstr;

std::map<InputLabel, RegionReport> regions_of(const Reconstruction& made) {
    std::map<InputLabel, RegionReport> regions;
    for (const RegionReport& region : made.report.check.regions) regions[made.labels.input(region.label)] = region;
    return regions;
}

std::string refusal(test::ArrayVolume volume, const ReconstructOptions& options = {}) {
    try {
        run(volume, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(Reconstruct, noise_of_2_4_and_256_labels_goes_down_by_90_percent_and_stays_sound) {
    for (std::uint32_t labels : {2, 4, 256})
        for (std::uint64_t seed : {1, 2}) {
            SCOPED_TRACE(std::to_string(labels) + " labels, seed " + std::to_string(seed));
            const Reconstruction made = run(test::noise_volume({14, 13, 12}, labels, seed), reduced(0.9));
            test::expect_sound(made.report.check);
            EXPECT_LT(made.report.final_faces, made.report.initial_faces);
            EXPECT_GE(made.report.check.quality.min, 0.1);
        }
}

TEST(Reconstruct, no_vertex_leaves_the_box_where_background_leaves_it_open) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::Random random(seed);
        const auto side = [&] { return 3 + random.below(6); };
        const test::Size size{side(), side(), side()};
        const Reconstruction made =
            run(test::noise_volume(size, 2, seed), {.reduce = 0.7 + 0.3 * random.unit(), .background = {0}});
        const Box box = Lattice{.size = size}.extent();
        test::for_vertices(made.mesh, [&](VertexId v) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(made.mesh.position(v)[axis], box.low[axis]) << seed;
                EXPECT_LE(made.mesh.position(v)[axis], box.high[axis]) << seed;
            }
        });
        EXPECT_EQ(made.report.samples->wrong, 0u) << seed;
    }
}

TEST(Reconstruct, readers_begin_at_their_first_section_again) {
    test::ArrayVolume volume = test::grain_volume({12, 13, 14}, 6, 3);
    const std::uint64_t digest = test::digest(run(volume, reduced(0.5)).mesh);
    std::vector<InputLabel> section(12 * 13);
    for (int read : {0, 1, 7}) {
        volume.rewind();
        for (int n = 0; n < read; ++n) ASSERT_TRUE(volume.next(section));
        const Reconstruction made = reconstruct(volume, reduced(0.5));
        test::expect_sound(made.report.check);
        EXPECT_EQ(test::digest(made.mesh), digest);
        EXPECT_EQ(made.report.samples.value().samples, 12u * 13 * 14);
    }
}

/// Says that it has one section more than it has.
class ShortVolume : public test::ArrayVolume {
public:
    using ArrayVolume::ArrayVolume;
    explicit ShortVolume(test::ArrayVolume volume) : ArrayVolume(std::move(volume)), size_(size()[2]) {
        ++lattice().size[2];
    }
    bool next(std::span<InputLabel>) override { return read_++ < size_; }
    void rewind() override { read_ = 0; }

private:
    std::uint32_t size_, read_ = 0;
};

TEST(Reconstruct, a_reader_that_ends_early_is_refused) {
    const auto refusal = [](SectionReader& volume, const ReconstructOptions& options = {}) {
        try {
            reconstruct(volume, options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("a cut volume was taken for whole");
    };
    const auto missing = HasSubstr("section 6 is missing; 7 sections were announced");
    ShortVolume volume(test::solid_volume({4, 5, 6}));
    EXPECT_THAT(refusal(volume), missing);
    ReconstructOptions cleaned;
    cleaned.room = 1;
    EXPECT_THAT(refusal(volume, cleaned), missing);
    const auto halved = select_sections(std::make_unique<ShortVolume>(volume), {.downsample = {1, 1, 2}});
    EXPECT_THAT(refusal(*halved), missing);
}

TEST(Reconstruct, options_out_of_range_are_refused) {
    const auto refused = [](auto change) {
        ReconstructOptions options;
        change(options);
        try {
            run(test::solid_volume({4, 4, 4}), options);
        } catch (const Error& error) {
            return error.code() == ErrorCode::kUsage;
        }
        return false;
    };
    for (const double bad : {std::nan(""), -1.0, HUGE_VAL}) {
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.room = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.reduce = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.perturbation = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.promises.min_quality = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.smooth.reach = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.smooth.nifpms_reach = bad; })) << bad;
        EXPECT_TRUE(refused([&](ReconstructOptions& o) { o.smooth.nifpms_bound = bad; })) << bad;
    }
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.promises.max_error = std::nan(""); }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.smooth.reach = 3; }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.smooth.passes = kMostSmoothPasses + 1; }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.smooth.filter = SmoothFilter(9); }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.cells = CellKind(77); }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.placement = PlacementKind(-1); }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.strips_per_chunk = 0; }));
    EXPECT_TRUE(refused([](ReconstructOptions& o) { o.scale_z = std::nan(""); }));
}

TEST(Reconstruct, options_of_its_steps_out_of_range_are_refused) {
    Mesh mesh = run(test::ball_volume({9, 9, 9}, 3)).mesh;
    for (const double bad : {std::nan(""), -1.0}) {
        SCOPED_TRACE(bad);
        const Lattice lattice{.size = {9, 9, 9}, .spacing = {bad, 1, 1}};
        EXPECT_THROW(simplify(mesh, {.promises = {.max_error = bad}}), Error);
        EXPECT_THROW(simplify(mesh, {.promises = {.min_quality = bad}}), Error);
        EXPECT_THROW(simplify(mesh, {.promises = {.scale = bad}}), Error);
        EXPECT_THROW(simplify(mesh, {.promises = {.samples = lattice}}), Error);
        EXPECT_THROW(improve(mesh, {.promises = {.min_quality = bad}}), Error);
        EXPECT_THROW(improve(mesh, {.promises = {.scale = bad}}), Error);
        EXPECT_THROW(improve(mesh, {.tolerance = bad}), Error);
        EXPECT_THROW(improve(mesh, {.promises = {.max_error = bad}}), Error);
        EXPECT_THROW(improve(mesh, {.promises = {.scale_z = bad}}), Error);
        EXPECT_THROW(improve(mesh, {.promises = {.samples = lattice}}), Error);
        EXPECT_THROW(smooth_lines(mesh, {.promises = {.min_quality = bad}}), Error);
        EXPECT_THROW(smooth_lines(mesh, {.promises = {.scale = bad}}), Error);
        EXPECT_THROW(smooth_lines(mesh, {.promises = {.max_error = bad}}), Error);
        EXPECT_THROW(smooth_lines(mesh, {.promises = {.scale_z = bad}}), Error);
        EXPECT_THROW(smooth_lines(mesh, {.promises = {.samples = lattice}}), Error);
        EXPECT_THROW(smooth(mesh, {.nifpms_reach = bad}), Error);
        EXPECT_THROW(smooth(mesh, {.lambda = bad}), Error);
        EXPECT_THROW(preserve_volumes(mesh, {}, {.scale = bad}), Error);
    }
    EXPECT_THROW(preserve_volumes(mesh, {1.0, std::nan("")}, {}), Error);
    EXPECT_EQ(mesh.face_count(), run(test::ball_volume({9, 9, 9}, 3)).mesh.face_count());
}

TEST(Reconstruct, all_steps_take_the_largest_quality) {
    ReconstructOptions options = reduced(0.5);
    options.promises.min_quality = 0.26;
    options.preserve_volume = options.improve = true;
    EXPECT_EQ(run(test::ball_volume({9, 9, 9}, 3), options).report.check.violation_count(), 0u);
}

/// Asks for a stop once so many sections were read.
class StoppingReader final : public SectionReader {
public:
    StoppingReader(SectionReader& reader, std::uint32_t last) : reader_(reader), last_(last) {}
    const VolumeInfo& info() const override { return reader_.info(); }
    bool next(std::span<InputLabel> section) override {
        if (++read >= last_) stop = true;
        return reader_.next(section);
    }
    void rewind() override { reader_.rewind(); }

    std::atomic<bool> stop = false;
    std::atomic<std::uint32_t> read = 0;

private:
    SectionReader& reader_;
    std::uint32_t last_;
};

TEST(Reconstruct, a_request_to_stop_is_seen_while_sections_are_counted_and_meshed) {
    constexpr std::uint32_t kSections = 200;
    for (const std::uint32_t threads : {1u, 2u})
        for (const std::uint32_t last : {5u, kSections + 5}) {
            auto volume = test::ball_volume({9, 9, kSections}, 3);
            StoppingReader reader(volume, last);
            const StopScope scope(reader.stop);
            EXPECT_THROW(reconstruct(reader, {.threads = threads}), Stopped);
            EXPECT_LE(reader.read, last + 5) << threads << " threads";
        }
}

TEST(Reconstruct, progress_goes_on_while_sections_are_counted) {
    auto volume = test::ball_volume({9, 9, 30}, 3);
    std::vector<double> shares;
    reconstruct(volume, {}, [&](const Progress& progress) {
        if (std::string(progress.stage) == "count") shares.push_back(progress.share);
    });
    EXPECT_GE(shares.size(), 20u);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
}

TEST(Reconstruct, grains_go_down_by_90_percent) {
    const Reconstruction made = run(test::grain_volume({24, 24, 24}, 12, 3), reduced(0.9));
    test::expect_sound(made.report.check);
    EXPECT_LE(made.report.final_faces, made.report.initial_faces / 10 + 1);
    EXPECT_EQ(made.report.stopped, StopReason::kTarget);
    EXPECT_EQ(made.mesh.face_count(), made.report.final_faces);
    EXPECT_EQ(made.mesh.vertex_count(), made.report.final_vertices);
}

TEST(Reconstruct, region_volumes_change_little) {
    test::ArrayVolume volume = test::grain_volume({24, 24, 24}, 6, 3);
    const auto before = regions_of(run(volume)), after = regions_of(run(volume, reduced(0.9)));
    ASSERT_EQ(before.size(), after.size());
    for (const auto& [label, region] : before) EXPECT_NEAR(after.at(label).volume, region.volume, 0.03 * region.volume);
}

TEST(Reconstruct, the_smallest_volume_is_one_cell) {
    const Reconstruction made = run(test::TextVolume({{"12", "34"}, {"56", "78"}}), reduced(0.9));
    test::expect_sound(made.report.check);
    EXPECT_EQ(regions_of(made).size(), 8u);
}

TEST(Reconstruct, a_volume_with_one_sample_along_an_axis_is_refused) {
    EXPECT_THAT(refusal(test::solid_volume({1, 3, 3})), HasSubstr("along x"));
    EXPECT_THAT(refusal(test::solid_volume({3, 1, 3})), HasSubstr("along y"));
    EXPECT_THAT(refusal(test::solid_volume({3, 3, 1})), HasSubstr("along z"));
}

TEST(Reconstruct, too_little_memory_is_refused) {
    EXPECT_THAT(refusal(test::solid_volume({3, 3, 3}), {.memory = 1000}), HasSubstr("--memory"));
}

TEST(Reconstruct, one_region_may_touch_all_sides) {
    test::ArrayVolume volume = test::ball_volume({13, 13, 13}, 3);
    const Reconstruction made = run(volume, reduced(0.8));
    test::expect_sound(made.report.check);
    EXPECT_EQ(regions_of(made).at(0).components, 2u);
    EXPECT_EQ(regions_of(made).at(0).euler, 4);
}

TEST(Reconstruct, background_is_left_out) {
    const Reconstruction made = run(test::ball_volume({13, 13, 13}, 3), {.reduce = 0.8});
    test::expect_sound(made.report.check);
    EXPECT_EQ(regions_of(made).size(), 1u);
    EXPECT_EQ(regions_of(made).at(1).euler, 2);
    test::for_vertices(made.mesh, [&](VertexId v) { EXPECT_EQ(made.mesh[v].sides, 0); });
}

TEST(Reconstruct, several_backgrounds_are_left_out) {
    const ReconstructOptions options{.reduce = 0.8, .background = {0, 2, 77}};
    const Reconstruction made = run(test::grain_volume({14, 14, 14}, 6, 4), options);
    test::expect_sound(made.report.check);
    EXPECT_EQ(regions_of(made).size(), 4u);
    EXPECT_EQ(made.background.size(), 3u);
}

TEST(Reconstruct, nothing_but_background_is_an_empty_model) {
    for (const ReconstructOptions& options :
         {ReconstructOptions{}, ReconstructOptions{.target_faces = 100}, ReconstructOptions{.reduce = 0.9}}) {
        const Reconstruction made = run(test::solid_volume({4, 4, 4}, 0), options);
        EXPECT_EQ(made.mesh.face_count(), 0u);
        EXPECT_EQ(made.mesh.vertex_count(), 0u);
        test::expect_sound(made.report.check);
    }
}

TEST(Reconstruct, an_open_boundary_is_sound) {
    for (double share : {0.0, 0.9}) {
        ReconstructOptions options = reduced(share);
        options.cap = false;
        test::expect_sound(run(test::noise_volume({9, 9, 9}, 3, 4), options).report.check);
        test::expect_sound(run(test::grain_volume({14, 14, 14}, 6, 4), options).report.check);
        EXPECT_EQ(run(test::solid_volume({4, 4, 4}), options).mesh.face_count(), 0u);
    }
}

TEST(Reconstruct, sheets_on_an_open_boundary_do_not_cross_when_decimated) {
    const std::vector<std::vector<test::TextVolume::Section>> volumes{
        {{"01", "01", "01"}, {"10", "10", "01"}, {"01", "00", "10"}},  // a pocket on an edge of the box was closed
        {{"110", "010"}, {"101", "110"}, {"110", "001"}},              // faces of the merged vertex crossed each other
    };
    for (const auto& sections : volumes)
        for (double quality : {0.0, 0.1}) {
            test::TextVolume volume(sections);
            const ReconstructOptions options{
                .target_faces = 0, .promises = {.min_quality = quality}, .cap = false, .background = {}};
            test::expect_sound(run(volume, options).report.check);
        }
}

TEST(Reconstruct, faces_do_not_cross_at_an_open_rim_when_samples_may_move) {
    // Sheets end on the sides: their rims move with the stars, and could lie down there.
    for (const std::uint64_t seed : {22, 144, 179, 185, 198}) {
        test::ArrayVolume volume = test::noise_volume({11, 11, 11}, 3, seed);
        const ReconstructOptions options{.reduce = 0.9, .keep_samples = false, .cap = false, .background = {}};
        test::expect_sound(run(volume, options).report.check);
    }
}

TEST(Reconstruct, an_open_rim_may_have_a_vertex_with_two_edges) {
    const ReconstructOptions open{.decimate = false, .cap = false, .background = {}};
    test::expect_sound(run(test::TextVolume({{"00", "00"}, {"00", "01"}}), open).report.check);
    test::expect_sound(
        run(test::TextVolume({{"00", "00"}, {"00", "01"}}), {.decimate = false, .background = {0, 1}}).report.check);
}

TEST(Reconstruct, labels_are_carried_bit_for_bit) {
    constexpr InputLabel kLeast = std::numeric_limits<InputLabel>::min(),
                         kMost = std::numeric_limits<InputLabel>::max();
    const Reconstruction made = run(test::ArrayVolume({2, 2, 2}, {kLeast, kMost, -1, 0, 1, kLeast, kMost, -1}));
    test::expect_sound(made.report.check);
    for (InputLabel label : {kLeast, kMost, InputLabel{-1}, InputLabel{0}, InputLabel{1}})
        EXPECT_TRUE(regions_of(made).contains(label));
}

TEST(Reconstruct, a_pipe_that_cannot_be_read_twice_is_read_once) {
    const Reconstruction made = run(test::grain_volume({14, 14, 14}, 6, 4).once(), reduced(0.9));
    test::expect_sound(made.report.check);
    EXPECT_LE(made.report.final_faces, made.report.initial_faces / 10 + 1);
}

TEST(Reconstruct, target_max_error_and_reduce_end_where_they_say) {
    test::ArrayVolume volume = test::grain_volume({16, 16, 16}, 6, 4);
    EXPECT_LE(run(volume, {.target_faces = 2000, .background = {}}).report.final_faces, 2000u);
    const Reconstruction by_error = run(volume, {.promises = {.max_error = 0.1}, .background = {}});
    EXPECT_EQ(by_error.report.stopped, StopReason::kMaxError);
    EXPECT_LT(by_error.report.final_faces, by_error.report.initial_faces / 2);
    EXPECT_EQ(run(volume, {.target_faces = 1, .background = {}}).report.stopped, StopReason::kTopology);
    const Reconstruction untouched = run(volume);
    EXPECT_EQ(untouched.report.stopped, StopReason::kNoneAsked);
    EXPECT_EQ(untouched.report.final_faces, untouched.report.initial_faces);
}

TEST(Reconstruct, tells_its_progress) {
    std::uint32_t last = 0;
    std::map<std::string, int> stages;
    test::ArrayVolume volume = test::grain_volume({10, 10, 10}, 6, 4);
    reconstruct(volume, reduced(0.5), [&](const Progress& progress) {
        ++stages[progress.stage];
        EXPECT_GE(progress.strips_read, last);
        EXPECT_EQ(progress.strip_count, 9u);
        last = progress.strips_read;
    });
    EXPECT_EQ(last, 9u);
    EXPECT_THAT(stages, testing::Contains(testing::Key("reconstruct")));
}

TEST(Reconstruct, hands_on_the_model_that_it_returns) {
    for (const std::uint32_t threads : {1u, 2u}) {
        test::ArrayVolume volume = test::grain_volume({14, 14, 14}, 6, 4);
        ReconstructOptions options = reduced(0.5);
        options.threads = threads;
        std::uint64_t written = 0;
        const auto write = [&](const Mesh& mesh, const LabelTable&, const std::vector<Label>& background) {
            EXPECT_TRUE(background.empty());
            written = test::digest(mesh);
        };
        const Reconstruction made = reconstruct(volume, options, {}, write);
        test::expect_sound(made.report.check);
        ASSERT_TRUE(made.report.samples);
        EXPECT_EQ(made.report.samples->wrong, 0u);
        EXPECT_EQ(written, test::digest(made.mesh));
    }
}

TEST(Reconstruct, throws_what_the_receiver_of_the_model_throws) {
    for (const std::uint32_t threads : {1u, 2u}) {
        test::ArrayVolume volume = test::grain_volume({8, 8, 8}, 3, 4);
        ReconstructOptions options = test::plain();
        options.threads = threads;
        const auto fail = [](const Mesh&, const LabelTable&, const std::vector<Label>&) { throw 7; };
        EXPECT_THROW(reconstruct(volume, options, {}, fail), int);
    }
}

TEST(Reconstruct, hands_the_model_on_after_the_check_where_memory_has_no_room_for_both) {
    test::ArrayVolume volume = test::noise_volume({24, 24, 24}, 5, 4);
    ReconstructOptions options = test::plain();
    options.threads = 2;
    const std::uint64_t faces = run(volume, options).mesh.face_count();
    options.memory = kProcessBytes + 90 * faces;
    bool is_checked = false, is_handed_on = false;
    const auto note = [&](const Progress& progress) { is_checked = std::string_view(progress.stage) == "samples"; };
    const auto write = [&](const Mesh&, const LabelTable&, const std::vector<Label>&) {
        EXPECT_TRUE(is_checked);
        is_handed_on = true;
    };
    volume.rewind();
    reconstruct(volume, options, note, write);
    EXPECT_TRUE(is_handed_on);
}

// Anisotropy.

TEST(Anisotropy, spacing_1_2_5_is_sound) {
    for (const Vec3 spacing : {Vec3{1, 2, 5}, Vec3{5, 2, 1}, Vec3{1e-3, 2e-3, 5e-3}, Vec3{100, 200, 500}}) {
        SCOPED_TRACE("spacing " + std::to_string(spacing.x));
        test::expect_sound(run(test::noise_volume({9, 9, 9}, 4, 1).spaced(spacing), reduced(0.9)).report.check);
        test::expect_sound(run(test::grain_volume({14, 14, 14}, 8, 2).spaced(spacing), reduced(0.9)).report.check);
    }
}

TEST(Anisotropy, the_unit_of_length_changes_nothing) {
    test::ArrayVolume volume = test::grain_volume({12, 12, 12}, 5, 2);
    const Reconstruction small = run(volume.spaced({1.0 / 1024, 1.0 / 1024, 1.0 / 1024}), reduced(0.9));
    const Reconstruction large = run(volume.spaced({1024, 1024, 1024}), reduced(0.9));
    EXPECT_EQ(small.report.final_faces, large.report.final_faces);
    EXPECT_NEAR(small.report.check.quality.mean, large.report.check.quality.mean, 1e-3);
}

TEST(Anisotropy, the_bound_on_quality_falls_with_the_ratio_of_the_spacings_unless_it_is_given) {
    test::ArrayVolume volume = test::ball_volume({9, 9, 9}, 3);
    volume.spaced({2, 1, 10});
    const auto bound = [&](ReconstructOptions options) {
        return run(volume, options).report.quality_bound.value_or(-1);
    };
    EXPECT_DOUBLE_EQ(bound({.reduce = 0.5}), 0.01);
    EXPECT_DOUBLE_EQ(bound({.reduce = 0.5, .scale_z = 0.25}), 0.04);
    EXPECT_EQ(bound({.reduce = 0.5, .promises = {.min_quality = 0.07}}), 0.07);
    EXPECT_EQ(bound({.reduce = 0.5, .improve = true}), 0.1) << "made for the shape of faces";
    EXPECT_EQ(bound({.reduce = 0.5, .preserve_volume = true}), 0.1) << "vertices must be able to move";
    EXPECT_EQ(bound({}), -1) << "nothing is decimated";
    EXPECT_EQ(bound({.reduce = 0.5, .promises = {.min_quality = 0}}), 0);
    volume.spaced({0.7, 0.7, 0.7});  // in floating point 0.1 * 0.7 / 0.7 is not 0.1
    EXPECT_EQ(bound({.reduce = 0.5}), 0.1);
}

TEST(Anisotropy, decimation_between_sections_far_apart_ends_no_sooner_than_elsewhere) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 30, 4);
    const ReconstructOptions options{.target_faces = 0, .background = {}};
    const std::uint64_t cubes = run(volume, options).report.final_faces,
                        stretched = run(volume.spaced({1, 1, 30}), options).report.final_faces;
    ReconstructOptions bounded = options;
    bounded.promises.min_quality = 0.1;
    EXPECT_LT(stretched, 1.3 * cubes);
    EXPECT_LT(stretched, 0.8 * run(volume, bounded).report.final_faces);
}

/// A turn about z by the angle, then about x; mirrored in x where asked.
std::array<double, 9> direction(double angle, bool mirrors) {
    const double c = std::cos(angle), s = std::sin(angle), m = mirrors ? -1 : 1;
    return {m * c, -s, 0, m * c * s, c * c, -s, m * s * s, c * s, c};
}

TEST(Anisotropy, oblique_and_mirrored_directions_keep_volumes_positive) {
    test::ArrayVolume volume = test::grain_volume({12, 12, 12}, 6, 2).spaced({1, 2, 5});
    const auto straight = regions_of(run(volume, reduced(0.8)));
    for (bool mirrors : {false, true}) {
        SCOPED_TRACE(mirrors ? "mirrored" : "turned");
        volume.lattice().direction = direction(0.3, mirrors);
        volume.lattice().origin = {100, -50, 7};
        const Reconstruction made = run(volume, reduced(0.8));
        test::expect_sound(made.report.check);
        for (const auto& [label, region] : regions_of(made)) {
            EXPECT_GT(region.volume, 0);
            EXPECT_NEAR(region.volume, straight.at(label).volume, 1e-6 * region.volume);
        }
    }
}

TEST(Anisotropy, direction_and_origin_move_every_sample_as_the_lattice_says) {
    test::ArrayVolume volume = test::solid_volume({3, 3, 3}).spaced({1, 2, 5});
    volume.lattice().direction = {0, 0, 1, -1, 0, 0, 0, 1, 0};
    volume.lattice().origin = {10, 20, 30};
    const Reconstruction made = run(volume);
    Box box;
    test::for_vertices(made.mesh, [&](VertexId v) { box.add(made.mesh.position(v)); });
    EXPECT_EQ(box.low, (Vec3{10, 18, 30}));
    EXPECT_EQ(box.high, (Vec3{20, 20, 34}));
    EXPECT_NEAR(regions_of(made).at(1).volume, 80, 1e-9);
}

}  // namespace
}  // namespace regionmesh
