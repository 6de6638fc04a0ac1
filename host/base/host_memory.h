// Host memory.
#pragma once

#include <cstdint>
#include <optional>

namespace hyalite::core {

/// Bytes available without swapping out other programs; empty if the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> availableHostBytes();

/// Bytes of address space that a limit (ulimit -v) leaves; empty without a limit.
[[nodiscard]] std::optional<std::uint64_t> addressSpaceLeft();

} // namespace hyalite::core
