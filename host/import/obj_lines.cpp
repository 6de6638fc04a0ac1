#include "host/import/obj_lines.h"

#include "host/base/clean_text.h"
#include "host/base/content_guess.h"
#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace hyalite {

namespace {

constexpr std::size_t firstBufferBytes = std::size_t{1} << 18;

} // namespace

void failAtLine(const std::string &file, std::size_t line, std::string_view message) {
    throw Error(ErrorKind::BadInput, file + ":" + std::to_string(line) + ": " + std::string(message));
}

std::string quoteInput(std::string_view text) { return "\"" + excerpt(text, maxExcerptBytes) + "\""; }

ObjLines::ObjLines(const std::filesystem::path &path)
    : file(path), name(path.string()), buffer(firstBufferBytes) {
    if (file.sizeBytes() > maxFileBytes)
        throw file.bad(
            fmt::format("has {} bytes; at most {} (4 GiB) are read", file.sizeBytes(), maxFileBytes));
    if (refill())
        lineBegin = scan = byteOrderMarkBytes(head());
}

double ObjLines::shareRead() const {
    return file.sizeBytes() > 0 ? static_cast<double>(fileBytes) / static_cast<double>(file.sizeBytes())
                                : 1.0;
}

// Moves the rest of the current line to the front of the buffer and appends more of the file. Returns false at the end
// of the file.
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
    const auto count = static_cast<std::size_t>(
        std::min<std::uint64_t>(buffer.size() - filled - 1, file.sizeBytes() - fileBytes));
    file.read(fileBytes, std::as_writable_bytes(std::span(buffer).subspan(filled, count)));
    filled += count;
    buffer[filled] = '\0';
    fileBytes += count;
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
    std::size_t indent = 0; // leading blanks, counted once for all continuations of a line
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
