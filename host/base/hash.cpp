#include "host/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>

namespace hyalite::core {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH64(bytes.data(), bytes.size(), seed);
}

std::uint32_t murmurHash3(std::string_view text) {
    const auto scrambled = [](std::uint32_t word) { return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u; };
    // Little-endian words, the last one filled up with zeros.
    const auto wordAt = [&](std::size_t first) {
        std::uint32_t word = 0;
        for (std::size_t i = first; i < std::min(first + 4, text.size()); ++i)
            word |= std::uint32_t{static_cast<unsigned char>(text[i])} << 8 * (i - first);
        return word;
    };
    std::uint32_t hash = 0;
    const std::size_t wholeBytes = text.size() / 4 * 4;
    for (std::size_t i = 0; i < wholeBytes; i += 4)
        hash = std::rotl(hash ^ scrambled(wordAt(i)), 13) * 5 + 0xe6546b64u;
    hash ^= scrambled(wordAt(wholeBytes));
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

std::string hashText(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace hyalite::core
