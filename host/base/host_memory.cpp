#include "host/base/host_memory.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace hyalite::core {

std::optional<std::uint64_t> availableHostBytes() {
    std::ifstream stream("/proc/meminfo");
    for (std::string key, rest; stream >> key; std::getline(stream, rest))
        if (std::uint64_t kibibytes = 0; key == "MemAvailable:" && stream >> kibibytes)
            return kibibytes * 1024;
    return std::nullopt;
}

std::optional<std::uint64_t> addressSpaceLeft() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::nullopt;
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<std::uint64_t>(used, limit.rlim_cur);
}

} // namespace hyalite::core
