#include "host/base/input_file.h"

#include "host/base/standard_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

std::string_view kindOf(mode_t mode) {
    switch (mode & S_IFMT) {
    case S_IFDIR:
        return "a folder";
    case S_IFIFO:
        return "a pipe";
    case S_IFSOCK:
        return "a socket";
    default:
        return "a device";
    }
}

} // namespace

InputFile::InputFile(const std::filesystem::path &path) : path_(path) {
    if (isStandardStream(path)) {
        contents_ = standardInput();
        sizeBytes_ = contents_.size();
        return;
    }
    const auto requireRegular = [&](int failure, const struct stat &status) {
        if (failure != 0)
            throw bad(std::generic_category().message(errno));
        if (!S_ISREG(status.st_mode))
            throw bad(fmt::format("is {}, not a regular file; name a file{}", kindOf(status.st_mode),
                                  S_ISFIFO(status.st_mode) ? ", or - for standard input" : ""));
    };
    // Opening a device can have side effects, so the type is checked first. If the file is replaced in between,
    // O_NONBLOCK keeps a pipe from blocking until a writer opens it.
    struct stat status {};
    requireRegular(stat(path.c_str(), &status), status);
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor_ < 0)
        throw bad(std::generic_category().message(errno));
    try {
        requireRegular(fstat(descriptor_, &status), status);
    } catch (const Error &) {
        close(descriptor_);
        throw;
    }
    sizeBytes_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::InputFile(std::filesystem::path name, std::span<const std::byte> contents)
    : path_(std::move(name)), sizeBytes_(contents.size()), contents_(contents) {}

InputFile::~InputFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

void InputFile::read(std::uint64_t offsetBytes, std::span<std::byte> destination) const {
    assert(offsetBytes <= sizeBytes_ && destination.size() <= sizeBytes_ - offsetBytes);
    if (descriptor_ < 0) {
        std::ranges::copy(contents_.subspan(static_cast<std::size_t>(offsetBytes), destination.size()),
                          destination.begin());
        return;
    }
    while (!destination.empty()) {
        const ssize_t count =
            pread(descriptor_, destination.data(), destination.size(), static_cast<off_t>(offsetBytes));
        if (count > 0) {
            destination = destination.subspan(static_cast<std::size_t>(count));
            offsetBytes += static_cast<std::uint64_t>(count);
        } else if (count == 0) {
            throw bad(fmt::format("it became shorter than {} bytes while it was read", sizeBytes_));
        } else if (errno != EINTR) {
            throw bad(std::generic_category().message(errno));
        }
    }
}

std::vector<std::byte> InputFile::head(std::size_t countBytes) const {
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(countBytes, sizeBytes_)));
    read(0, bytes);
    return bytes;
}

Error InputFile::bad(const std::string &found) const {
    return Error(ErrorKind::BadInput, fmt::format("{}: {}", path_.string(), found));
}

} // namespace hyalite::core
