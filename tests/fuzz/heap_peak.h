// How much of the heap a call takes at its worst, as the address sanitizer's allocator sees it.
#pragma once

#include <cstddef>

namespace hyalite::core::fuzz {

/// Starts a measurement: the most bytes that are allocated at once from now on, beyond what is allocated now. Only
/// one at a time, and while no other thread runs.
class HeapPeak {
  public:
    HeapPeak();
    HeapPeak(const HeapPeak &) = delete;
    HeapPeak &operator=(const HeapPeak &) = delete;
    ~HeapPeak();

    [[nodiscard]] std::size_t bytes() const;
};

} // namespace hyalite::core::fuzz
