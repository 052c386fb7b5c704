#include "formats/chunked/hdf5_reader.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <thread>

#include "formats/array/read_volume.h"
#include "formats/fake_program.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const Hdf5Box kAll{{0, 0, 0}, {3, 4, 5}};
constexpr const char* kFails = "the HDF5 library fails on this file";

/// With a program of its own, if one is set.
class Hdf5ReaderTest : public FakePrograms {
protected:
    Hdf5ReaderTest() : before_(std::getenv("REGIONMESH_HDF5_PROGRAM")) {}
    ~Hdf5ReaderTest() override {
        use(before_);
        EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process is left behind";
        EXPECT_EQ(errno, ECHILD);
    }

    static void use(const std::filesystem::path& program) { ::setenv("REGIONMESH_HDF5_PROGRAM", program.c_str(), 1); }
    static std::filesystem::path file() { return data("chunked/types.h5"); }

    template <class Ask>
    static std::string problem(Ask&& ask) {
        try {
            ask();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            return error.what();
        }
        return "nothing thrown";
    }
    /// Of the first request to a program that does what `lines` say.
    std::string problem_with(const std::string& lines) const {
        use(program(lines));
        Hdf5Reader reader(file());
        const std::string first = problem([&] { reader.entries(); });
        EXPECT_THAT(problem([&] { reader.entries(); }), HasSubstr(kFails)) << "asked again";
        return first;
    }

private:
    std::string before_;
};

TEST_F(Hdf5ReaderTest, entries_and_samples_come_back) {
    Hdf5Reader reader(file());
    const auto entry = reader.entry("/contiguous/uint16");
    ASSERT_TRUE(entry);
    EXPECT_TRUE(entry->is_dataset);
    EXPECT_EQ(entry->type, "uint16");
    EXPECT_EQ(entry->sample_type, SampleType::kU16);
    EXPECT_EQ(entry->shape, (std::vector<std::uint64_t>{3, 4, 5}));
    EXPECT_EQ(reader.read("/contiguous/uint16", kAll).size(), 120u);
    EXPECT_GT(reader.entries().size(), 20u);
}

TEST_F(Hdf5ReaderTest, a_refusal_names_the_file_and_the_reader_goes_on) {
    Hdf5Reader reader(file());
    EXPECT_EQ(reader.entry("/nothing"), std::nullopt);
    EXPECT_THAT(problem([&] {
                    reader.read("/records", {{0}, {1}});
                }),
                StartsWith(file().string() + ": /records: the samples cannot be read"));
    EXPECT_EQ(reader.read("/contiguous/uint16", kAll).size(), 120u);
}

TEST_F(Hdf5ReaderTest, more_memory_than_the_limit_ends_the_program_and_not_this_process) {
    Hdf5Reader reader(file());
    const Hdf5Box huge{{0, 0, 0}, {1 << 20, 1 << 10, 1 << 10}};
    EXPECT_THAT(problem([&] { reader.read("/contiguous/uint16", huge); }), HasSubstr(kFails));
    EXPECT_THAT(problem([&] { reader.entries(); }), HasSubstr(kFails)) << "asked again";
}

TEST_F(Hdf5ReaderTest, a_crash_and_an_early_end_are_the_fault_of_the_file) {
    for (const char* lines : {"kill -SEGV $$", "kill -PROF $$", "exit 0", "exit 3", "printf RMH5ANS1"})
        EXPECT_THAT(problem_with(lines), StartsWith(file().string() + ": " + kFails)) << lines;
}

TEST_F(Hdf5ReaderTest, another_program_is_named_with_its_last_words) {
    EXPECT_THAT(problem_with("echo no libhdf5 >&2; exit 127"),
                HasSubstr("failed with exit code 127 (no libhdf5); is it another program?"));
    EXPECT_THAT(problem_with("head -c 16 >/dev/null; echo 0123456789abcdefg"),
                HasSubstr("did not answer as regionmesh-hdf5"));
}

TEST_F(Hdf5ReaderTest, a_program_that_is_not_there_is_named) {
    use(path("none"));
    EXPECT_THAT(problem([] { Hdf5Reader reader(file()); }),
                HasSubstr("none: is no program that can be run; REGIONMESH_HDF5_PROGRAM gives it as regionmesh-hdf5"));
}

TEST_F(Hdf5ReaderTest, readers_in_several_threads_do_not_disturb_one_another) {
    std::atomic<int> good = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (int i = 0; i < 5; ++i) good += Hdf5Reader(file()).read("/contiguous/uint16", kAll).size() == 120;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(good, 20);
}

}  // namespace
}  // namespace regionmesh::formats
