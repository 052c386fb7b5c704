#include "formats/child_process.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

Bytes bytes(std::string_view text) {
    const auto view = std::as_bytes(std::span(text));
    return {view.begin(), view.end()};
}

std::string text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string ask(ChildProcess& child, std::string_view request) {
    try {
        return text(child.ask(bytes(request), 1));
    } catch (const Error& error) {
        return std::string("Error: ") + error.what();
    }
}

/// Does what it is asked to do; "x" is answered by "x".
Bytes obey(std::span<const std::byte> request) {
    const std::string word = text(request);
    if (word == "crash") std::raise(SIGSEGV);
    if (word == "abort") std::abort();
    if (word == "exit") std::exit(0);
    if (word == "eat") return Bytes(std::size_t{1} << 40);
    for (volatile bool is_forever = word == "loop"; is_forever;) {
    }
    if (word == "refuse") throw Error(ErrorCode::kInput, "not this");
    return Bytes(request.begin(), request.end());
}

TEST(ChildProcess, answers_come_back_however_long) {
    ChildProcess child(obey, "gone");
    const std::string large(5000000, 'x');
    EXPECT_EQ(ask(child, "a"), "a");
    EXPECT_EQ(ask(child, ""), "");
    EXPECT_EQ(ask(child, large), large);
}

TEST(ChildProcess, what_the_answer_throws_is_thrown_here_and_the_child_lives_on) {
    ChildProcess child(obey, "gone");
    EXPECT_EQ(ask(child, "refuse"), "Error: not this");
    EXPECT_EQ(ask(child, "b"), "b");
}

TEST(ChildProcess, a_crash_an_endless_loop_and_greed_end_the_child_only) {
    for (const char* request : {"crash", "abort", "exit", "eat", "loop"}) {
        ChildProcess child(obey, "the file is damaged", 1 << 28);
        EXPECT_EQ(ask(child, "a"), "a");
        EXPECT_EQ(ask(child, request), "Error: the file is damaged") << request;
        EXPECT_EQ(ask(child, "a"), "Error: the file is damaged") << "asked again after " << request;
    }
}

TEST(ChildProcess, seconds_count_for_each_answer_anew) {
    const auto work = [](std::span<const std::byte>) {
        const std::clock_t start = std::clock();
        while (std::clock() - start < CLOCKS_PER_SEC / 2) {
        }
        return Bytes();
    };
    ChildProcess child(work, "gone");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(child, "a"), "");
}

TEST(ChildProcess, child_keeps_state_of_its_own_and_leaves_ours_alone) {
    int count = 0;
    ChildProcess child([&count](std::span<const std::byte>) { return bytes(std::to_string(++count)); }, "gone");
    EXPECT_EQ(ask(child, ""), "1");
    EXPECT_EQ(ask(child, ""), "2");
    EXPECT_EQ(count, 0);
}

TEST(ChildProcess, child_holds_no_file_of_ours_open) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ChildProcess child(obey, "gone");
    ::close(ends[1]);
    char byte;
    EXPECT_EQ(::read(ends[0], &byte, 1), 0) << "the pipe has no writer left";
    ::close(ends[0]);
    EXPECT_EQ(ask(child, "a"), "a");
}

TEST(ChildProcess, no_process_is_left_behind) {
    {
        ChildProcess idle(obey, "gone"), asked(obey, "gone");
        ask(asked, "crash");
    }
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(ChildProcess, it_answers_beside_busy_threads) {
    std::atomic<bool> is_done = false;
    std::thread busy([&] {
        while (!is_done) std::vector<int> some(1000);
    });
    for (int i = 0; i < 50; ++i) {
        ChildProcess child(obey, "gone");
        EXPECT_EQ(ask(child, "a"), "a");
    }
    is_done = true;
    busy.join();
}

}  // namespace
}  // namespace regionmesh::formats
