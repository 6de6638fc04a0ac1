#include "host/base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace hyalite::core {

namespace {

constexpr std::size_t hugePageBytes = std::size_t{2} << 20;

} // namespace

void preferHugePages(void *begin, std::size_t sizeBytes) noexcept {
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const std::size_t skipped = (hugePageBytes - address % hugePageBytes) % hugePageBytes;
    if (sizeBytes < skipped + hugePageBytes)
        return;
    const std::size_t wholeBytes = (sizeBytes - skipped) / hugePageBytes * hugePageBytes;
    static_cast<void>(madvise(static_cast<std::byte *>(begin) + skipped, wholeBytes, MADV_HUGEPAGE));
}

} // namespace hyalite::core

// The sanitizers have operators of their own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HYALITE_KEEPS_NEW
#endif
#endif
#if !defined(HYALITE_KEEPS_NEW) && !defined(__SANITIZE_ADDRESS__)

namespace {

constexpr std::size_t largeBytes =
    hyalite::core::hugePageBytes / 2; // so that less than half of a page lies idle

void *allocate(std::size_t sizeBytes) noexcept {
    if (sizeBytes < largeBytes)
        return std::malloc(sizeBytes > 0 ? sizeBytes : 1);
    if (sizeBytes > static_cast<std::size_t>(PTRDIFF_MAX))
        return nullptr; // rounded up it could begin at 0 again
    const std::size_t pages = sizeBytes / hyalite::core::hugePageBytes + 1;
    void *memory = nullptr;
    if (posix_memalign(&memory, hyalite::core::hugePageBytes, pages * hyalite::core::hugePageBytes) != 0)
        return nullptr;
    hyalite::core::preferHugePages(memory, pages * hyalite::core::hugePageBytes);
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
