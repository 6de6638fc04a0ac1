#include "host/base/host_memory.h"

#include <fstream>
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

} // namespace hyalite
