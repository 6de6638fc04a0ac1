#include "host/base/standard_stream.h"

#include "host/base/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr std::size_t maxBytes = 0xFFFF'FFFF;

std::vector<std::byte> readStandardInput() {
    if (isatty(STDIN_FILENO) != 0)
        throw Error(ErrorKind::BadInput, "standard input is a terminal; lead a file into it (< FILE)");
    constexpr std::size_t stepBytes = std::size_t{1} << 16;
    std::vector<std::byte> bytes;
    std::size_t count = 0;
    while (true) {
        bytes.resize(std::max(bytes.size(), count + stepBytes));
        const ssize_t step = read(STDIN_FILENO, bytes.data() + count, stepBytes);
        if (step < 0 && errno == EINTR)
            continue;
        if (step < 0)
            throw Error(ErrorKind::BadInput, "standard input: " + std::generic_category().message(errno));
        if (step == 0)
            break;
        count += static_cast<std::size_t>(step);
        if (count > maxBytes)
            throw Error(ErrorKind::BadInput, "standard input has more than 4 GiB; name a file");
    }
    if (count == 0)
        throw Error(ErrorKind::BadInput, "standard input is empty; lead a file into it (< FILE)");
    bytes.resize(count);
    return bytes;
}

} // namespace

std::optional<std::string> standardStreamFormat(const std::filesystem::path &path) {
    const std::string &name = path.native();
    if (name == "-")
        return "";
    const std::string format = name.substr(0, name.find(':'));
    const auto isLetter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    return name == format + ":-" && !format.empty() && std::ranges::all_of(format, isLetter)
               ? std::optional(format)
               : std::nullopt;
}

std::span<const std::byte> standardInput() {
    static const std::vector<std::byte> bytes = readStandardInput();
    return bytes;
}

} // namespace hyalite::core
