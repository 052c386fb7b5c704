#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regionmesh/write_report.h"
#include "support/json_keys.h"

namespace regionmesh {
namespace {

using test::Json;
using test::keys_of;
using testing::ElementsAre;

/// Region 5 in both models, 9 in A only; they meet in A.
CompareReport example() {
    CompareReport report;
    for (const InputLabel label : {5, 9}) report.labels.dense(label);
    report.faces = {100, 10};
    report.vertices = {52, 7};
    const DistanceStatistics near{.samples = 7, .rms = 0.5, .mean = 0.25, .max = 2, .quantile_95 = 1.5};
    report.distance = {near, near, near};
    report.regions.resize(2);
    report.regions[0] = {.label = 0,
                         .measures = {RegionReport{.label = 0, .euler = 2, .components = 2, .volume = 8, .area = 24},
                                      RegionReport{.label = 0, .euler = 0, .components = 1, .volume = 7, .area = 25}},
                         .distance = {near, near, near}};
    report.regions[1].label = 1;
    report.regions[1].measures[0] = RegionReport{.label = 1, .euler = 2, .components = 1, .volume = 1, .area = 6};
    report.interfaces.push_back({.labels = {0, 1}, .measures = {3.5, std::nullopt}, .distance = {}});
    report.interfaces.push_back({.labels = {0, exterior(0)}, .measures = {2.0, 1.0}, .distance = {near, near, near}});
    report.lines.push_back({.labels = {0, exterior(0), exterior(0)}, .measures = {std::nullopt, 4.0}, .distance = {}});
    report.quality[1].min = 0.1;
    return report;
}

TEST(CompareJson, has_all_keys_and_no_others) {
    const Json json = Json::parse(compare_json(example()));
    EXPECT_THAT(keys_of(json), ElementsAre("faces", "vertices", "exterior_label", "distance", "only_in_a", "only_in_b",
                                           "regions", "interfaces", "lines", "quality"));
    EXPECT_THAT(keys_of(json["distance"]), ElementsAre("a_to_b", "b_to_a", "both"));
    EXPECT_THAT(keys_of(json["distance"]["both"]), ElementsAre("samples", "rms", "mean", "max", "quantile_95"));
    EXPECT_THAT(keys_of(json["regions"][0]), ElementsAre("label", "a", "b", "change", "distance"));
    EXPECT_THAT(keys_of(json["regions"][0]["change"]), ElementsAre("euler", "components", "volume", "area"));
    EXPECT_THAT(keys_of(json["interfaces"][0]), ElementsAre("labels", "area", "distance"));
    EXPECT_THAT(keys_of(json["lines"][0]), ElementsAre("labels", "length", "distance"));
    EXPECT_THAT(keys_of(json["quality"]["a"]),
                ElementsAre("min", "mean", "histogram", "min_angle", "max_angle", "angles"));
}

TEST(CompareJson, says_what_the_report_says) {
    const Json json = Json::parse(compare_json(example()));
    EXPECT_EQ(json["faces"]["b"], 10);
    EXPECT_EQ(json["distance"]["a_to_b"]["quantile_95"], 1.5);
    EXPECT_EQ(json["regions"][0]["label"], 5);
    EXPECT_EQ(json["regions"][0]["change"]["euler"], -2);
    EXPECT_EQ(json["regions"][0]["change"]["components"], -1);
    EXPECT_EQ(json["regions"][0]["change"]["volume"], -1.0);
    EXPECT_EQ(json["interfaces"][1]["labels"], (Json{5, -1}));
    EXPECT_EQ(json["interfaces"][1]["area"]["b"], 1.0);
    EXPECT_EQ(json["quality"]["b"]["min"], 0.1);
    EXPECT_EQ(json["exterior_label"], -1);
}

TEST(CompareJson, what_one_model_has_alone_is_named_and_null) {
    const Json json = Json::parse(compare_json(example()));
    EXPECT_EQ(json["only_in_a"]["regions"], Json::array({9}));
    EXPECT_EQ(json["only_in_a"]["interfaces"], Json::array({{5, 9}}));
    EXPECT_EQ(json["only_in_a"]["lines"], Json::array());
    EXPECT_EQ(json["only_in_b"]["lines"], Json::array({{5, -1, -1}}));
    EXPECT_TRUE(json["regions"][1]["b"].is_null());
    EXPECT_TRUE(json["regions"][1]["change"].is_null());
    EXPECT_TRUE(json["regions"][1]["distance"].is_null());
    EXPECT_TRUE(json["interfaces"][0]["area"]["b"].is_null());
    EXPECT_TRUE(json["interfaces"][0]["distance"].is_null());
}

TEST(CompareJson, exterior_gives_way_to_negative_labels) {
    CompareReport report = example();
    report.labels = LabelTable();
    for (const InputLabel label : {-7, 3}) report.labels.dense(label);
    const Json json = Json::parse(compare_json(report));
    EXPECT_EQ(json["exterior_label"], -8);
    EXPECT_EQ(json["interfaces"][1]["labels"], (Json{-7, -8}));
}

}  // namespace
}  // namespace regionmesh
