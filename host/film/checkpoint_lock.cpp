#include "host/film/checkpoint_lock.h"

#include "host/base/atomic_file.h"
#include "host/base/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite {

namespace {

/// Whether the open file is still the one of that name. Its last owner may have removed it in the meantime.
bool isStillThere(int descriptor, const std::filesystem::path &path) {
    struct stat open {};
    struct stat named {};
    return fstat(descriptor, &open) == 0 && stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

/// "(process 123)", or nothing if the file does not say.
std::string ownerIn(int descriptor) {
    std::array<char, 16> text{};
    const ssize_t count = pread(descriptor, text.data(), text.size(), 0);
    std::string digits;
    for (ssize_t i = 0;
         i < count && text[static_cast<std::size_t>(i)] >= '0' && text[static_cast<std::size_t>(i)] <= '9';
         ++i)
        digits += text[static_cast<std::size_t>(i)];
    return digits.empty() ? "" : fmt::format(" (process {})", digits);
}

} // namespace

std::filesystem::path lockOfCheckpoint(const std::filesystem::path &checkpoint) {
    return followLinks(checkpoint).string() + ".lock";
}

CheckpointLock::CheckpointLock(const std::filesystem::path &checkpoint)
    : path_(lockOfCheckpoint(checkpoint)) {
    for (;;) {
        descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
        if (descriptor_ < 0)
            throw Error(ErrorKind::OutputNotWritten,
                        fmt::format("{}: {}", path_.string(), std::generic_category().message(errno)));
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            const std::string owner = ownerIn(descriptor_);
            close(descriptor_);
            throw Error(
                ErrorKind::OutputNotWritten,
                fmt::format("{}: another render{} writes this checkpoint; wait for it, or name another one",
                            checkpoint.string(), owner));
        }
        if (isStillThere(descriptor_, path_))
            break;
        close(descriptor_);
    }
    const std::string owner = fmt::format("{}\n", getpid());
    if (ftruncate(descriptor_, 0) == 0)
        static_cast<void>(!pwrite(descriptor_, owner.data(), owner.size(), 0)); // only a message needs it
}

CheckpointLock::~CheckpointLock() {
    unlink(path_.c_str()); // while it is locked, so that nobody else holds it
    close(descriptor_);
}

} // namespace hyalite
