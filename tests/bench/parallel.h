// All threads of this machine on one array, for what is timed beside a device that uses all of them too.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace hyalite::core::bench {

[[nodiscard]] inline unsigned threadCount() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls body(begin, end) for ranges of at most `chunk` of `count` items, on all threads at once. OpenMP is not used,
/// as its threads go on spinning for some time: in the way of what is timed next.
template <class Body> void inChunks(std::size_t count, std::size_t chunk, const Body &body) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t begin = next.fetch_add(chunk); begin < count; begin = next.fetch_add(chunk))
            body(begin, std::min(begin + chunk, count));
    };
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threadCount(); ++i)
        helpers.emplace_back(work);
    work();
}

} // namespace hyalite::core::bench
