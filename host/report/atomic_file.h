// A file that appears whole or not at all.
//
// The bytes go into a temporary file beside the target; commit() puts it in the target's place with one rename. A
// failure at any moment, from a full disk to a killed process, leaves the file that was there before as it was.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace hyalite {

class AtomicFile {
  public:
    /// Creates the temporary file, and so finds out before any work is done whether the output can be written.
    /// A symbolic link is followed, even a dangling one: the file that it points at is replaced, the link stays.
    /// The new file has the permissions of any new file (0666 less the umask), whatever the old one had.
    /// Throws Error{OutputNotWritten} for a target that exists and is not a regular file (a folder, a device, a
    /// pipe), that is write-protected, or whose folder is missing or takes no new file.
    explicit AtomicFile(const std::filesystem::path &target);

    AtomicFile(AtomicFile &&other) noexcept;
    AtomicFile &operator=(AtomicFile &&other) noexcept;
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// Removes the temporary file if it was not committed.
    ~AtomicFile();

    /// Appends. Throws Error{OutputNotWritten}, after which the file can only be dropped.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// Stores the bytes durably and renames them over the target. At most once, and nothing is written after it.
    /// Throws Error{OutputNotWritten}.
    void commit();

    /// The target as it was given, for messages.
    [[nodiscard]] const std::filesystem::path &path() const { return givenPath_; }

  private:
    void discard() noexcept;

    std::filesystem::path givenPath_;
    std::filesystem::path targetPath_; ///< absolute, links followed
    std::filesystem::path temporaryPath_;
    int descriptor_ = -1; ///< -1 once committed, discarded or moved from
};

} // namespace hyalite
