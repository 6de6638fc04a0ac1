// `operator new` for a whole program: huge pages for large arrays. A library must not replace it for who calls it.
#include "host/base/huge_pages.h"

#include <cstdint>
#include <cstdlib>
#include <new>

// The sanitizers have operators of their own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HYALITE_KEEPS_NEW
#endif
#endif
#if !defined(HYALITE_KEEPS_NEW) && !defined(__SANITIZE_ADDRESS__)

namespace {

using hyalite::core::hugePageBytes;
using hyalite::core::preferHugePages;

constexpr std::size_t largeBytes = hugePageBytes / 2; // so that less than half of a page lies idle

void *allocate(std::size_t sizeBytes) noexcept {
    if (sizeBytes < largeBytes)
        return std::malloc(sizeBytes > 0 ? sizeBytes : 1);
    if (sizeBytes > static_cast<std::size_t>(PTRDIFF_MAX))
        return nullptr; // rounded up it could begin at 0 again
    const std::size_t pages = sizeBytes / hugePageBytes + 1;
    void *memory = nullptr;
    if (posix_memalign(&memory, hugePageBytes, pages * hugePageBytes) != 0)
        return nullptr;
    preferHugePages(memory, pages * hugePageBytes);
    return memory;
}

} // namespace

// The other forms of both end in these, except for types of unusual alignment.
void *operator new(std::size_t sizeBytes) {
    for (;;) {
        if (void *memory = allocate(sizeBytes))
            return memory;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr)
            throw std::bad_alloc();
        handler();
    }
}

void operator delete(void *memory) noexcept { std::free(memory); }

void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
#endif
