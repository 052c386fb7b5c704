// The table of options: one door for values, defaults of the structs, refusals in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "regionmesh/error.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Settings applied(const OptionValues& values) {
    Settings settings;
    apply_options(settings, values);
    return settings;
}

std::string refusal(const OptionValues& values) {
    try {
        applied(values);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kUsage);
        return error.what();
    }
    return "accepted";
}

TEST(OptionTable, names_are_unique_words_and_every_row_is_complete) {
    std::set<std::string> names;
    for (const OptionSpec& option : option_table()) {
        SCOPED_TRACE(option.name);
        EXPECT_TRUE(names.insert(option.name).second);
        EXPECT_EQ(option.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
        EXPECT_FALSE(option.help.empty());
        EXPECT_FALSE(option.group.empty());
        EXPECT_NE(option.commands, 0u);
        EXPECT_NE(option.inputs, 0u);
        EXPECT_TRUE(option.set);
        EXPECT_EQ(option.kind == OptionKind::kWord, !option.words.empty());
        EXPECT_EQ(option.help.find('\n'), std::string_view::npos);
        EXPECT_EQ(find_option(option.name), &option);
    }
    EXPECT_EQ(find_option("no-such-option"), nullptr);
}

TEST(OptionTable, groups_stand_together) {
    std::set<std::string_view> seen;
    std::string_view group;
    for (const OptionSpec& option : option_table()) {
        if (option.group == group) continue;
        group = option.group;
        EXPECT_TRUE(seen.insert(group).second) << group;
    }
}

TEST(OptionTable, defaults_as_text_are_the_defaults_of_the_structs) {
    EXPECT_EQ(find_option("min-quality")->default_text, "") << "depends on the spacing";
    EXPECT_EQ(find_option("perturbation")->default_text, "1e-07");
    EXPECT_EQ(find_option("memory")->default_text, "2GiB");
    EXPECT_EQ(find_option("smooth")->default_text, "normal");
    EXPECT_EQ(find_option("background")->default_text, "0");
    OptionValues values;
    for (const OptionSpec& option : option_table())
        if (!option.default_text.empty()) values.emplace_back(option.name, option.default_text);
    EXPECT_GT(values.size(), 10u);
    const Settings set = applied(values), plain;
    EXPECT_EQ(set.reconstruct.promises.min_quality, plain.reconstruct.promises.min_quality);
    EXPECT_EQ(set.reconstruct.perturbation, plain.reconstruct.perturbation);
    EXPECT_EQ(set.reconstruct.memory, plain.reconstruct.memory);
    EXPECT_EQ(set.reconstruct.threads, plain.reconstruct.threads);
    EXPECT_EQ(set.reconstruct.background, plain.reconstruct.background);
    EXPECT_EQ(set.reconstruct.cap, plain.reconstruct.cap);
    EXPECT_FALSE(set.reconstruct.sweep);
    EXPECT_EQ(set.reconstruct.smooth.filter, plain.reconstruct.smooth.filter);
    EXPECT_EQ(set.reconstruct.smooth.passes, plain.reconstruct.smooth.passes);
    EXPECT_EQ(set.reconstruct.smooth.lambda, plain.reconstruct.smooth.lambda);
    EXPECT_EQ(set.volume.sweep, plain.volume.sweep);
    EXPECT_EQ(set.tetrahedra.scale_z, plain.tetrahedra.scale_z);
    EXPECT_EQ(set.reconstruct.scale_z, plain.reconstruct.scale_z);
    EXPECT_EQ(set.samples, plain.samples);
}

TEST(OptionTable, values_reach_their_members) {
    const Settings settings = applied({{"reduce", "90%"},
                                       {"memory", "1.5KiB"},
                                       {"spacing", "1,2,0.5"},
                                       {"size", "3,4,5"},
                                       {"sweep", "x"},
                                       {"boundary", "open"},
                                       {"weld", "0"},
                                       {"no-intersect-check", "true"},
                                       {"smooth-filter", "nifpms"},
                                       {"input", "a.png"},
                                       {"input", "b.png"}});
    EXPECT_DOUBLE_EQ(*settings.reconstruct.reduce, 0.9);
    EXPECT_EQ(applied({{"target-faces", "5000000000"}}).reconstruct.target_faces, 5'000'000'000u);
    EXPECT_EQ(settings.reconstruct.memory, 1536u);
    EXPECT_EQ(*settings.volume.spacing, (Vec3{1, 2, 0.5}));
    EXPECT_EQ(*settings.volume.raw_size, (std::array<std::uint32_t, 3>{3, 4, 5}));
    EXPECT_EQ(settings.volume.sweep, SweepChoice::kX);
    EXPECT_EQ(settings.reconstruct.sweep->axes, kSweepX.axes);
    EXPECT_FALSE(settings.reconstruct.cap);
    EXPECT_EQ(settings.surface.weld, 0.0);
    EXPECT_FALSE(settings.reconstruct.promises.intersect_check);
    EXPECT_EQ(settings.reconstruct.smooth.filter, SmoothFilter::kNifpms);
    EXPECT_THAT(settings.inputs, ElementsAre("a.png", "b.png"));
}

TEST(OptionTable, a_purpose_stands_for_options_that_are_not_given) {
    const ReconstructOptions fe = applied({{"for", "fe"}}).reconstruct;
    EXPECT_EQ(fe.reduce, 0.9);
    EXPECT_EQ(fe.edge_length, 0.0);
    EXPECT_TRUE(fe.improve);
    const ReconstructOptions own = applied({{"edge-length", "3"}, {"target-faces", "500"}, {"for", "fe"}}).reconstruct;
    EXPECT_EQ(own.edge_length, 3.0);
    EXPECT_EQ(own.target_faces, 500u);
    EXPECT_FALSE(own.reduce) << "one target is enough";
    EXPECT_FALSE(applied({{"for", "fe"}, {"max-error", "0.5mm"}}).reconstruct.reduce);
    EXPECT_TRUE(applied({{"for", "print"}}).reconstruct.preserve_volume);
    EXPECT_FALSE(applied({{"for", "view"}}).reconstruct.keep_samples);
    EXPECT_THAT(refusal({{"for", "fun"}}), HasSubstr("--for fun"));
}

TEST(OptionTable, the_order_of_the_values_does_not_matter) {
    for (const OptionValues& values : {OptionValues{{"smooth-filter", "taubin"}, {"smooth", "5"}},
                                       OptionValues{{"smooth", "5"}, {"smooth-filter", "taubin"}}}) {
        EXPECT_EQ(applied(values).reconstruct.smooth.passes, 5u);
        EXPECT_EQ(applied(values).reconstruct.smooth.filter, SmoothFilter::kTaubin);
    }
    EXPECT_THAT(applied({{"no-background", "false"}, {"background", "5"}}).reconstruct.background, ElementsAre(5));
}

TEST(OptionTable, a_flag_that_is_false_is_as_one_that_is_not_given) {
    for (const OptionSpec& option : option_table()) {
        if (option.kind != OptionKind::kFlag) continue;
        const Settings settings = applied({{option.name, "false"}});
        EXPECT_TRUE(settings.given.empty()) << option.name;
        EXPECT_FALSE(has_background(settings)) << option.name;
        EXPECT_NO_THROW(require_fit(settings, {"volume.npy"})) << option.name;
        EXPECT_NO_THROW(require_fit(settings, {"points.csv"})) << option.name;
    }
    EXPECT_TRUE(has_background(applied({{"no-background", "true"}})));
}

TEST(OptionTable, labels_of_the_background_replace_the_default) {
    EXPECT_THAT(applied({}).reconstruct.background, ElementsAre(0));
    EXPECT_THAT(applied({{"background", "7"}, {"background", "-3"}}).reconstruct.background, ElementsAre(7, -3));
    EXPECT_THAT(applied({{"background", "18446744073709551615"}}).reconstruct.background, ElementsAre(-1));
}

TEST(OptionTable, wrong_values_are_refused_with_flag_and_text) {
    const OptionValues wrong{{"reduce", "150%"},       {"reduce", "x"},       {"memory", "3quarts"},
                             {"memory", "0"},          {"threads", "-1"},     {"threads", "4294967296"},
                             {"smooth", "2.5"},        {"smooth", "100001"},  {"smooth-lambda", "2"},
                             {"smooth-lambda", "nan"}, {"sweep", "w"},        {"spacing", "1,0,1"},
                             {"spacing", "1,1"},       {"size", "1,2,x"},     {"type", "float"},
                             {"scale-z", "0"},         {"samples", "0"},      {"background", "1.5"},
                             {"quiet", "perhaps"},     {"min-quality", "-1"}, {"layer", "2147483648"}};
    for (const auto& value : wrong) {
        const std::string text = refusal({value});
        EXPECT_THAT(text, testing::StartsWith("--" + value.first + ' ' + value.second + ": not "));
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_THAT(refusal({{"dance", "1"}}), HasSubstr("dance"));
}

TEST(OptionTable, contradictions_are_refused) {
    EXPECT_THAT(refusal({{"boundary", "open"}, {"hull", "true"}}), HasSubstr("--hull"));
    EXPECT_THAT(refusal({{"boundary", "open"}, {"preserve-volume", "true"}}), HasSubstr("--preserve-volume"));
}

TEST(OptionTable, options_fit_their_kind_of_input) {
    EXPECT_EQ(kind_of_input({"a.npy", "b.npy"}), kVolumeInput);
    EXPECT_EQ(kind_of_input({"a.csv"}), kTableInput);
    EXPECT_EQ(kind_of_input({"a.vtu"}), kMeshInput);
    const Settings spacing = applied({{"spacing", "1,1,2"}}), array = applied({{"array", "label"}});
    require_fit(spacing, {"a.npy"});
    require_fit(array, {"a.vtu"});
    EXPECT_THROW(require_fit(spacing, {"a.vtu"}), Error);
    EXPECT_THROW(require_fit(array, {"a.csv"}), Error);
    EXPECT_THROW(require_fit({}, {"a.csv", "b.csv"}), Error);
}

}  // namespace
}  // namespace regionmesh
