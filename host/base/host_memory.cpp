#include "host/base/host_memory.h"

#include <fstream>
#include <limits>
#include <string>

#include <malloc.h>

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

} // namespace hyalite
