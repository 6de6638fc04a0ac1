// A hash of bytes, to tell by 64 bits whether two things are the same. It finds damage, not forgery.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace hyalite {

/// Four lanes take every fourth word each, so that a processor works on them side by side: several bytes a cycle. Every
/// step is a bijection of the lane or word that goes into it, and so a change of a single word always changes the hash.
/// `seed` chains hashes: hash64(b, hash64(a)) is one of both, in that order.
[[nodiscard]] inline std::uint64_t hash64(std::span<const std::byte> bytes, std::uint64_t seed = 0) {
    static_assert(std::endian::native == std::endian::little, "hashes in files are of little-endian words");
    constexpr std::uint64_t multiplier = 0x9E3779B97F4A7C15; // 2^64 / golden ratio, odd
    // The second product spreads what the first has moved to the high bits, and the rotation down again.
    const auto mix = [](std::uint64_t state, std::uint64_t word) {
        return std::rotl((state ^ word) * multiplier, 31) * multiplier;
    };
    const auto wordAt = [&](std::size_t offset, std::size_t sizeBytes) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + offset, sizeBytes);
        return word;
    };
    std::array<std::uint64_t, 4> lanes{seed, seed + 1, seed + 2, seed + 3};
    std::size_t offset = 0;
    for (; bytes.size() - offset >= 32; offset += 32)
        for (std::size_t lane = 0; lane < 4; ++lane)
            lanes[lane] = mix(lanes[lane], wordAt(offset + 8 * lane, 8));
    std::uint64_t hash = mix(seed, bytes.size());
    for (const std::uint64_t lane : lanes)
        hash = mix(hash, lane);
    for (; bytes.size() - offset >= 8; offset += 8)
        hash = mix(hash, wordAt(offset, 8));
    if (offset < bytes.size())
        hash = mix(hash, wordAt(offset, bytes.size() - offset));
    hash = (hash ^ hash >> 32) * multiplier; // a last word's high bits reach low ones
    hash = (hash ^ hash >> 29) * multiplier;
    return hash ^ hash >> 32;
}

} // namespace hyalite
