#include "host/base/atomic_file.h"

#include "host/base/error.h"
#include "host/base/standard_stream.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path &path, const std::string &reason) {
    throw Error(ErrorKind::OutputNotWritten, fmt::format("cannot write '{}': {}", path.string(), reason));
}

std::string remedyFor(int errorNumber) {
    switch (errorNumber) {
    case ENOENT:
        return "create the folder first, or name one that exists";
    case ENOTDIR:
        return "a part of the path is a file, not a folder; name another path";
    case EACCES:
    case EPERM:
        return "make the folder writable, or name another one";
    case EROFS:
        return "the file system is read-only; name another folder";
    case ENOSPC:
    case EDQUOT:
        return "free some space, or name a folder on another disk";
    case EFBIG:
        return "raise the limit on file sizes (ulimit -f), or write less";
    case ENAMETOOLONG:
        return "choose a shorter name";
    case EMFILE:
    case ENFILE:
        return "close other files, or raise the limit (ulimit -n)";
    default:
        return "check the disk, or name another folder";
    }
}

[[noreturn]] void refuseWithErrno(const fs::path &path, std::string_view step, int errorNumber) {
    refuse(path, fmt::format("{}: {}; {}", step, std::generic_category().message(errorNumber),
                             remedyFor(errorNumber)));
}

void requireReplaceable(const fs::path &givenPath, const fs::path &targetPath) {
    std::error_code error;
    if (fs::is_symlink(targetPath, error))
        refuse(givenPath, "its symbolic links lead in a circle; remove them, or name another file");
    if (!targetPath.has_filename())
        refuse(givenPath, "this names no file; add a file name");
    struct stat status {};
    if (stat(targetPath.c_str(), &status) != 0) {
        if (errno == ENAMETOOLONG) // an unnamed file could be created all the same
            refuseWithErrno(givenPath, "its name cannot be used", ENAMETOOLONG);
        return;
    }
    if (S_ISDIR(status.st_mode))
        refuse(givenPath, "it is a folder; name a file in it");
    if (!S_ISREG(status.st_mode)) {
        refuse(givenPath,
               "it is not a regular file but a device, pipe or socket, and results replace files as a "
               "whole; name a regular file");
    }
    // rename() would replace a write-protected file, which the user wants to keep.
    if (faccessat(AT_FDCWD, targetPath.c_str(), W_OK, AT_EACCESS) != 0)
        refuse(givenPath, "it exists and is write-protected; remove it, or name another file");
    struct stat folder {};
    const uid_t user = geteuid();
    if (stat(targetPath.parent_path().c_str(), &folder) == 0 && (folder.st_mode & S_ISVTX) != 0 &&
        user != 0 && user != status.st_uid && user != folder.st_uid) {
        refuse(givenPath,
               "it belongs to another user, whose files nobody else may replace in this folder; name "
               "another file");
    }
}

std::string temporaryName(const std::string &targetName, std::random_device &random) {
    // A target name of up to 255 bytes is legal, so only a part of it fits beside the suffix.
    constexpr std::size_t prefixBytesMax = 200;
    const std::uint64_t number = (std::uint64_t{random()} << 32) | random();
    return fmt::format(".{}.{:016x}.tmp", targetName.substr(0, prefixBytesMax), number);
}

/// The path under which linkat() finds the open unnamed file.
std::string descriptorPath(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// An unnamed file on the file system of the folder, or -1 if that is not supported.
int openUnnamed(const fs::path &folder) {
    const int descriptor = open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    if (descriptor >= 0 && access(descriptorPath(descriptor).c_str(), F_OK) != 0) { // no /proc
        close(descriptor);
        return -1;
    }
    return descriptor;
}

/// The descriptor of a file in memory.
int openInMemory(const fs::path &givenPath) {
    const int descriptor = memfd_create("hyalite", MFD_CLOEXEC);
    if (descriptor < 0)
        refuseWithErrno(givenPath, "no file can be created in memory", errno);
    return descriptor;
}

/// fsync; a file system without support for it counts as success. Returns errno, or 0.
int synchronize(int descriptor) {
    while (fsync(descriptor) != 0) {
        if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP)
            return 0;
        if (errno != EINTR)
            return errno;
    }
    return 0;
}

} // namespace

fs::path followLinks(fs::path path) {
    constexpr int linkCountMax = 40; // as Linux does
    std::error_code error;
    for (int linkCount = 0; linkCount < linkCountMax && fs::is_symlink(path, error); ++linkCount)
        path = path.parent_path() / fs::read_symlink(path, error); // an absolute target replaces the parent
    return path;
}

template <class Create> int AtomicFile::claimName(const Create &create) {
    std::random_device random;
    constexpr int attemptCount = 16; // an attempt fails only if a 64-bit random number is already in use
    int errorNumber = EEXIST;
    for (int attempt = 0; attempt < attemptCount && (errorNumber == EEXIST || errorNumber == EINTR);
         ++attempt) {
        const fs::path path =
            targetPath_.parent_path() / temporaryName(targetPath_.filename().string(), random);
        if (create(path)) {
            temporaryPath_ = path;
            return 0;
        }
        errorNumber = errno;
    }
    return errorNumber;
}

AtomicFile::AtomicFile(const fs::path &target, TemporaryFile kind) : givenPath_(target) {
    if (target.empty())
        refuse(target, "the name is empty; name a file");
    if (isStandardStream(target)) {
        if (isatty(STDOUT_FILENO) != 0)
            refuse(target, "standard output is a terminal; lead it into a file or a program (> FILE)");
        descriptor_ = openInMemory(target);
        return;
    }
    std::error_code error; // errors in the path show when the file is created
    targetPath_ = followLinks(fs::absolute(target, error));
    requireReplaceable(givenPath_, targetPath_);

    if (kind == TemporaryFile::Automatic)
        descriptor_ = openUnnamed(targetPath_.parent_path());
    if (descriptor_ >= 0)
        return;
    // Whatever the failure: a named file is tried next, and its error is the one to report.
    const int errorNumber = claimName([this](const fs::path &path) {
        descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        return descriptor_ >= 0;
    });
    if (errorNumber != 0) {
        refuseWithErrno(givenPath_,
                        fmt::format("no file can be created in '{}'", targetPath_.parent_path().string()),
                        errorNumber);
    }
}

AtomicFile AtomicFile::inMemory(const fs::path &path) {
    AtomicFile file;
    file.givenPath_ = path;
    file.descriptor_ = openInMemory(path);
    return file;
}

AtomicFile::AtomicFile(AtomicFile &&other) noexcept
    : givenPath_(std::move(other.givenPath_)), targetPath_(std::move(other.targetPath_)),
      temporaryPath_(std::move(other.temporaryPath_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile &AtomicFile::operator=(AtomicFile &&other) noexcept {
    if (this != &other) {
        discard();
        givenPath_ = std::move(other.givenPath_);
        targetPath_ = std::move(other.targetPath_);
        temporaryPath_ = std::move(other.temporaryPath_);
        descriptor_ = std::exchange(other.descriptor_, -1);
    }
    return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
    if (descriptor_ >= 0) {
        close(descriptor_);
        if (!temporaryPath_.empty())
            unlink(temporaryPath_.c_str());
        descriptor_ = -1;
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    assert(descriptor_ >= 0);
    writeAll(descriptor_, bytes);
}

void AtomicFile::writeAll(int descriptor, std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count >= 0)
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            refuseWithErrno(givenPath_, fmt::format("writing {} bytes", bytes.size()), errno);
    }
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void AtomicFile::writeAt(std::uint64_t offsetBytes, std::span<const std::byte> bytes) {
    assert(descriptor_ >= 0);
    while (!bytes.empty()) {
        const ssize_t count =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offsetBytes));
        if (count >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
            offsetBytes += static_cast<std::uint64_t>(count);
        } else if (errno != EINTR) {
            refuseWithErrno(givenPath_, fmt::format("writing {} bytes", bytes.size()), errno);
        }
    }
}

void AtomicFile::readBack(const std::function<void(std::span<const std::byte>)> &take) const {
    std::array<std::byte, std::size_t{1} << 16> buffer;
    off_t offset = 0;
    while (true) {
        const ssize_t count = pread(descriptor_, buffer.data(), buffer.size(), offset);
        if (count < 0)
            refuseWithErrno(givenPath_, "reading what was written", errno);
        if (count == 0)
            return;
        offset += count;
        take(std::span(buffer).first(static_cast<std::size_t>(count)));
    }
}

std::vector<std::byte> AtomicFile::contents() const {
    std::vector<std::byte> bytes;
    readBack([&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); });
    return bytes;
}

void AtomicFile::commit() {
    assert(descriptor_ >= 0);
    if (isStandardStream(givenPath_)) {
        readBack([this](std::span<const std::byte> part) { writeAll(STDOUT_FILENO, part); });
        discard();
        return;
    }
    if (const int errorNumber = synchronize(descriptor_); errorNumber != 0)
        refuseWithErrno(givenPath_, "storing the bytes", errorNumber);
    if (temporaryPath_.empty()) {
        const int errorNumber = claimName([this](const fs::path &path) {
            return linkat(AT_FDCWD, descriptorPath(descriptor_).c_str(), AT_FDCWD, path.c_str(),
                          AT_SYMLINK_FOLLOW) == 0;
        });
        if (errorNumber != 0)
            refuseWithErrno(givenPath_, "naming the finished file", errorNumber);
    }
    if (close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) { // network file systems report late
        const int errorNumber = errno;
        unlink(temporaryPath_.c_str());
        refuseWithErrno(givenPath_, "closing the file", errorNumber);
    }
    if (rename(temporaryPath_.c_str(), targetPath_.c_str()) != 0) {
        refuseWithErrno(
            givenPath_,
            fmt::format("its contents are in '{}', which could not be renamed", temporaryPath_.string()),
            errno);
    }
    // The file is in place; this makes its new name survive a power failure. A folder that is writable but not readable
    // cannot be opened for it, which does not make the output missing.
    const int folder = open(targetPath_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        const int errorNumber = synchronize(folder);
        close(folder);
        if (errorNumber != 0)
            refuseWithErrno(givenPath_, "storing the folder's entry", errorNumber);
    }
}

} // namespace hyalite::core
