// Hashes of scenes and kernels. They are not cryptographic: collisions can be made on purpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hyalite::core {

/// XXH64, the same on every machine. Y. Collet, "xxHash fast digest algorithm", version 0.1.1.
[[nodiscard]] std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);

/// MurmurHash3_x86_32 with the seed 0, as Cryptomatte has it: A. Appleby, "SMHasher",
/// https://github.com/aappleby/smhasher.
[[nodiscard]] std::uint32_t murmurHash3(std::string_view text);

/// As 16 hexadecimal digits: JSON has no numbers of 64 bits.
[[nodiscard]] std::string hashText(std::uint64_t hash);

} // namespace hyalite::core
