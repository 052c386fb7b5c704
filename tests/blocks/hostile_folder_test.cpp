// Folders of pieces that were changed between two runs, and inputs that were replaced: refused, or made right.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "blocks/join.h"
#include "blocks/manifest.h"
#include "blocks/passes.h"
#include "blocks/piece.h"
#include "formats/temporary_folder.h"
#include "regionmesh/blocks.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/write_volume.h"
#include "support/random.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kSize = 30, kCells = 10;

template <class T>
T& any(std::vector<T>& items, test::Random& random) {
    return items[random.below(static_cast<std::uint32_t>(items.size()))];
}

class HostileFolder : public TemporaryFolder {
protected:
    struct Ended {};

    void put(const std::vector<InputLabel>& labels, SampleType type = SampleType::kU8) {
        test::ArrayVolume volume({kSize, kSize, kSize}, labels);
        const auto writer = create_volume(path("in.npy"), volume.info().lattice, {}, type, {.sync = false});
        std::vector<InputLabel> section(kSize * kSize);
        while (volume.next(section)) writer->write(section);
        writer->commit();
    }

    static ReconstructOptions options() {
        ReconstructOptions options{.reduce = 0.7, .background = {}, .threads = 1};
        options.smooth.reach = 2;  // a halo smaller than the volume
        return options;
    }

    /// Ends as if killed after `steps` reports of progress.
    BlockReport run(const char* folder, int steps = 1 << 30) {
        BlockTasks alone;
        const BlockOptions blocks{.folder = path(folder),
                                  .block_cells = kCells,
                                  .identity = {{"input", "grains"}},
                                  .output = {.sync = false}};
        return reconstruct_blocks([&] { return open_sections({path("in.npy")}); }, options(), blocks, alone,
                                  [&](const BlockProgress&) {
                                      if (--steps < 0) throw Ended();
                                  });
    }

    static std::vector<InputLabel> grains(std::uint64_t seed) {
        return test::grain_volume({kSize, kSize, kSize}, 12, seed).labels();
    }

    std::map<std::string, std::string> files_in(const char* folder) {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::directory_iterator(path(folder))) {
            std::ifstream stream(entry.path(), std::ios::binary);
            files[entry.path().filename()] = {std::istreambuf_iterator<char>(stream), {}};
        }
        return files;
    }
};

TEST_F(HostileFolder, another_volume_of_the_same_name_is_refused_or_not_needed) {
    const std::vector<InputLabel> first = grains(1);
    put(first);
    run("whole");
    test::Random random(3);
    int refused = 0, finished = 0;
    for (int n = 0; n < 24; ++n) {
        SCOPED_TRACE(n);
        put(first);
        fs::remove_all(path("ended"));
        try {
            run("ended", static_cast<int>(kSize + random.below(40)));  // of which 27 make the first pieces
        } catch (const Ended&) {
        }
        std::vector<InputLabel> second = first;
        if (n % 4 == 0) std::rotate(second.begin(), second.begin() + kSize * kSize, second.end());
        if (n % 4 == 1) any(second, random) = 11;
        if (n % 4 == 2) second = grains(2);
        if (n % 4 == 3)
            for (InputLabel& label : second) label = label == 3 ? 4 : label == 4 ? 3 : label;
        put(second);
        try {
            run("ended");
            ++finished;
            EXPECT_EQ(files_in("ended"), files_in("whole"));
        } catch (const Error& error) {
            ++refused;
            const std::string text = error.what();
            EXPECT_NE(text.find("begun"), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos);
        }
    }
    EXPECT_GE(refused, 6);
    RecordProperty("refused", refused);
    RecordProperty("finished", finished);
}

TEST_F(HostileFolder, one_sample_that_changed_is_named) {
    const std::vector<InputLabel> first = grains(1);
    put(first);
    EXPECT_THROW(run("ended", kSize), Ended);  // some blocks of the first layer are made
    std::vector<InputLabel> second = first;
    InputLabel& sample = second[(7 * kSize + 20) * kSize + 9];
    sample = sample == 2 ? 3 : 2;
    put(second);
    try {
        run("ended");
        FAIL() << "it was not noticed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("in.npy: its samples at x 0 to 29, y 0 to 29, z 7 are not those that"),
                  std::string::npos)
            << error.what();
    }
    put(first);
    EXPECT_NO_THROW(run("ended"));
}

/// What may be wrong in a piece whose checksums are right.
using Spoil = std::function<void(Piece&, test::Random&)>;

const std::vector<Spoil>& spoils() {
    static const std::vector<Spoil> all{
        [](Piece& piece, test::Random& random) { any(piece.faces, random).vertices[0] += 1; },
        [](Piece& piece, test::Random& random) { any(piece.faces, random).vertices[1] = 0; },
        [](Piece& piece, test::Random& random) { any(piece.faces, random).labels[1] = 5; },
        [](Piece& piece, test::Random& random) { any(piece.faces, random).labels[0] = exterior(1); },
        [](Piece& piece, test::Random& random) {
            std::swap(any(piece.faces, random).labels[0], piece.faces[0].labels[1]);
        },
        [](Piece& piece, test::Random& random) {
            any(piece.vertices, random).position = {1, 2, 3};
        },
        [](Piece& piece, test::Random& random) { any(piece.vertices, random).position.x = -1e300; },
        [](Piece& piece, test::Random& random) { any(piece.vertices, random).position = piece.vertices[0].position; },
        [](Piece& piece, test::Random& random) { any(piece.vertices, random).is_shared ^= 1; },
        [](Piece& piece, test::Random& random) { any(piece.vertices, random).sides ^= 1u << random.below(8); },
        [](Piece& piece, test::Random& random) { any(piece.vertices, random).error_bound = -HUGE_VALF; },
        [](Piece& piece, test::Random& random) { piece.faces.push_back(any(piece.faces, random)); },
        [](Piece& piece, test::Random& random) {
            piece.faces.erase(piece.faces.begin() + random.below(static_cast<std::uint32_t>(piece.faces.size())));
        },
        [](Piece& piece, test::Random&) { piece.header.left.fill(NAN); },
        [](Piece& piece, test::Random&) { piece.header.stopped = static_cast<StopReason>(17); },
        [](Piece& piece, test::Random&) { piece.faces.clear(); },
        [](Piece& piece, test::Random& random) {
            for (PieceVertex& vertex : piece.vertices) vertex.position.z += random.between(-3, 3);
        },
        [](Piece& piece, test::Random& random) {
            for (PieceVertex& vertex : piece.vertices) vertex.is_shared = static_cast<std::uint8_t>(random.below(2));
        },
        [](Piece& piece, test::Random& random) {
            if (!piece.log.empty()) any(piece.log, random).goes = 3;
        },
        [](Piece& piece, test::Random& random) {
            if (!piece.log.empty()) any(piece.log, random).position = {5, 5, 5};
        },
        [](Piece& piece, test::Random& random) {
            if (!piece.log.empty()) any(piece.log, random).level = NAN;
        },
        [](Piece& piece, test::Random& random) {
            if (!piece.log.empty()) any(piece.log, random).faces = ~0u;
        },
    };
    return all;
}

/// Changes a piece of the folder that has faces; its checksums, here and in the manifest, are those of what it has.
bool spoil_piece(const fs::path& folder, const Spoil& spoil, test::Random& random) {
    std::vector<fs::path> pieces;
    for (const auto& entry : fs::directory_iterator(folder))
        if (pass_of(entry.path().filename().string())) pieces.push_back(entry.path());
    std::ranges::sort(pieces);
    if (pieces.empty()) return false;
    const fs::path path = any(pieces, random);
    Piece piece = read_piece(path);
    if (piece.faces.empty()) return false;
    spoil(piece, random);
    const std::uint32_t checksum = write_piece(piece, path, {.sync = false});
    Manifest manifest = *read_manifest(folder);
    const std::uint32_t block = piece.header.block;
    if (block < manifest.pieces.size() && piece_path(folder, manifest.pieces[block].pass, block) == path) {
        PieceEntry& entry = manifest.pieces[block];
        entry = {entry.pass, piece.header.vertices, piece.header.faces, checksum, entry.collapses};
        write_manifest(manifest, folder, {.sync = false});
    }
    return true;
}

TEST_F(HostileFolder, no_spoiled_piece_ends_a_run_otherwise_than_by_a_refusal_or_a_result) {
    put(grains(1));
    const int steps = static_cast<int>(run("whole").made);
    test::Random random(17);
    int spoiled = 0, refused = 0;
    // The folder is made once for each moment, and spoiled in many ways.
    for (const double share : {0.2, 0.6, 0.95}) {
        fs::remove_all(path("ended"));
        EXPECT_THROW(run("ended", static_cast<int>(kSize + share * steps)), Ended);
        for (std::size_t n = 0; n < spoils().size(); ++n) {
            SCOPED_TRACE(::testing::Message() << "at " << share << ", spoil " << n);
            fs::remove_all(path("spoiled"));
            fs::copy(path("ended"), path("spoiled"));
            if (!spoil_piece(path("spoiled"), spoils()[n], random)) continue;
            ++spoiled;
            try {
                run("spoiled");
            } catch (const Error& error) {
                ++refused;
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            }
        }
    }
    EXPECT_GT(spoiled, 40);
    EXPECT_GT(refused, 5);
}

/// A complete folder whose model has another shape, with checksums that fit.
TEST_F(HostileFolder, a_complete_folder_is_checked_again) {
    put(grains(1));
    const BlockReport made = run("whole");
    EXPECT_EQ(made.check.violation_count(), 0u);
    ASSERT_TRUE(made.samples);
    EXPECT_EQ(made.samples->samples, kSize * kSize * kSize);
    EXPECT_EQ(made.samples->wrong, 0u);
    test::Random random(5);
    const auto spoil = [&](const Spoil& change) {
        fs::remove_all(path("spoiled"));
        fs::copy(path("whole"), path("spoiled"));
        ASSERT_TRUE(spoil_piece(path("spoiled"), change, random));
        Manifest manifest = *read_manifest(path("spoiled"));
        manifest.faces = 0;
        for (const PieceEntry& piece : manifest.pieces) manifest.faces += piece.faces;
        write_manifest(manifest, path("spoiled"), {.sync = false});
    };
    spoil([](Piece& piece, test::Random&) { piece.faces.erase(piece.faces.begin()); });
    EXPECT_GT(run("spoiled").check.violation_count(), 0u);
    spoil([](Piece& piece, test::Random&) { std::swap(piece.faces[0].labels[0], piece.faces[0].labels[1]); });
    EXPECT_GT(run("spoiled").check.violation_count(), 0u);
    Manifest manifest = *read_manifest(path("whole"));
    ++manifest.vertices;
    write_manifest(manifest, path("whole"), {.sync = false});
    EXPECT_THROW(run("whole"), Error) << "the number of vertices is another";
    --manifest.vertices;
    write_manifest(manifest, path("whole"), {.sync = false});
    put(grains(2));
    EXPECT_THROW(run("whole"), Error) << "the samples are others";
}

TEST_F(HostileFolder, a_changed_manifest_is_refused_by_its_checksum) {
    put(grains(1));
    run("whole");
    const std::string text = text_of(path("whole") / "manifest.json");
    for (const auto& [old, by] : {std::pair<std::string, std::string>("\"spacing\": [\n    1", "\"spacing\": [\n    2"),
                                  std::pair<std::string, std::string>("\"faces\": ", "\"faces\": 1")}) {
        std::string changed = text;
        const std::size_t at = changed.find(old);
        ASSERT_NE(at, std::string::npos) << old;
        put_text(path("whole") / "manifest.json", changed.replace(at, old.size(), by));
        EXPECT_THROW(read_manifest(path("whole")), Error);
    }
    put_text(path("whole") / "manifest.json", text);
    EXPECT_NO_THROW(read_manifest(path("whole")));
}

TEST_F(HostileFolder, a_copy_of_the_samples_that_was_changed_is_refused) {
    const test::ArrayVolume volume = test::grain_volume({kSize, kSize, kSize}, 12, 1);
    const auto run_copied = [&](int steps) {
        BlockTasks alone;
        const BlockOptions blocks{
            .folder = path("copied"), .block_cells = kCells, .identity = {}, .output = {.sync = false}};
        return reconstruct_blocks([&] { return std::make_unique<test::ArrayVolume>(volume); }, options(), blocks, alone,
                                  [&](const BlockProgress&) {
                                      if (--steps < 0) throw Ended();
                                  });
    };
    EXPECT_THROW(run_copied(kSize), Ended);
    const std::string labels = text_of(path("copied") / "volume.labels");
    for (const char byte : {'\x01', '\xFF'}) {
        std::string changed = labels;
        changed[changed.size() - 3] = byte;  // a label that there is not
        put_text(path("copied") / "volume.labels", changed);
        EXPECT_THROW(run_copied(1 << 30), Error);
    }
    put_text(path("copied") / "volume.labels", labels);
    EXPECT_EQ(run_copied(1 << 30).samples->wrong, 0u);
    EXPECT_FALSE(fs::exists(path("copied") / "volume.labels"));
}

}  // namespace
}  // namespace regionmesh
