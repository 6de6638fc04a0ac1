// Atomic file: it appears complete or not at all.
//
// The bytes go into a temporary file in the target's folder; commit() puts it in the target's place with one rename.
// A failure at any moment, from a full disk to a killed process, leaves the previous file unchanged. The
// temporary file has no name until commit() where the file system offers that (O_TMPFILE): a process that is killed
// then leaves nothing behind.
//
// "-" is standard output, which gets all bytes at once, by commit(): formats fill in their tables at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// The target of `path`, which may be a link, even a dangling one, where canonical() fails and open() would create a
/// file. Of links in a circle it is one of them. Parent folders may still be links.
[[nodiscard]] std::filesystem::path followLinks(std::filesystem::path path);

/// Whether the temporary file has a name from the start. Automatic: only where it must.
enum class TemporaryFile { Automatic, Named };

class AtomicFile {
  public:
    /// Creates the temporary file, so that an output that cannot be written fails before any work is done.
    /// A symbolic link is followed, even a dangling one: the file that it points at is replaced, the link stays.
    /// The new file has the permissions of any new file (0666 less the umask), whatever the old one had.
    /// Throws Error{OutputNotWritten} for a target that exists and is not a regular file (a folder, a device, a
    /// pipe), that is write-protected, or whose folder is missing or takes no new file; for standard output, where that
    /// is a terminal.
    explicit AtomicFile(const std::filesystem::path &target, TemporaryFile kind = TemporaryFile::Automatic);

    /// A file in memory, which is never committed, for who wants the bytes; `path` is the name in messages. Throws
    /// Error{OutputNotWritten}.
    [[nodiscard]] static AtomicFile inMemory(const std::filesystem::path &path);

    AtomicFile(AtomicFile &&other) noexcept;
    AtomicFile &operator=(AtomicFile &&other) noexcept;
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// Removes the temporary file if it was not committed.
    ~AtomicFile();

    /// Appends. Throws Error{OutputNotWritten}; after that the file can only be discarded.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// Writes at an offset, over existing bytes or beyond them, for formats that fill in a table at the end. The
    /// position of write() does not change. Throws Error{OutputNotWritten} likewise.
    void writeAt(std::uint64_t offsetBytes, std::span<const std::byte> bytes);

    /// What was written to a file in memory. Throws Error{OutputNotWritten}.
    [[nodiscard]] std::vector<std::byte> contents() const;

    /// Syncs the bytes to disk and renames the file over the target. Call it at most once, as the last operation.
    /// Throws Error{OutputNotWritten}.
    void commit();

    /// The target as it was given, for messages.
    [[nodiscard]] const std::filesystem::path &path() const { return givenPath_; }

  private:
    AtomicFile() = default;
    /// Calls `create` with unused names in the target's folder until it makes one of them a file, and keeps that name.
    /// `create` returns whether it did and sets errno if not. Returns errno, or 0.
    template <class Create> [[nodiscard]] int claimName(const Create &create);
    void discard() noexcept;
    void writeAll(int descriptor, std::span<const std::byte> bytes) const;
    void readBack(const std::function<void(std::span<const std::byte>)> &take) const;

    std::filesystem::path givenPath_;
    std::filesystem::path targetPath_;    ///< absolute, links followed
    std::filesystem::path temporaryPath_; ///< empty while the temporary file has no name
    int descriptor_ = -1;                 ///< -1 once committed, discarded or moved from
};

} // namespace hyalite::core
