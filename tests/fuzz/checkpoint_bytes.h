// Checkpoints and parts as one who makes them up would.
#pragma once

#include <string>
#include <string_view>

namespace hyalite::fuzz {

/// With the version that this program writes and the hash that belongs to the bytes, if they have a header: what is
/// behind both is then read.
[[nodiscard]] std::string repaired(std::string_view content);

} // namespace hyalite::fuzz
