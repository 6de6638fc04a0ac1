#include "host/scene/obj_lines.h"

#include "host/error.h"

#include <cerrno>
#include <cstring>
#include <system_error>

namespace hyalite {

namespace {

constexpr std::size_t firstBufferBytes = std::size_t{1} << 18;

} // namespace

void failAtLine(const std::string &file, std::size_t line, std::string_view message) {
    throw Error(ExitCode::BadInput, file + ":" + std::to_string(line) + ": " + std::string(message));
}

std::string quoteInput(std::string_view text) {
    constexpr std::size_t maxShown = 40;
    std::string quoted = "\"";
    for (const char c : text.substr(0, maxShown))
        quoted += c >= ' ' && c <= '~' ? c : '?';
    return quoted + (text.size() > maxShown ? "...\"" : "\"");
}

ObjLines::ObjLines(const std::filesystem::path &file) : name(file.string()), buffer(firstBufferBytes) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::status_known(status) || !std::filesystem::exists(status))
        throw Error(ExitCode::BadInput, name + ": " + (error ? error.message() : "no such file"));
    if (!std::filesystem::is_regular_file(status))
        throw Error(ExitCode::BadInput, name + ": not a regular file; an OBJ file must be one");
    stream.reset(std::fopen(file.c_str(), "rb"));
    if (!stream)
        throw Error(ExitCode::BadInput,
                    name + ": cannot be opened: " + std::generic_category().message(errno));
    bytesAtOpening = std::filesystem::file_size(file, error);
    std::setvbuf(stream.get(), nullptr, _IONBF, 0);
    if (refill() && filled >= 3 && std::memcmp(buffer.data(), "\xEF\xBB\xBF", 3) == 0)
        lineBegin = scan = 3;
}

double ObjLines::shareRead() const {
    return fileBytes < bytesAtOpening ? static_cast<double>(fileBytes) / static_cast<double>(bytesAtOpening)
                                      : 1.0;
}

// Appends to what is left of the current line, which moves to the front. False at the end of the file.
bool ObjLines::refill() {
    std::memmove(buffer.data(), buffer.data() + lineBegin, filled - lineBegin);
    scan -= lineBegin;
    filled -= lineBegin;
    lineBegin = 0;
    if (filled > maxLineBytes)
        failAtLine(name, nextLine,
                   "the line is too long; at most " + std::to_string(maxLineBytes) + " bytes are allowed");
    if (filled + 1 >= buffer.size() / 2)
        buffer.resize(buffer.size() * 2);
    const std::size_t count = std::fread(buffer.data() + filled, 1, buffer.size() - filled - 1, stream.get());
    if (count == 0 && std::ferror(stream.get()))
        throw Error(ExitCode::BadInput, name + ": cannot be read: " + std::generic_category().message(errno));
    filled += count;
    buffer[filled] = '\0';
    fileBytes += count;
    if (fileBytes > maxFileBytes)
        throw Error(ExitCode::BadInput, name + ": larger than 4 GiB, the limit for OBJ files");
    return count > 0;
}

// Overwrites the LF of a CRLF whose CR lies before `scan` with a blank.
void ObjLines::skipLineFeed() {
    if ((scan < filled || refill()) && buffer[scan] == '\n')
        buffer[scan++] = ' ';
}

std::optional<std::span<char>> ObjLines::next() {
    lineBegin = scan;
    line = nextLine;
    std::size_t indent = 0; // blanks at the front, counted once however often the line goes on
    for (;;) {
        const char *chars = buffer.data();
        while (scan < filled && chars[scan] != '\n' && chars[scan] != '\r')
            ++scan;
        const bool atFileEnd = scan == filled && !refill();
        if (!atFileEnd && buffer[scan] != '\n' && buffer[scan] != '\r')
            continue;
        const std::size_t length = scan - lineBegin;
        if (atFileEnd && length == 0)
            return std::nullopt;

        char *begin = buffer.data() + lineBegin;
        const bool continues = length > 0 && begin[length - 1] == '\\';
        if (continues) {
            while (begin[indent] == ' ' || begin[indent] == '\t')
                ++indent;
            if (begin[indent] != '#')
                begin[length - 1] = ' ';
        }
        if (atFileEnd)
            return std::span<char>(begin, length);
        ++nextLine;
        const char lineEnd = buffer[scan];
        buffer[scan++] = ' ';
        if (lineEnd == '\r')
            skipLineFeed();
        if (!continues || buffer[lineBegin + indent] == '#')
            return std::span<char>(buffer.data() + lineBegin, length);
    }
}

} // namespace hyalite
