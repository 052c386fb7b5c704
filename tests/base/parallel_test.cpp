#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "base/parallel_for.h"
#include "base/parallel_in_order.h"
#include "base/parallel_invoke.h"
#include "base/union_find.h"
#include "regionmesh/stop.h"
#include "support/random.h"

namespace regionmesh {
namespace {

TEST(ForChunks, covers_all_once_and_appends_in_order) {
    for (std::uint32_t size : {0u, 1u, 9u, 10u, 11u, 5000u}) {
        for (std::uint32_t threads : {1u, 2u, 5u}) {
            std::vector<std::uint32_t> all;
            for_chunks(
                size, 10, threads,
                [](std::uint32_t first, std::uint32_t end) {
                    std::vector<std::uint32_t> numbers;
                    for (std::uint32_t n = first; n < end; ++n) numbers.push_back(n);
                    EXPECT_LE(numbers.size(), 10u);
                    return numbers;
                },
                [&](const std::vector<std::uint32_t>& numbers) {
                    all.insert(all.end(), numbers.begin(), numbers.end());
                });
            ASSERT_EQ(all.size(), size);
            for (std::uint32_t n = 0; n < size; ++n) ASSERT_EQ(all[n], n);
        }
    }
}

TEST(ParallelInOrder, finishes_in_order_and_gives_each_item_a_place_of_its_own) {
    for (std::uint32_t in_flight : {1u, 2u, 5u})
        for (std::uint32_t threads : {1u, 2u, 8u}) {
            std::vector<std::uint32_t> held(in_flight), order;
            const auto work = [&](std::uint32_t n, std::uint32_t place) { held[place] = n * n; };
            const auto finish = [&](std::uint32_t n, std::uint32_t place) {
                EXPECT_EQ(held[place], n * n);
                order.push_back(n);
            };
            parallel_in_order(1000, in_flight, threads, {work, finish});
            ASSERT_EQ(order.size(), 1000u);
            for (std::uint32_t n = 0; n < 1000; ++n) ASSERT_EQ(order[n], n);
        }
}

TEST(ParallelInOrder, throws_what_a_call_throws) {
    const auto work = [](std::uint32_t n, std::uint32_t) {
        if (n == 7) throw n;
    };
    for (std::uint32_t threads : {1u, 2u})
        EXPECT_THROW(parallel_in_order(20, 4, threads, {work, [](std::uint32_t, std::uint32_t) {}}), std::uint32_t);
}

TEST(ParallelInvoke, runs_both_and_all_parts_of_their_loops) {
    for (const std::uint32_t threads : {1u, 2u, 5u})
        for (std::uint32_t round = 0; round < 50; ++round) {
            std::vector<std::uint32_t> other(200, 0), own(200, 0);
            parallel_invoke(
                threads, [&] { parallel_for(200, threads, [&](std::uint32_t n) { other[n] += n; }); },
                [&] { parallel_for(200, threads, [&](std::uint32_t n) { own[n] += 2 * n; }); });
            for (std::uint32_t n = 0; n < 200; ++n) ASSERT_EQ(other[n] + own[n], 3 * n);
        }
}

TEST(ParallelInvoke, runs_the_second_on_its_own_thread) {
    for (const std::uint32_t threads : {1u, 2u}) {
        const std::thread::id own = std::this_thread::get_id();
        std::thread::id seen;
        parallel_invoke(
            threads, [] {}, [&] { seen = std::this_thread::get_id(); });
        EXPECT_EQ(seen, own);
    }
}

TEST(ParallelInvoke, throws_what_a_call_throws_after_both_have_ended) {
    for (const std::uint32_t threads : {1u, 2u}) {
        std::atomic<bool> is_done = false;
        const auto slow = [&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            is_done = true;
        };
        EXPECT_THROW(parallel_invoke(
                         threads, [] { throw 7; }, slow),
                     int);
        EXPECT_TRUE(is_done);
        std::atomic<bool> is_begun = false, is_ended = false;
        const auto slow_other = [&] {
            is_begun = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            is_ended = true;
        };
        EXPECT_THROW(parallel_invoke(threads, slow_other, [] { throw 7; }), int);
        EXPECT_EQ(is_begun, is_ended);
    }
}

TEST(ParallelInvoke, throws_where_both_throw_at_the_same_time) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the sanitizer does not see libstdc++ count the references to exceptions that oneTBB hands on";
#endif
    for (const std::uint32_t threads : {1u, 2u})
        for (int round = 0; round < 20000; ++round) {
            std::atomic<bool> is_begun = false;
            const auto other = [&] {
                is_begun = true;
                throw 7;
            };
            const auto own = [&] {
                for (int tries = 0; !is_begun && tries < 1000 * (round % 8); ++tries) {
                }
                throw 8;
            };
            EXPECT_THROW(parallel_invoke(threads, other, own), int);
        }
}

TEST(ParallelInvoke, hands_on_the_request_to_stop) {
    for (const std::uint32_t threads : {1u, 2u}) {
        const std::atomic<bool> stop = true;
        const StopScope scope(stop);
        std::uint32_t done = 0;
        EXPECT_THROW(parallel_invoke(
                         threads, [&] { parallel_for(1000, threads, [&](std::uint32_t) { ++done; }); }, [] {}),
                     Stopped);
        EXPECT_EQ(done, 0u);
    }
}

TEST(StopScope, ends_parallel_work_between_parts) {
    for (const std::uint32_t threads : {1u, 2u}) {
        std::atomic<bool> stop = false;
        std::atomic<std::uint32_t> done = 0;
        const StopScope scope(stop);
        EXPECT_THROW(parallel_for(1000, threads, [&](std::uint32_t) { stop = ++done == 10 || stop; }), Stopped);
        EXPECT_LT(done, 20u);
        done = 0;
        EXPECT_THROW(parallel_in_order(1000, 4, threads, {[&](auto, auto) { ++done; }, [](auto, auto) {}}), Stopped);
        EXPECT_EQ(done, 0u);
    }
}

TEST(StopScope, holds_for_its_thread_while_it_lives) {
    std::atomic<bool> stop = true, go_on = false;
    std::uint32_t done = 0;
    const auto count = [&](std::uint32_t) { ++done; };
    {
        const StopScope outer(stop);
        {
            const StopScope inner(go_on);
            parallel_for(3, 1, count);
        }
        EXPECT_THROW(parallel_for(3, 1, count), Stopped);
    }
    parallel_for(3, 1, count);
    EXPECT_EQ(done, 6u);
}

TEST(StopScope, of_one_caller_does_not_stop_others) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the sanitizer does not see libstdc++ count the references to exceptions that oneTBB hands on";
#endif
    // More callers than the arena has room for, so that some of their calls are made on threads of others.
    constexpr std::uint32_t kCallers = 8, kRounds = 50;
    std::vector<std::uint32_t> stopped(kCallers, 0);
    const auto call = [&](std::uint32_t caller) {
        std::atomic<bool> stop = false;
        const StopScope scope(stop);
        const auto part = [&](std::uint32_t) { parallel_for(4, 2, [](std::uint32_t) {}); };
        const auto loop = [&] { parallel_for(20, 2, part); };
        const auto loop_and_stop = [&] {
            loop();
            stop = caller % 2 == 1;
            loop();
        };
        for (std::uint32_t round = 0; round < kRounds; ++round) {
            stop = false;
            try {
                parallel_invoke(2, loop, loop_and_stop);
            } catch (const Stopped&) {
                ++stopped[caller];
            }
        }
    };
    std::vector<std::thread> callers;
    for (std::uint32_t n = 0; n < kCallers; ++n) callers.emplace_back(call, n);
    for (std::thread& caller : callers) caller.join();
    for (std::uint32_t n = 0; n < kCallers; ++n) EXPECT_EQ(stopped[n], n % 2 == 1 ? kRounds : 0) << "caller " << n;
}

TEST(ForChunks, rounds_sums_alike_on_any_number_of_threads) {
    const auto sum_on = [](std::uint32_t threads) {
        double sum = 0;
        for_chunks(
            100000, 64, threads,
            [](std::uint32_t first, std::uint32_t end) {
                double part = 0;
                for (std::uint32_t n = first; n < end; ++n) part += 1 / (n + 0.1);
                return part;
            },
            [&](double part) { sum += part; });
        return sum;
    };
    for (std::uint32_t threads : {2u, 3u, 8u}) EXPECT_EQ(sum_on(threads), sum_on(1));
}

TEST(UnionFind, joined_by_several_threads_is_as_joined_by_one) {
    constexpr std::uint32_t kSize = 100000, kChunk = 1000;
    UnionFind one(kSize), many(kSize);
    const auto join = [](UnionFind& sets, std::uint32_t chunk) {
        test::Random random(chunk);
        for (std::uint32_t n = 0; n < kChunk; ++n) {
            const std::uint32_t a = random.below(kSize);
            sets.join(a, random.below(2) ? random.below(kSize) : a / 2);
        }
    };
    for (std::uint32_t chunk = 0; chunk < 60; ++chunk) join(one, chunk);
    parallel_for(60, 8, [&](std::uint32_t chunk) { join(many, chunk); });
    for (std::uint32_t n = 0; n < kSize; ++n) {
        ASSERT_EQ(one.find(n), many.find(n));
        ASSERT_LE(one.find(n), n) << "the smallest is the root";
        ASSERT_EQ(one.is_root(n), one.find(n) == n);
    }
}

TEST(ParallelFor, keeps_no_memory_however_often_it_is_called) {
    const auto resident_pages = [] {
        std::uint64_t all = 0, resident = 0;
        std::ifstream("/proc/self/statm") >> all >> resident;
        return resident;
    };
    std::atomic<std::uint64_t> sum = 0;
    const auto call = [&] {
        for (int n = 0; n < 3000; ++n) parallel_for(40, 2, [&](std::uint32_t item) { sum += item; });
    };
    call();
    const std::uint64_t before = resident_pages();
    call();
    EXPECT_EQ(sum, 2u * 3000 * 780);
    // An arena for each call kept 7 kB of it: 22 MB.
    EXPECT_LT(resident_pages(),
              before + (std::uint64_t{4} << 20) / static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace
}  // namespace regionmesh
