#include "host/base/host_memory.h"

#include "host/base/huge_pages.h"

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include <malloc.h>
#include <unistd.h>

namespace hyalite {

std::optional<std::uint64_t> availableHostBytes() {
    std::ifstream stream("/proc/meminfo");
    for (std::string key, rest; stream >> key; std::getline(stream, rest))
        if (std::uint64_t kibibytes = 0; key == "MemAvailable:" && stream >> kibibytes)
            return kibibytes * 1024;
    return std::nullopt;
}

void useOneHeap() {
#ifdef M_ARENA_MAX
    mallopt(M_ARENA_MAX, 1);
#endif
}

void keepFreedMemory() {
#ifdef M_TRIM_THRESHOLD
    constexpr int leastGivenBack = 4 << 20;
    mallopt(M_MMAP_THRESHOLD, leastGivenBack);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

void reserveHeap() {
#ifdef M_TOP_PAD
    constexpr int stepBytes = 64 << 20;
    constexpr std::size_t beyondBeginning = 1 << 20; // more than the heap of a process begins with
    mallopt(M_TOP_PAD, stepBytes);
    auto *const begin = static_cast<std::byte *>(sbrk(0));
    void *volatile piece = std::malloc(beyondBeginning); // volatile: it must not be optimised away
    std::free(piece);
    preferHugePages(begin, static_cast<std::size_t>(static_cast<std::byte *>(sbrk(0)) - begin));
#endif
}

} // namespace hyalite
