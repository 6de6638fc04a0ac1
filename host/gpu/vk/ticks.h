// Arithmetic on device clock ticks, a counter of 36 to 64 bits that wraps around.
#pragma once

#include <cassert>
#include <cstdint>

namespace hyalite::core::gpu {

/// Mask of the valid bits of a timestamp. `validBits` is in [1, 64].
[[nodiscard]] inline std::uint64_t validTicks(std::uint64_t ticks, std::uint32_t validBits) {
    assert(validBits >= 1 && validBits <= 64);
    return validBits >= 64 ? ticks : ticks & ((std::uint64_t{1} << validBits) - 1);
}

/// Ticks from one timestamp to a later one. The counter may have wrapped around several times. Of all durations that
/// match the bits, this is the longest up to `maxTicks`, or the shortest if all are longer.
[[nodiscard]] inline std::uint64_t elapsedTicks(std::uint64_t begin, std::uint64_t end,
                                                std::uint32_t validBits, std::uint64_t maxTicks) {
    const std::uint64_t shortest = validTicks(end - begin, validBits);
    if (validBits >= 64 || maxTicks < shortest)
        return shortest;
    return shortest + ((maxTicks - shortest) >> validBits << validBits);
}

/// Ticks from a reference to a timestamp, which may be earlier. Of all differences that match the bits, this is the one
/// with the smallest magnitude.
[[nodiscard]] inline std::int64_t signedTicks(std::uint64_t reference, std::uint64_t ticks,
                                              std::uint32_t validBits) {
    const std::uint64_t forward = validTicks(ticks - reference, validBits);
    const std::uint64_t backward = validTicks(reference - ticks, validBits);
    return forward <= backward ? static_cast<std::int64_t>(forward) : -static_cast<std::int64_t>(backward);
}

} // namespace hyalite::core::gpu
