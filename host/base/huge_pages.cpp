#include "host/base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace hyalite::core {

void preferHugePages(void *begin, std::size_t sizeBytes) noexcept {
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const std::size_t skipped = (hugePageBytes - address % hugePageBytes) % hugePageBytes;
    if (sizeBytes < skipped + hugePageBytes)
        return;
    const std::size_t wholeBytes = (sizeBytes - skipped) / hugePageBytes * hugePageBytes;
    static_cast<void>(madvise(static_cast<std::byte *>(begin) + skipped, wholeBytes, MADV_HUGEPAGE));
}

} // namespace hyalite::core
