#include "tests/fuzz/harness.h"

#include "host/base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace hyalite::core::fuzz {

void require(bool holds, std::string_view message) {
    if (holds)
        return;
    std::fprintf(stderr, "broken promise: %.*s\n", static_cast<int>(message.size()), message.data());
    std::abort();
}

void requirePlain(std::string_view text) {
    const auto isControl = [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return (code < 0x20 && c != '\n') || code == 0x7F;
    };
    require(std::none_of(text.begin(), text.end(), isControl), "a message holds control characters");
}

std::optional<std::string> refusalOf(const std::function<void()> &read) {
    try {
        read();
        return std::nullopt;
    } catch (const Error &error) {
        if (error.kind != ErrorKind::BadInput && error.kind != ErrorKind::LimitExceeded)
            throw;
        std::string message = error.what();
        requirePlain(message);
        return message;
    }
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hyalite-fuzz-XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr, "there is no room for a temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string &name, std::string_view content) const {
    std::ofstream stream(path_ / name, std::ios::binary | std::ios::trunc);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    require(static_cast<bool>(stream.flush()), "a temporary file cannot be written");
    return path_ / name;
}

} // namespace hyalite::core::fuzz
