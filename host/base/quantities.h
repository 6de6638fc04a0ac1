// Quantities as text for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hyalite::core {

/// "12 s", "3 min 05 s", "2 h 10 min".
[[nodiscard]] std::string durationText(double seconds);

/// In three digits: "192 rays", "12.3 k rays", "2.14 M rays".
[[nodiscard]] std::string roundedText(std::uint64_t count, std::string_view plural);

/// In three digits: "2 %", "0.125 %".
[[nodiscard]] std::string percentText(double share);

/// "512 bytes", "1.5 MiB", "44.0 GiB".
[[nodiscard]] std::string sizeText(std::uint64_t bytes);

/// "1 mesh", "2 meshes".
[[nodiscard]] std::string countText(std::uint64_t count, std::string_view singular, std::string_view plural);

/// The same for words that only take an s: "1 light", "0 lights".
[[nodiscard]] std::string countText(std::uint64_t count, std::string_view singular);

} // namespace hyalite::core
