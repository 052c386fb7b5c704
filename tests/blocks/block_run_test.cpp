// Runs over a folder of pieces: the model, its recovery, and several processes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "regionmesh/blocks.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/voxelise.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// An empty folder that goes with the test.
class TestFolder {
public:
    TestFolder() {
        static int number = 0;
        path =
            fs::temp_directory_path() / ("blocks_test." + std::to_string(::getpid()) + '.' + std::to_string(number++));
        fs::remove_all(path);
    }
    ~TestFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    fs::path path;
};

test::ArrayVolume foam() { return test::grain_volume({45, 41, 38}, 25, 11); }

ReconstructOptions options_for(std::optional<double> reduce) {
    ReconstructOptions options{.reduce = reduce};
    options.smooth.reach = 2;  // a halo smaller than the volume
    return options;
}

BlockReport run_blocks(const fs::path& folder, const test::ArrayVolume& volume, const ReconstructOptions& options,
                       BlockTasks& tasks, std::uint32_t cells = 17,
                       const std::function<void(const BlockProgress&)>& on_progress = {}) {
    const BlockOptions blocks{
        .folder = folder, .block_cells = cells, .identity = {{"input", "foam"}}, .output = {.sync = false}};
    return reconstruct_blocks([&] { return std::make_unique<test::ArrayVolume>(volume); }, options, blocks, tasks,
                              on_progress);
}

BlockReport run_blocks(const fs::path& folder, const test::ArrayVolume& volume, const ReconstructOptions& options) {
    BlockTasks alone;
    return run_blocks(folder, volume, options, alone);
}

/// The bytes of all files by their names.
std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream stream(entry.path(), std::ios::binary);
        files[fs::relative(entry.path(), folder)] = {std::istreambuf_iterator<char>(stream), {}};
    }
    return files;
}

void expect_lossless(MeshFile& model, test::ArrayVolume& volume) {
    std::vector<Label> background;
    for (const InputLabel label : *model.background) background.push_back(model.labels.dense(label));
    test::expect_sound(check(model.mesh, {.background = background}));
    volume.rewind();
    const SampleAgreement samples = compare_samples(model.mesh, model.labels, background, volume);
    EXPECT_EQ(samples.wrong, 0u);
    EXPECT_EQ(samples.samples, 45u * 41 * 38);
}

TEST(BlockRun, without_decimation_has_as_many_faces_and_vertices_as_a_run_without_blocks) {
    const TestFolder folder;
    test::ArrayVolume volume = foam();
    ReconstructOptions options = options_for({});
    options.decimate = false;
    const BlockReport report = run_blocks(folder.path, volume, options);
    const Reconstruction whole = test::run(volume, options);
    EXPECT_EQ(report.pieces, 3u * 3 * 3);
    EXPECT_EQ(report.final_faces, whole.report.final_faces);
    EXPECT_EQ(report.final_vertices, whole.report.final_vertices);
    MeshFile model = read_block_folder(folder.path);
    EXPECT_EQ(model.mesh.face_count(), whole.mesh.face_count());
    EXPECT_EQ(model.mesh.vertex_count(), whole.mesh.vertex_count());
    expect_lossless(model, volume);
}

TEST(BlockRun, reaches_the_target_exactly_and_keeps_every_sample) {
    for (const double reduce : {0.5, 0.8, 0.95}) {
        SCOPED_TRACE(reduce);
        const TestFolder folder;
        test::ArrayVolume volume = foam();
        const BlockReport report = run_blocks(folder.path, volume, options_for(reduce));
        const auto target = static_cast<std::uint64_t>(std::llround((1 - reduce) * double(report.initial_faces)));
        MeshFile model = read_block_folder(folder.path);
        EXPECT_EQ(report.final_faces, model.mesh.face_count());
        if (report.stopped == StopReason::kTarget) {
            EXPECT_LE(report.final_faces, target);
            EXPECT_GE(report.final_faces + 1, target);
        } else {
            EXPECT_GT(reduce, 0.9) << "topology leaves more of a small foam";
        }
        expect_lossless(model, volume);
    }
}

TEST(BlockRun, keeps_to_the_largest_error) {
    const TestFolder folder;
    test::ArrayVolume volume = foam();
    ReconstructOptions options = options_for({});
    options.promises.max_error = 0.2;
    const BlockReport report = run_blocks(folder.path, volume, options);
    EXPECT_LE(report.error_bound, 0.2);
    EXPECT_GT(report.error_bound, 0.1);
    EXPECT_LT(report.final_faces, report.initial_faces / 2);
    EXPECT_EQ(report.stopped, StopReason::kMaxError);
    MeshFile model = read_block_folder(folder.path);
    expect_lossless(model, volume);
}

TEST(BlockRun, says_that_topology_ended_it_where_the_largest_error_did_not) {
    for (const std::uint32_t cells : {17u, 100u}) {  // several blocks, and one
        const TestFolder folder;
        test::ArrayVolume volume = foam();
        ReconstructOptions options = options_for({});
        options.promises.max_error = 1e6;
        BlockTasks alone;
        EXPECT_EQ(run_blocks(folder.path, volume, options, alone, cells).stopped, StopReason::kTopology);
    }
}

/// Ends the run, as if killed, after `blocks` blocks of all passes.
struct Ended {};
BlockReport run_until(int blocks, const fs::path& folder, const test::ArrayVolume& volume,
                      const ReconstructOptions& options) {
    BlockTasks alone;
    return run_blocks(folder, volume, options, alone, 17, [&](const BlockProgress& progress) {
        if (progress.stage != std::string("read") && progress.done > 0 && --blocks < 0) throw Ended();
    });
}

TEST(BlockRun, goes_on_where_it_was_ended_and_leaves_the_same_bytes) {
    const TestFolder whole, ended;
    const test::ArrayVolume volume = foam();
    const ReconstructOptions options = options_for(0.8);
    const BlockReport report = run_blocks(whole.path, volume, options);
    std::uint32_t found = 0, ends = 0;
    for (;; ++ends) {
        try {
            found += run_until(3 + 5 * static_cast<int>(ends), ended.path, volume, options).found;
            break;
        } catch (const Ended&) {
            ASSERT_LT(ends, 200u);
        }
    }
    EXPECT_GT(ends, 5u);
    EXPECT_GT(report.made, 2u * 27);
    EXPECT_EQ(files_in(ended.path), files_in(whole.path));
}

TEST(BlockRun, makes_a_damaged_piece_again) {
    const TestFolder whole, damaged;
    const test::ArrayVolume volume = foam();
    const ReconstructOptions options = options_for(0.8);
    run_blocks(whole.path, volume, options);
    EXPECT_THROW(run_until(19, damaged.path, volume, options), Ended);
    const fs::path piece = damaged.path / "pass-0-000003.piece";
    {
        std::fstream stream(piece, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(1000);
        stream.put('x');
    }
    fs::resize_file(damaged.path / "pass-0-000005.piece", 500);
    const BlockReport report = run_blocks(damaged.path, volume, options);
    EXPECT_EQ(report.found, 18u);
    EXPECT_EQ(files_in(damaged.path), files_in(whole.path));
}

TEST(BlockRun, refuses_other_options_and_folders_with_other_files) {
    const TestFolder folder, other;
    const test::ArrayVolume volume = foam();
    EXPECT_THROW(run_until(2, folder.path, volume, options_for(0.8)), Ended);
    BlockTasks alone;
    const BlockOptions changed{.folder = folder.path, .block_cells = 17, .identity = {{"input", "crystal"}}};
    const auto open = [&] { return std::make_unique<test::ArrayVolume>(volume); };
    try {
        reconstruct_blocks(open, options_for(0.8), changed, alone);
        FAIL() << "a changed input was not noticed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("was begun with input foam, and this run has crystal"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_THROW(read_block_folder(folder.path), Error) << "it is not complete";
    fs::create_directory(other.path);
    std::ofstream(other.path / "notes.txt") << "mine";
    EXPECT_THROW(run_blocks(other.path, volume, options_for(0.8)), Error);
}

TEST(BlockRun, notices_that_pieces_of_a_finished_run_are_gone) {
    for (const char* name : {"labels.bin", "piece"}) {
        const TestFolder folder;
        const test::ArrayVolume volume = foam();
        run_blocks(folder.path, volume, options_for(0.8));
        EXPECT_EQ(run_blocks(folder.path, volume, options_for(0.8)).made, 0u);
        std::vector<fs::path> gone;
        for (const auto& entry : fs::directory_iterator(folder.path))
            if (entry.path().string().ends_with(name)) gone.push_back(entry.path());
        ASSERT_FALSE(gone.empty());
        fs::remove(gone.front());
        EXPECT_THROW(run_blocks(folder.path, volume, options_for(0.8)), Error) << name;
    }
}

TEST(BlockRun, notices_that_a_piece_of_a_finished_run_is_damaged) {
    const TestFolder folder;
    const test::ArrayVolume volume = foam();
    run_blocks(folder.path, volume, options_for(0.8));
    for (const auto& entry : fs::directory_iterator(folder.path)) {
        if (!entry.path().string().ends_with("piece")) continue;
        std::fstream piece(entry.path(), std::ios::binary | std::ios::in | std::ios::out);
        const auto middle = static_cast<std::streamoff>(fs::file_size(entry.path()) / 2);
        piece.seekg(middle);
        const int byte = piece.get();
        piece.seekp(middle);
        piece.put(static_cast<char>(byte ^ 1));
        break;
    }
    EXPECT_THROW(run_blocks(folder.path, volume, options_for(0.8)), Error);
}

/// Replaces the first `old` in a file. A manifest goes without its checksum then, as those of earlier versions.
void replace_in(const fs::path& path, const std::string& old, const std::string& by) {
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), by);
    if (const std::size_t checksum = text.find("\"checksum\""); checksum != std::string::npos)
        text.replace(checksum, 10, "\"unchecked\"");
    std::ofstream(path, std::ios::binary) << text;
}

TEST(BlockRun, damaged_folders_are_refused) {
    const TestFolder folder;
    const test::ArrayVolume volume = foam();
    run_blocks(folder.path, volume, options_for(0.8));
    EXPECT_NO_THROW(describe_block_folder(folder.path));
    const fs::path manifest = folder.path / "manifest.json", kept = folder.path / "kept";
    fs::copy_file(manifest, kept);
    for (const auto& [old, by] :
         {std::pair("\"block_cells\": 17", "\"block_cells\": 0"),
          std::pair("\"block_cells\": 17", "\"block_cells\": 5"), std::pair("\"shift\":", "\"shift\": 17, \"was\":"),
          std::pair("\"block_cells\": 17", "\"block_cells\": 4294967295"),
          std::pair("\"scale_z\": 1.0", "\"scale_z\": 0.0"), std::pair("\"labels\": 2", "\"labels\": 3"),
          std::pair("\"labels\": 2", "\"labels\": 2305843009213693954"),  // 2^61 + 2: eight times that is 16
          std::pair("\"sweep\": [", "\"sweep\": [1000000,"), std::pair("\"size\": [", "\"size\": [1,"),
          std::pair("\"version\": 1", "\"version\": 2"), std::pair("\"crc32\": ", "\"crc32\": 1"),
          std::pair("\"sweep\"", "\"swept\""),
          std::pair("\"pieces\": [", "\"pieces\": [], \"passes\": 0, \"are\": [")}) {
        SCOPED_TRACE(by);
        replace_in(manifest, old, by);
        EXPECT_THROW(read_block_folder(folder.path), Error);
        fs::copy_file(kept, manifest, fs::copy_options::overwrite_existing);
    }
    EXPECT_NO_THROW(read_block_folder(folder.path));
}

TEST(BlockRun, does_not_go_on_with_sizes_that_no_run_has) {
    const test::ArrayVolume volume = foam();
    for (const auto& [old, by] :
         {std::pair("\"block_cells\": 17", "\"block_cells\": 0"), std::pair("\"shift\":", "\"shift\": 17, \"was\":"),
          std::pair("\"size\": [", "\"size\": [4294967295,"), std::pair("\"size\": [", "\"size\": [1,"),
          std::pair("\"sweep\": [", "\"sweep\": [1000000,"), std::pair("\"passes\":", "\"passes\": 99, \"was\":"),
          std::pair("\"passes\":", "\"passes\": 4294967297, \"was\":"),
          std::pair("\"faces\":", "\"faces\": 1e30, \"was\":"),
          std::pair("\"block_cells\": 17", "\"block_cells\": 17.5")}) {
        SCOPED_TRACE(by);
        const TestFolder folder;
        EXPECT_THROW(run_until(19, folder.path, volume, options_for(0.8)), Ended);
        replace_in(folder.path / "manifest.json", old, by);
        EXPECT_THROW(run_blocks(folder.path, volume, options_for(0.8)), Error);
    }
}

/// Threads that stand for processes: one list of tasks.
class SharedTasks {
public:
    explicit SharedTasks(std::uint32_t processes) : processes_(processes) {}

    class Process final : public BlockTasks {
    public:
        Process(SharedTasks& shared, bool is_first) : shared_(shared), is_first_(is_first) {}
        bool is_first() const override { return is_first_; }
        std::uint32_t processes() const override { return shared_.processes_; }
        std::optional<std::uint32_t> next(std::uint32_t count) override {
            const std::uint32_t task = shared_.next_++;
            return task < count ? std::optional(task) : std::nullopt;
        }
        /// All but the first go on late: what it writes meanwhile must not mislead them.
        void end_phase() override {
            shared_.meet();
            if (!is_first_) std::this_thread::sleep_for(20ms);
        }

    private:
        SharedTasks& shared_;
        bool is_first_;
    };

private:
    /// Waits for all processes; the last one to come begins the list anew. Throws where they do not come. std::barrier
    /// of libstdc++ 12 can miss that it is woken.
    void meet() {
        std::unique_lock lock(mutex_);
        const std::uint32_t phase = phase_;
        if (++waiting_ == processes_) {
            waiting_ = 0;
            next_ = 0;
            ++phase_;
            all_are_here_.notify_all();
        } else {
            if (!all_are_here_.wait_for(lock, 60s, [&] { return phase_ != phase; }))
                throw std::runtime_error("a process ended a phase alone");
        }
    }

    std::uint32_t processes_;
    std::mutex mutex_;
    std::condition_variable all_are_here_;
    std::uint32_t waiting_ = 0, phase_ = 0;
    std::atomic<std::uint32_t> next_ = 0;
};

/// What the processes made, and whether each of them made some.
struct SharedRun {
    std::uint32_t made = 0, busy = 0;
};

SharedRun run_shared(const fs::path& folder, const test::ArrayVolume& volume, const ReconstructOptions& options,
                     std::uint32_t count) {
    SharedTasks shared(count);
    std::vector<std::thread> processes;
    std::atomic<std::uint32_t> made = 0, busy = 0;
    for (std::uint32_t n = 0; n < count; ++n)
        processes.emplace_back([&, n] {
            SharedTasks::Process tasks(shared, n == 0);
            const BlockReport report = run_blocks(folder, volume, options, tasks);
            made += report.made;
            busy += report.made > 0;
        });
    for (std::thread& process : processes) process.join();
    return {made, busy};
}

TEST(BlockRun, gives_the_same_bytes_for_any_number_of_processes) {
    const TestFolder alone;
    const test::ArrayVolume volume = foam();
    const ReconstructOptions options = options_for(0.8);
    run_blocks(alone.path, volume, options);
    for (const std::uint32_t count : {2u, 3u}) {
        const TestFolder folder;
        const SharedRun run = run_shared(folder.path, volume, options, count);
        EXPECT_GT(run.made, 2u * 27);
        EXPECT_EQ(run.busy, count);
        EXPECT_EQ(files_in(folder.path), files_in(alone.path));
    }
}

TEST(BlockRun, several_processes_end_what_one_has_left_to_complete) {
    const TestFolder folder;
    const test::ArrayVolume volume = foam();
    const ReconstructOptions options = options_for(0.8);
    run_blocks(folder.path, volume, options);
    const auto complete = files_in(folder.path);
    replace_in(folder.path / "manifest.json", "\"complete\": true", "\"complete\": false");
    EXPECT_EQ(run_shared(folder.path, volume, options, 2).made, 0u);
    EXPECT_EQ(files_in(folder.path), complete);
}

}  // namespace
}  // namespace regionmesh
