#include "host/image/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite {

InputFile::InputFile(const std::filesystem::path &path) : path_(path) {
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) {
        throw Error(ExitCode::BadInput, fmt::format("cannot read image '{}': {}", path.string(),
                                                    std::generic_category().message(errno)));
    }
    struct stat status {};
    if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        close(descriptor_);
        throw bad("it is not a regular file; name a PNG, EXR, HDR or PFM file");
    }
    sizeBytes_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { close(descriptor_); }

void InputFile::read(std::uint64_t offsetBytes, std::span<std::byte> destination) const {
    assert(offsetBytes <= sizeBytes_ && destination.size() <= sizeBytes_ - offsetBytes);
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
    return Error(ExitCode::BadInput, fmt::format("cannot use image '{}': {}", path_.string(), found));
}

} // namespace hyalite
