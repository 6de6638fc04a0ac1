#include "host/import/obj_lines.h"

#include "host/base/clean_text.h"
#include "host/base/content_guess.h"
#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace hyalite::core {

namespace {

constexpr std::size_t firstBufferBytes = std::size_t{1} << 18;

} // namespace

void failAtLine(const std::string &file, std::size_t line, std::string_view message) {
    throw Error(ErrorKind::BadInput, file + ":" + std::to_string(line) + ": " + std::string(message));
}

std::string quoteInput(std::string_view text) { return "\"" + excerpt(text, maxExcerptBytes) + "\""; }

ObjLines::ObjLines(const std::filesystem::path &path)
    : file_(path), name_(path.string()), buffer_(firstBufferBytes) {
    if (file_.sizeBytes() > maxFileBytes)
        throw file_.bad(
            fmt::format("has {} bytes; at most {} (4 GiB) are read", file_.sizeBytes(), maxFileBytes));
    if (refill())
        lineBegin_ = scan_ = byteOrderMarkBytes(head());
}

double ObjLines::shareRead() const {
    return file_.sizeBytes() > 0 ? static_cast<double>(fileBytes_) / static_cast<double>(file_.sizeBytes())
                                 : 1.0;
}

// Moves the rest of the current line to the front of the buffer and appends more of the file. Returns false at the end
// of the file.
bool ObjLines::refill() {
    std::memmove(buffer_.data(), buffer_.data() + lineBegin_, filled_ - lineBegin_);
    scan_ -= lineBegin_;
    filled_ -= lineBegin_;
    lineBegin_ = 0;
    if (filled_ > maxLineBytes)
        failAtLine(name_, nextLine_,
                   "the line is too long; at most " + std::to_string(maxLineBytes) + " bytes are allowed");
    if (filled_ + 1 >= buffer_.size() / 2)
        buffer_.resize(buffer_.size() * 2);
    const auto count = static_cast<std::size_t>(
        std::min<std::uint64_t>(buffer_.size() - filled_ - 1, file_.sizeBytes() - fileBytes_));
    file_.read(fileBytes_, std::as_writable_bytes(std::span(buffer_).subspan(filled_, count)));
    filled_ += count;
    buffer_[filled_] = '\0';
    fileBytes_ += count;
    return count > 0;
}

// Overwrites the LF of a CRLF whose CR lies before `scan_` with a blank.
void ObjLines::skipLineFeed() {
    if ((scan_ < filled_ || refill()) && buffer_[scan_] == '\n')
        buffer_[scan_++] = ' ';
}

std::optional<std::span<char>> ObjLines::next() {
    lineBegin_ = scan_;
    line_ = nextLine_;
    std::size_t indent = 0; // leading blanks, counted once for all continuations of a line
    for (;;) {
        const char *chars = buffer_.data();
        while (scan_ < filled_ && chars[scan_] != '\n' && chars[scan_] != '\r')
            ++scan_;
        const bool atFileEnd = scan_ == filled_ && !refill();
        if (!atFileEnd && buffer_[scan_] != '\n' && buffer_[scan_] != '\r')
            continue;
        const std::size_t length = scan_ - lineBegin_;
        if (atFileEnd && length == 0)
            return std::nullopt;

        char *begin = buffer_.data() + lineBegin_;
        const bool continues = length > 0 && begin[length - 1] == '\\';
        if (continues) {
            while (begin[indent] == ' ' || begin[indent] == '\t')
                ++indent;
            if (begin[indent] != '#')
                begin[length - 1] = ' ';
        }
        if (atFileEnd)
            return std::span<char>(begin, length);
        ++nextLine_;
        const char lineEnd = buffer_[scan_];
        buffer_[scan_++] = ' ';
        if (lineEnd == '\r')
            skipLineFeed();
        if (!continues || buffer_[lineBegin_ + indent] == '#')
            return std::span<char>(buffer_.data() + lineBegin_, length);
    }
}

} // namespace hyalite::core
