#include "host/process/heap.h"

#include "host/base/huge_pages.h"

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <mutex>

#include <malloc.h>
#include <unistd.h>

namespace hyalite::core {

void useOneHeap() {
#ifdef M_ARENA_MAX
    mallopt(M_ARENA_MAX, 1);
#endif
}

void keepFreedMemory([[maybe_unused]] int sizeBytes) {
#ifdef M_TRIM_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, sizeBytes);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

void reserveHeap() {
#ifdef M_TOP_PAD
    static std::once_flag isReserved;
    std::call_once(isReserved, [] {
        constexpr int reservedBytes = 64 << 20;
        constexpr int stepBytes = 1 << 20;
        constexpr std::size_t pieceBytes = 3 << 20; // from the heap, and more than it has left
        mallopt(M_TOP_PAD, reservedBytes);
        auto *const begin = static_cast<std::byte *>(sbrk(0));
        void *volatile piece = std::malloc(pieceBytes); // volatile: it must not be optimised away
        std::free(piece);
        mallopt(M_TOP_PAD, stepBytes); // where memory is limited, later steps have to be small
        preferHugePages(begin, static_cast<std::size_t>(static_cast<std::byte *>(sbrk(0)) - begin));
    });
#endif
}

} // namespace hyalite::core
