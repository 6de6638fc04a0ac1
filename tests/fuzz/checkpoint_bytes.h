// Checkpoints and parts as one who makes them up would.
#pragma once

#include "tests/fuzz/harness.h"

#include <string_view>

namespace hyalite::core::fuzz {

/// Calls `read` twice, with a folder for its files: with the input as it is; and, if it has a header, with the version
/// that this program writes and the hash that belongs to the bytes, so that what is behind both is read.
void readAlsoRepaired(std::string_view content, void (*read)(const TemporaryFolder &, std::string_view));

} // namespace hyalite::core::fuzz
