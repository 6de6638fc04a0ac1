#include "host/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace hyalite::core {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH64(bytes.data(), bytes.size(), seed);
}

std::string hashText(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace hyalite::core
