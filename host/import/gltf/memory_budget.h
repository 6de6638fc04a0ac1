// Memory budget: what a glTF file may take, in proportion to its size.
//
// Objects of a glTF file refer to each other by index, so a small file could name a large accessor a million times.
#pragma once

#include "host/base/json_reader.h"

#include <fmt/format.h>

#include <cstdint>

namespace hyalite::core::gltf {

class MemoryBudget {
  public:
    static constexpr std::uint64_t base = std::uint64_t{256} << 20;
    static constexpr std::uint64_t perByte = 64;

    /// A file was read.
    void addFile(std::uint64_t sizeBytes) { allowed_ += perByte * sizeBytes; }

    /// Throws Error{BadInput} at the node if `sizeBytes` more are too much.
    void take(std::uint64_t sizeBytes, const JsonNode &node) {
        if (sizeBytes > allowed_ - taken_)
            node.fail(
                fmt::format("takes {} bytes of memory besides {} before it; allowed: {} in all, which is "
                            "256 MiB and 64 times the size of the files",
                            sizeBytes, taken_, allowed_));
        taken_ += sizeBytes;
    }

  private:
    std::uint64_t allowed_ = base;
    std::uint64_t taken_ = 0;
};

} // namespace hyalite::core::gltf
