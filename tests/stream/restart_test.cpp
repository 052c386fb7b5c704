// Where smoothing finds that its window holds too few strips, the run begins again and holds more.
#include <gtest/gtest.h>

#include "regionmesh/error.h"
#include "smooth/smoother.h"
#include "stream/pipeline.h"
#include "stream/section_faces.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kSections = 40, kBead = 30;

/// A bar of label 1 along z, and a bead of label 2 apart from it.
test::ArrayVolume bar_and_bead() {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < kSections; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 9; ++x)
                labels.push_back(x >= 1 && x <= 3 && y >= 1 && y <= 3 && z > 2 && z < kSections - 3 ? 1
                                 : x == 6 && y == 2 && z == kBead                                   ? 2
                                                                                                    : 0);
    return {{9, 6, kSections}, std::move(labels)};
}

/// Strips of the volume with the bead moved into the bar, and back along the sweep: surface that crosses faces of
/// strips that smoothing may have released.
class MisplacedBead final : public FaceSource {
public:
    MisplacedBead(SectionFaces& plain, double back, bool can_rewind = true)
        : plain_(plain), back_(back), can_rewind_(can_rewind) {}

    std::optional<FaceCount> count(const OnStripsCounted& on_strips) override { return plain_.count(on_strips); }
    const SourceShape& shape() const override { return plain_.shape(); }
    double low_of(std::uint32_t strip) const override { return plain_.low_of(strip); }
    bool advance() override { return plain_.advance(); }
    void make_faces(Chunk& chunk) override {
        plain_.make_faces(chunk);
        for (ChunkVertex& vertex : chunk.vertices)
            if (vertex.position.x > 4.6 && vertex.sides == 0) vertex.position += Vec3{-2.7, 0, -back_};
    }
    std::uint32_t strips_read() const override { return plain_.strips_read(); }
    bool rewind() override {
        ++rewinds_;
        return can_rewind_ && plain_.rewind();
    }
    const LabelTable& labels() const override { return plain_.labels(); }
    const std::vector<Label>& background() const override { return plain_.background(); }
    LabelOracle oracle() const override { return plain_.oracle(); }
    void place(Mesh& mesh) const override { plain_.place(mesh); }
    int rewinds() const { return rewinds_; }

private:
    SectionFaces& plain_;
    double back_;
    bool can_rewind_;
    int rewinds_ = 0;
};

const SmoothOptions kSmooth{.filter = SmoothFilter::kTaubin, .passes = 2, .threads = 1};
const CensusOptions kAllRegions{.background = {}, .cells = CellKind::kTetrahedra};

/// Is smoothing of the strips stuck when it holds this number of strips more than it seems to need?
bool is_stuck(double back, std::uint32_t extra) {
    test::ArrayVolume volume = bar_and_bead();
    SectionFaces plain(volume, kAllRegions);
    MisplacedBead source(plain, back);
    Smoother smoother(kSmooth, {.thickness = 1, .extra = extra});
    Chunk chunk;
    while (source.advance()) {
        source.make_faces(chunk);
        if (!smoother.add(chunk, source.is_last(), source.low_of(source.strips_read()))) {
            EXPECT_TRUE(smoother.stuck_chunk().has_value());
            return true;
        }
        while (smoother.next(chunk)) {
        }
    }
    EXPECT_FALSE(smoother.stuck_chunk().has_value());
    return false;
}

/// A misplacement at which smoothing is stuck.
double stuck_misplacement() {
    for (double back = 0; back < 12; back += 0.5)
        if (is_stuck(back, 0)) return back;
    ADD_FAILURE() << "smoothing is never stuck";
    return 0;
}

TEST(Restart, smoothing_that_holds_all_strips_is_never_stuck) {
    for (double back = 0; back < 12; back += 0.5) EXPECT_FALSE(is_stuck(back, 1000)) << back;
}

ReconstructOptions options() {
    return {.cells = CellKind::kTetrahedra, .smooth = kSmooth, .decimate = false, .background = {}, .threads = 1};
}

TEST(Restart, a_run_that_is_stuck_begins_again_and_gives_a_whole_mesh) {
    test::ArrayVolume volume = bar_and_bead(), same = bar_and_bead();
    SectionFaces plain(volume, kAllRegions);
    MisplacedBead source(plain, stuck_misplacement());
    const Reconstruction result = reconstruct(source, options());
    EXPECT_GE(source.rewinds(), 1);
    EXPECT_EQ(result.mesh.face_count(), test::run(same, options()).mesh.face_count());
    EXPECT_EQ(result.report.initial_faces, result.mesh.face_count()) << "faces of the first attempt are not counted";
}

TEST(Restart, a_source_that_cannot_be_read_again_is_refused_with_the_strip) {
    test::ArrayVolume volume = bar_and_bead();
    SectionFaces plain(volume, kAllRegions);
    MisplacedBead source(plain, stuck_misplacement(), false);
    try {
        reconstruct(source, options());
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("smoothing: strip "), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace regionmesh
