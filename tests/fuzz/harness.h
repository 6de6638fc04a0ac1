// What the harnesses share. Each feeds one reader with whatever libFuzzer makes up; a reader may take it or refuse it
// with an Error that blames the input. A sanitizer's message, a crash, a leak, any other exception, a hang or a broken
// promise is a find.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hyalite::core::fuzz {

/// Ends the process with `message` unless `holds`: the input is a find.
void require(bool holds, std::string_view message);

/// Requires a text that goes to a terminal to hold no control characters but line feeds.
void requirePlain(std::string_view text);

/// Calls read(). The message where it refuses the input, by an Error{BadInput} or Error{LimitExceeded}, whose message
/// holds no control characters, as it goes to a terminal; nothing where it takes it.
[[nodiscard]] std::optional<std::string> refusalOf(const std::function<void()> &read);

/// A folder in the system's folder for temporary files, of this process alone; it goes with the object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;
    ~TemporaryFolder();

    /// Writes a file of that name, over one that is there, and returns its path.
    [[nodiscard]] std::filesystem::path write(const std::string &name, std::string_view content) const;

  private:
    std::filesystem::path path_;
};

/// The input as text.
[[nodiscard]] inline std::string_view textOf(const unsigned char *data, std::size_t sizeBytes) {
    return {reinterpret_cast<const char *>(data), sizeBytes};
}

} // namespace hyalite::core::fuzz
