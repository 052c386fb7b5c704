#include "stream/read_ahead.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "base/parallel_for.h"
#include "base/parallel_invoke.h"
#include "regionmesh/error.h"
#include "stream/tuning.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Throws in place of one section; notes on which threads it was called.
class FailingVolume : public test::ArrayVolume {
public:
    FailingVolume(test::ArrayVolume volume, std::uint32_t fails_at)
        : ArrayVolume(std::move(volume)), fails_at_(fails_at) {}
    bool next(std::span<InputLabel> section) override {
        threads.insert(std::this_thread::get_id());
        if (read == fails_at_) throw Error(ErrorCode::kInput, "section " + std::to_string(read) + " is torn");
        ++read;
        return ArrayVolume::next(section);
    }
    void rewind() override {
        read = 0;
        ArrayVolume::rewind();
    }
    std::atomic<std::uint32_t> read = 0;
    std::set<std::thread::id> threads;  // of all calls of next

private:
    std::uint32_t fails_at_;
};

constexpr std::uint32_t kNever = 1000000;

test::ArrayVolume noise(std::uint32_t sections = 7) { return test::noise_volume({4, 3, sections}, 50, 1); }

std::vector<std::vector<InputLabel>> all_sections(SectionReader& reader) {
    std::vector<std::vector<InputLabel>> sections;
    std::vector<InputLabel> section(reader.section_width() * reader.section_height());
    while (reader.next(section)) sections.push_back(section);
    return sections;
}

std::string failure(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(ReadAhead, hands_out_the_same_sections_in_the_same_order) {
    test::ArrayVolume volume = noise();
    const auto expected = all_sections(volume);
    volume.rewind();
    ReadAhead ahead(volume);
    EXPECT_EQ(ahead.section_count(), 7u);
    EXPECT_EQ(all_sections(ahead), expected);
    std::vector<InputLabel> section(12);
    EXPECT_FALSE(ahead.next(section)) << "the end stays the end";
}

/// Reads each section on several threads.
class ParallelVolume : public test::ArrayVolume {
public:
    ParallelVolume(test::ArrayVolume volume, std::function<void()> before_each)
        : ArrayVolume(std::move(volume)), before_each_(std::move(before_each)) {}
    bool next(std::span<InputLabel> section) override {
        before_each_();
        std::atomic<std::uint32_t> done = 0;
        parallel_for(50, 2, [&](std::uint32_t) { ++done; });
        EXPECT_EQ(done, 50u);
        return ArrayVolume::next(section);
    }

private:
    std::function<void()> before_each_;
};

TEST(ReadAhead, goes_on_while_all_threads_of_others_wait_for_a_section) {
    ::alarm(100);  // otherwise a failure would wait for ever
    // More callers than the arena has room for.
    constexpr std::uint32_t kCallers = 4;
    const std::uint32_t fit = std::min(2u, std::max(1u, std::thread::hardware_concurrency()));
    std::atomic<std::uint32_t> waiting = 0;
    const auto until_others_wait = [&] {
        for (std::uint32_t tries = 0; waiting < fit && tries < 1000; ++tries)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    const auto read = [&](std::uint32_t caller) {
        ParallelVolume volume(test::noise_volume({4, 3, 7}, 50, caller), until_others_wait);
        ReadAhead ahead(volume);
        parallel_invoke(
            2, [] {},
            [&] {
                ++waiting;
                EXPECT_EQ(all_sections(ahead).size(), 7u);
            });
    };
    std::vector<std::thread> callers;
    for (std::uint32_t n = 0; n < kCallers; ++n) callers.emplace_back(read, n);
    for (std::thread& caller : callers) caller.join();
    ::alarm(0);
}

TEST(ReadAhead, reads_again_from_the_start_wherever_it_was) {
    test::ArrayVolume volume = noise();
    const auto expected = all_sections(volume);
    volume.rewind();
    ReadAhead ahead(volume);
    std::vector<InputLabel> section(12);
    for (std::uint32_t read : {0u, 1u, 3u, 7u}) {
        for (std::uint32_t n = 0; n < read; ++n) ASSERT_TRUE(ahead.next(section));
        ahead.rewind();
        EXPECT_EQ(all_sections(ahead), expected) << "after " << read << " sections";
        ahead.rewind();
    }
}

TEST(ReadAhead, an_error_comes_after_the_sections_before_it_and_stays) {
    for (std::uint32_t at : {0u, 1u, 3u, 6u}) {
        FailingVolume volume(noise(), at);
        ReadAhead ahead(volume);
        std::vector<InputLabel> section(12);
        for (std::uint32_t n = 0; n < at; ++n) ASSERT_TRUE(ahead.next(section));
        const std::string text = "section " + std::to_string(at) + " is torn";
        EXPECT_EQ(failure([&] { ahead.next(section); }), text);
        EXPECT_EQ(failure([&] { ahead.next(section); }), text);
        ahead.rewind();
        EXPECT_EQ(at > 0 && ahead.next(section), at > 0) << "nothing is left of the error";
    }
}

TEST(ReadAhead, may_be_left_at_any_time) {
    for (std::uint32_t read : {0u, 1u, 2u, 7u, 8u}) {
        FailingVolume volume(noise(), kNever);
        ReadAhead ahead(volume);
        std::vector<InputLabel> section(12);
        for (std::uint32_t n = 0; n < read; ++n) ahead.next(section);
    }
}

TEST(ReadAhead, reads_nothing_before_it_is_asked_and_one_section_ahead_then) {
    FailingVolume volume(noise(), kNever);
    { const ReadAhead idle(volume); }
    EXPECT_EQ(volume.read, 0u);
    ReadAhead ahead(volume);
    std::vector<InputLabel> section(12);
    ahead.next(section);
    for (int tries = 0; tries < 10000 && volume.read < 2; ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(volume.read, 2u);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(volume.read, 2u) << "no further, while nobody asks";
}

TEST(ReadAhead, is_for_large_sections_and_several_threads) {
    for (std::uint32_t threads : {1u, 2u, 0u}) {
        FailingVolume large(test::ball_volume({512, 512, 2}, 9), kNever), small(noise(), kNever);
        static_assert(512 * 512 == stream::kFewestReadAhead);
        reconstruct(large, {.reduce = 0.5, .background = {}, .threads = threads});
        EXPECT_EQ(large.threads.contains(std::this_thread::get_id()), threads == 1) << threads << " threads";
        reconstruct(small, {.reduce = 0.5, .background = {}, .threads = threads});
        EXPECT_TRUE(small.threads.contains(std::this_thread::get_id())) << threads << " threads";
    }
}

TEST(ReadAhead, an_error_in_the_middle_ends_the_run_in_its_own_words) {
    for (std::uint32_t threads : {1u, 2u})
        for (bool once : {false, true}) {
            test::ArrayVolume sections = noise(20);
            FailingVolume volume(once ? sections.once() : sections, 12);
            const ReconstructOptions options{.reduce = 0.5, .background = {}, .threads = threads};
            EXPECT_EQ(failure([&] { reconstruct(volume, options); }), "section 12 is torn");
        }
}

}  // namespace
}  // namespace regionmesh
