// The memory of the host.
#pragma once

#include <cstdint>
#include <optional>

namespace hyalite {

/// The bytes that can be had without pushing other programs out, where the system tells.
[[nodiscard]] std::optional<std::uint64_t> availableHostBytes();

/// Gives all threads one heap. glibc gives them several, each of which keeps what it once had: a process that renders
/// again and again, with a driver that starts threads each time, would grow by 17 KB a render, to twice of what it
/// needs.
void useOneHeap();

} // namespace hyalite
