// Independent work on several threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace regionmesh {

/// Calls work(n) for n = 0 .. count - 1 on at most `threads` threads (0: one per core), in any order. Requires that
/// calls do not share mutable data. Rethrows the exception of a call, or Stopped (regionmesh/stop.h).
void parallel_for(std::uint32_t count, std::uint32_t threads, const std::function<void(std::uint32_t)>& work);

/// The same for calls that take little time: `chunk` of them, one after the other, are the work of a thread at a time.
template <class Work>
void for_each_index(std::uint32_t size, std::uint32_t chunk, std::uint32_t threads, Work&& work) {
    parallel_for(size / chunk + (size % chunk != 0), threads, [&](std::uint32_t n) {
        const std::uint32_t first = n * chunk, end = first + std::min(chunk, size - first);
        for (std::uint32_t i = first; i < end; ++i) work(i);
    });
}

/// Calls find(first, end) for the chunks of [0, size) on several threads, and append(result) for each result in order
/// of the chunks. So the outcome does not depend on the threads, not even in the rounding of a sum. Holds the results
/// of a few hundred chunks at a time.
template <class Find, class Append>
void for_chunks(std::uint32_t size, std::uint32_t chunk, std::uint32_t threads, Find&& find, Append&& append) {
    constexpr std::uint32_t kWave = 256;
    const std::uint32_t chunks = size / chunk + (size % chunk != 0);
    std::vector<std::invoke_result_t<Find&, std::uint32_t, std::uint32_t>> found(std::min(chunks, kWave));
    for (std::uint32_t done = 0; done < chunks; done += kWave) {
        const std::uint32_t wave = std::min(kWave, chunks - done);
        parallel_for(wave, threads, [&](std::uint32_t n) {
            const std::uint32_t first = (done + n) * chunk;
            found[n] = find(first, first + std::min(chunk, size - first));
        });
        for (std::uint32_t n = 0; n < wave; ++n) append(std::move(found[n]));
    }
}

}  // namespace regionmesh
