#include "tests/fuzz/heap_peak.h"

#include "tests/fuzz/harness.h"

#include <sanitizer/allocator_interface.h>

#include <algorithm>

namespace hyalite::core::fuzz {

namespace {

bool isMeasuring = false;
std::ptrdiff_t allocatedBytes = 0; ///< since the measurement began; what is older may be freed
std::ptrdiff_t peakBytes = 0;

void onAllocation(const volatile void *, std::size_t sizeBytes) {
    if (!isMeasuring)
        return;
    allocatedBytes += static_cast<std::ptrdiff_t>(sizeBytes);
    peakBytes = std::max(peakBytes, allocatedBytes);
}

void onRelease(const volatile void *pointer) {
    if (isMeasuring && pointer != nullptr)
        allocatedBytes -=
            static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(const_cast<const void *>(pointer)));
}

} // namespace

HeapPeak::HeapPeak() {
    static const bool isInstalled = __sanitizer_install_malloc_and_free_hooks(onAllocation, onRelease) != 0;
    require(isInstalled, "the sanitizer takes no allocation hooks");
    allocatedBytes = 0;
    peakBytes = 0;
    isMeasuring = true;
}

HeapPeak::~HeapPeak() { isMeasuring = false; }

std::size_t HeapPeak::bytes() const { return static_cast<std::size_t>(peakBytes); }

} // namespace hyalite::core::fuzz
