// Input file: a regular file that is read piece by piece, so that its contents can be checked before memory is
// allocated. All files that a user or a scene names are opened here. Or one that is in memory already: a file inside
// another one, or standard input.
#pragma once

#include "host/base/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

class InputFile {
  public:
    /// Throws Error{BadInput} if there is no such file, it cannot be read, or it is a folder, device, pipe or socket,
    /// which are never opened or waited for. "-" is standard input, as standardInput() reads it.
    explicit InputFile(const std::filesystem::path &path);
    /// A file inside another one. `name` is for messages; the contents outlive the object.
    InputFile(std::filesystem::path name, std::span<const std::byte> contents);
    InputFile(const InputFile &) = delete;
    InputFile &operator=(const InputFile &) = delete;
    ~InputFile();

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }
    /// The size when the file was opened: bytes appended later are not read.
    [[nodiscard]] std::uint64_t sizeBytes() const { return sizeBytes_; }

    /// Fills `destination` from `offsetBytes`; the range lies within sizeBytes(). Throws Error{BadInput} where the
    /// file fails or has become shorter since it was opened.
    void read(std::uint64_t offsetBytes, std::span<std::byte> destination) const;

    /// The first `countBytes`, or the whole file if it is shorter.
    [[nodiscard]] std::vector<std::byte> head(std::size_t countBytes) const;

    /// The error for unusable contents: "FILE: found".
    [[nodiscard]] Error bad(const std::string &found) const;

  private:
    std::filesystem::path path_;
    std::uint64_t sizeBytes_ = 0;
    int descriptor_ = -1; ///< -1: in memory
    std::span<const std::byte> contents_{};
};

} // namespace hyalite::core
