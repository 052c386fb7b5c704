#include "regionmesh/write_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "support/json_keys.h"
#include "support/labels.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using test::Json;
using test::keys_of;
using WriteReport = TemporaryFolder;

CheckReport two_regions() {
    CheckReport report;
    report.regions = {{.label = 0, .euler = 2, .components = 1, .volume = 1.5, .area = 6},
                      {.label = 1, .euler = 0, .components = 1, .volume = 0.1, .area = 2}};
    report.region_pairs = 1;
    report.quadruple_points_inside = 3;
    report.quality.histogram[2] = 5;
    report.quality.angle_histogram[17] = 7;
    return report;
}

TEST(ReportJson, has_all_keys_and_no_others) {
    Report report;
    report.check = two_regions();
    report.seconds = {{"mesh", 1.0}, {"total", 1.5}};
    report.quality_bound = 0.1;
    report.smoothed_lines.emplace();
    report.floor.emplace();
    const Json json = Json::parse(report_json(report, test::labels_from({7, 3}), {}, {}, 0.001));
    EXPECT_EQ(json["unit"], "mm");
    EXPECT_THAT(keys_of(json),
                testing::UnorderedElementsAre(
                    "quality_bound", "smoothed_lines", "floor", "initial_faces", "initial_vertices", "final_faces",
                    "final_vertices", "unit", "error_bound", "seconds", "stage_bytes", "peak_bytes", "peak_faces",
                    "bytes_per_face", "verdicts", "refreshes", "samples_in_room", "sections_between", "sections_moved",
                    "largest_section_shift", "denoise", "stopped", "smoothing", "volumes_preserved", "quality",
                    "regions", "triple_lines", "region_pairs", "pinned_vertices", "quadruple_points_inside",
                    "violations", "violation_counts"));
    EXPECT_THAT(keys_of(json["quality"]),
                testing::ElementsAre("min", "mean", "histogram", "min_angle", "max_angle", "angles"));
    EXPECT_THAT(keys_of(json["regions"][0]), testing::ElementsAre("label", "euler", "components", "volume", "area"));
    EXPECT_THAT(keys_of(json["verdicts"]), testing::ElementsAre("accepted", "strata", "link", "fold", "quality",
                                                                "pinch", "error", "samples", "intersect"));
    EXPECT_EQ(json["violation_counts"].size(), std::size_t{kViolationKindCount});
    std::ifstream page(test::source_folder() + "/docs/reference/report.md");
    const std::string docs(std::istreambuf_iterator<char>(page), {});
    for (const Json& part : {json, json["quality"], json["regions"][0], json["verdicts"], json["smoothing"],
                             json["smoothed_lines"], json["floor"]})
        for (const std::string& key : keys_of(part)) EXPECT_THAT(docs, testing::ContainsRegex('`' + key + "(`|\\[)"));
}

TEST(ReportJson, says_what_the_report_says) {
    Report report;
    report.initial_faces = 100;
    report.final_vertices = 7;
    report.peak_bytes = 1'000'000'000'000;
    report.check = two_regions();
    report.seconds = {{"total", 1.5}};
    report.stage_bytes = {{"smooth", 2'000'000}};
    report.verdicts[static_cast<int>(Verdict::kPinch)] = 4;
    report.stopped = StopReason::kTarget;
    const Json json = Json::parse(report_json(report, test::labels_from({7, 3})));
    EXPECT_EQ(json["initial_faces"], 100);
    EXPECT_EQ(json["final_vertices"], 7);
    EXPECT_EQ(json["seconds"]["total"], 1.5);
    EXPECT_EQ(json["stage_bytes"], (Json{{"smooth", 2'000'000}}));
    EXPECT_EQ(json["peak_bytes"], 1'000'000'000'000);
    EXPECT_EQ(json["verdicts"]["pinch"], 4);
    EXPECT_EQ(json["stopped"], "target");
    EXPECT_EQ(json["quality"]["histogram"]["bin_width"], 0.01);
    EXPECT_EQ(json["quality"]["histogram"]["counts"][2], 5);
    EXPECT_EQ(json["quality"]["angles"]["bin_width"], 10);
    EXPECT_EQ(json["quality"]["angles"]["counts"][17], 7);
    EXPECT_TRUE(json["violations"].is_array());
    EXPECT_TRUE(json["violations"].empty());
}

TEST(CheckJson, regions_stand_in_order_of_their_labels) {
    const Json json = Json::parse(check_json(two_regions(), test::labels_from({7, -3})));
    EXPECT_EQ(json["regions"][0]["label"], -3);
    EXPECT_EQ(json["regions"][0]["volume"], 0.1);
    EXPECT_EQ(json["regions"][1]["label"], 7);
    EXPECT_EQ(json["region_pairs"], 1);
    EXPECT_FALSE(json.contains("final_faces"));
}

TEST(CheckJson, unsigned_labels_keep_their_sign) {
    const Json json = Json::parse(check_json(two_regions(), test::labels_from({-1, 3}, true), {}, nullptr, 1.0));
    EXPECT_EQ(json["unit"], "m");
    EXPECT_EQ(json["regions"][1]["label"], 0xFFFFFFFFFFFFFFFFu);
    EXPECT_EQ(json["regions"][0]["label"], 3);
}

TEST(CheckJson, lists_and_counts_violations) {
    CheckReport report;
    report.counts[static_cast<int>(ViolationKind::kOpenEdge)] = 12;
    report.violations = {
        {.kind = ViolationKind::kOpenEdge, .vertices = {1, 2}, .faces = {9}, .text = "region 3 is open at 1-2 \xff"}};
    const std::string kind = to_string(ViolationKind::kOpenEdge);
    const Json json = Json::parse(check_json(report, LabelTable()));
    EXPECT_EQ(json["violation_counts"][kind], 12);
    ASSERT_EQ(json["violations"].size(), 1u);
    EXPECT_EQ(json["violations"][0]["kind"], kind);
    EXPECT_EQ(json["violations"][0]["vertices"], (Json{1, 2}));
    EXPECT_EQ(json["violations"][0]["faces"], Json::array({9}));
    EXPECT_THAT(json["violations"][0]["text"].get<std::string>(), testing::StartsWith("region 3 is open"));
}

TEST_F(WriteReport, write_text_writes_the_text_and_nothing_beside_it) {
    write_text(path("report.json"), "{}\n");
    EXPECT_EQ(text_of(path("report.json")), "{}\n");
    EXPECT_EQ(file_count(), 1);
    EXPECT_THROW(write_text("/dev/full", "{}"), Error);
}

}  // namespace
}  // namespace regionmesh
