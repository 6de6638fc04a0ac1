#include "host/import/whole_file.h"

#include "host/base/input_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>

namespace hyalite::core {

std::vector<char> readWholeFile(const std::filesystem::path &file) {
    constexpr std::uint64_t maxFileBytes = 0xFFFF'FFFF;
    const InputFile input(file);
    if (input.sizeBytes() > maxFileBytes)
        throw input.bad(
            fmt::format("has {} bytes; at most {} (4 GiB) are read", input.sizeBytes(), maxFileBytes));
    std::vector<char> bytes(static_cast<std::size_t>(input.sizeBytes()));
    input.read(0, std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

} // namespace hyalite::core
