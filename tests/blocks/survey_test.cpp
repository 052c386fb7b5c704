// A survey by parts finds what one by sections finds.
#include "blocks/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "formats/temporary_folder.h"
#include "regionmesh/blocks.h"
#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/write_volume.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

class SurveyTest : public TemporaryFolder {
protected:
    /// A file of grains.
    std::filesystem::path put_grains(const test::Size& size, std::uint32_t grains) {
        test::ArrayVolume volume = test::grain_volume(size, grains, 3);
        const std::unique_ptr<SectionWriter> writer =
            create_volume(path("grains.npy"), volume.info().lattice, coordinates_of(volume.info()), volume.info().type,
                          {.sync = false});
        std::vector<InputLabel> section(std::size_t{volume.section_width()} * volume.section_height());
        while (volume.next(section)) writer->write(section);
        writer->commit();
        return path("grains.npy");
    }
};

TEST_F(SurveyTest, by_parts_numbers_labels_and_counts_faces_as_by_sections) {
    const std::filesystem::path file = put_grains({37, 29, 23}, 60);
    for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ})
        for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra})
            for (const std::vector<InputLabel>& background :
                 {std::vector<InputLabel>{}, std::vector<InputLabel>{5, 999, 17}}) {
                const OpenSections open = [&] { return open_sections({file}, {.sweep = sweep}); };
                const SurveyOptions options{.strips = {.cells = cells}, .background = background};
                const Survey whole = survey_sections(*open(), options, nullptr);
                ASSERT_GT(whole.labels.size(), 40u);
                for (const auto& [samples, count] : {std::pair(4u, 1u), std::pair(50u, 7u), std::pair(400u, 30u),
                                                     std::pair(100'000u, 5u), std::pair(100'000u, 1000u)}) {
                    std::vector<PartSurvey> parts;
                    for (const IndexBox& box : survey_boxes(open()->info(), samples, count))
                        parts.push_back(survey_part(open, box, options));
                    EXPECT_GE(parts.size(), std::min(count, open()->section_count() - 1));
                    const Survey columns = join_surveys(open()->info(), background, parts);
                    EXPECT_EQ(columns.faces, whole.faces) << samples;
                    EXPECT_TRUE(std::ranges::equal(columns.hashes.sums(), whole.hashes.sums())) << samples;
                    ASSERT_EQ(columns.labels.size(), whole.labels.size());
                    for (Label label = 0; label < whole.labels.size(); ++label)
                        EXPECT_EQ(columns.labels.input(label), whole.labels.input(label)) << samples;
                }
            }
}

TEST_F(SurveyTest, an_input_that_changes_meanwhile_is_refused) {
    const std::filesystem::path file = put_grains({9, 8, 7}, 6);
    const OpenSections open = [&] { return open_sections({file}, {.sweep = SweepChoice::kZ}); };
    const LabelTable none;
    const LabelsInPlace boxes(open, none);
    std::vector<Label> section(9 * 8);
    const auto sections = boxes.open({{0, 0, 0}, {9, 8, 7}});
    EXPECT_THROW(sections->next(section), Error);
}

/// One process that takes the tasks of several.
struct Several final : BlockTasks {
    explicit Several(std::uint32_t count) : count(count) {}
    std::uint32_t processes() const override { return count; }
    std::uint32_t count;
};

TEST_F(SurveyTest, ended_on_the_way_goes_on_with_any_number_of_processes) {
    const std::filesystem::path file = put_grains({24, 23, 22}, 12);
    struct Ended {};
    const auto run = [&](const char* folder, std::uint32_t processes, bool is_ended) {
        Several tasks(processes);
        const BlockOptions blocks{.folder = path(folder), .block_cells = 12, .identity = {}, .output = {.sync = false}};
        reconstruct_blocks([&] { return open_sections({file}); }, {.smooth = {.passes = 0}}, blocks, tasks,
                           [&](const BlockProgress& progress) {
                               if (is_ended && progress.stage == std::string("read") && progress.done == 3)
                                   throw Ended();
                           });
    };
    const auto names = [&](const char* folder) {
        std::set<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
            found.insert(entry.path().filename());
        return found;
    };
    run("whole", 1, false);
    for (const std::uint32_t processes : {2u, 3u}) EXPECT_THROW(run("ended", processes, true), Ended);
    EXPECT_EQ(names("ended").size(), 1u + 2 * 3) << "a manifest, and parts of both runs";
    run("ended", 4, false);
    EXPECT_EQ(names("ended"), names("whole"));
}

}  // namespace
}  // namespace regionmesh
