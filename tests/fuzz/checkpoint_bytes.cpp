#include "tests/fuzz/checkpoint_bytes.h"

#include "host/base/hash.h"
#include "host/base/input_file.h"
#include "host/film/checkpoint.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace hyalite::core::fuzz {
namespace {

constexpr std::size_t magicBytes = 19;
constexpr std::size_t headBytes = magicBytes + 96;

std::uint32_t numberAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

/// The version of a checkpoint that is written now.
std::uint32_t currentVersion() {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("written", "");
    const Crop crop{0, 1, 0, 1};
    CheckpointWriter(path, {{"seed", "7"}}, {crop, {}, 1, {}}, false).write(Film(crop), {});
    const std::vector<std::byte> head = InputFile(path).head(headBytes);
    return numberAt({reinterpret_cast<const char *>(head.data()), head.size()}, magicBytes);
}

std::string repaired(std::string_view content) {
    static const std::uint32_t version = currentVersion();
    std::string bytes(content);
    if (bytes.size() < headBytes + sizeof(std::uint64_t))
        return bytes;
    std::memcpy(bytes.data() + magicBytes, &version, sizeof version);
    const std::uint64_t identityBytes = numberAt(bytes, magicBytes + 4);
    const std::uint64_t originBytes = numberAt(bytes, magicBytes + 80);
    const std::uint64_t films = std::uint64_t{1} + numberAt(bytes, magicBytes + 76);
    std::span<const std::byte> rest =
        std::as_bytes(std::span(bytes)).first(bytes.size() - sizeof(std::uint64_t));
    std::uint64_t hash = 0;
    const auto take = [&](std::uint64_t count) { // the reader refuses what has less
        const std::span<const std::byte> piece = rest.first(std::min<std::uint64_t>(count, rest.size()));
        hash = hashBytes(piece, hash);
        rest = rest.subspan(piece.size());
    };
    take(headBytes);
    take(identityBytes);
    take(originBytes);
    const std::uint64_t filmBytes = std::max<std::uint64_t>(rest.size() / films, 1);
    for (std::uint64_t film = 0; film < films && (film == 0 || !rest.empty()); ++film)
        take(filmBytes);
    std::memcpy(bytes.data() + bytes.size() - sizeof hash, &hash, sizeof hash);
    return bytes;
}

} // namespace

void readAlsoRepaired(std::string_view content, void (*read)(const TemporaryFolder &, std::string_view)) {
    static const TemporaryFolder folder;
    read(folder, content);
    read(folder, repaired(content));
}

} // namespace hyalite::core::fuzz
