#include "host/film/checkpoint_lock.h"

#include "host/base/atomic_file.h"
#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr std::string_view mark = "hyalite checkpoint lock of process ";

[[noreturn]] void refuse(const std::filesystem::path &path, std::string_view reason) {
    throw Error(ErrorKind::OutputNotWritten,
                fmt::format("cannot lock a checkpoint by '{}': {}; remove it, or name another checkpoint",
                            path.string(), reason));
}

/// Whether the open file is still the one of that name. Its last owner may have removed it in the meantime.
bool isStillThere(int descriptor, const std::filesystem::path &path) {
    struct stat open {};
    struct stat named {};
    return fstat(descriptor, &open) == 0 && lstat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

/// The process that made the lock file; empty if none of this program did. A file with a second name is somebody's.
std::optional<std::string> ownerIn(int descriptor) {
    struct stat status {};
    std::array<char, mark.size() + 16> bytes{};
    if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink > 1)
        return std::nullopt;
    const ssize_t count = pread(descriptor, bytes.data(), bytes.size(), 0);
    const std::string_view text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (!text.starts_with(mark) || !text.ends_with('\n'))
        return std::nullopt;
    const std::string_view owner = text.substr(mark.size(), text.size() - mark.size() - 1);
    return owner.find_first_not_of("0123456789") == std::string_view::npos ? std::optional(std::string(owner))
                                                                           : std::nullopt;
}

void writeOwner(int descriptor, const std::filesystem::path &path) {
    const std::string text = fmt::format("{}{}\n", mark, getpid());
    if (ftruncate(descriptor, 0) == 0 &&
        pwrite(descriptor, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()))
        return;
    const int errorNumber = errno;
    unlink(path.c_str());
    refuse(path, std::generic_category().message(errorNumber));
}

/// The lock file, new or left over. Empty if it vanished in the meantime.
std::optional<int> openLock(const std::filesystem::path &path) {
    constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    int descriptor = open(path.c_str(), flags | O_CREAT | O_EXCL, 0666);
    if (descriptor >= 0) {
        writeOwner(descriptor, path);
        return descriptor;
    }
    if (errno == EEXIST) {
        descriptor = open(path.c_str(), flags);
        if (descriptor < 0 && errno == ENOENT)
            return std::nullopt;
    }
    if (descriptor < 0)
        refuse(path, errno == ELOOP ? "it is a symbolic link" : std::generic_category().message(errno));
    return descriptor;
}

} // namespace

std::filesystem::path lockOfCheckpoint(const std::filesystem::path &checkpoint) {
    return followLinks(checkpoint).string() + ".lock";
}

CheckpointLock::CheckpointLock(const std::filesystem::path &checkpoint)
    : path_(lockOfCheckpoint(checkpoint)) {
    for (;;) {
        const std::optional<int> opened = openLock(path_);
        if (!opened)
            continue;
        descriptor_ = *opened;
        const std::optional<std::string> owner = ownerIn(descriptor_);
        if (!owner) {
            close(descriptor_);
            refuse(path_, "it exists, and no render made it");
        }
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(descriptor_);
            throw Error(ErrorKind::OutputNotWritten,
                        fmt::format("{}: another render (process {}) writes this checkpoint; wait for it, or "
                                    "name another one",
                                    checkpoint.string(), *owner));
        }
        if (isStillThere(descriptor_, path_))
            break;
        close(descriptor_);
    }
    writeOwner(descriptor_, path_);
}

CheckpointLock::~CheckpointLock() {
    if (isStillThere(descriptor_, path_))
        unlink(path_.c_str()); // while it is locked, so that nobody else holds it
    close(descriptor_);
}

} // namespace hyalite::core
