#include "host/import/ply_header.h"

#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/import/obj_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace hyalite::core {
namespace {

constexpr std::pair<std::string_view, PlyType> typeNames[] = {
    {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::Uint8},
    {"uint8", PlyType::Uint8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
    {"ushort", PlyType::Uint16},  {"uint16", PlyType::Uint16},   {"int", PlyType::Int32},
    {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},     {"uint32", PlyType::Uint32},
    {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
    {"float64", PlyType::Float64}};

/// The lines of the header, one word after the other.
class HeaderReader {
  public:
    HeaderReader(std::span<const char> file, const std::string &fileName)
        : text_(file.data(), file.size()), fileName_(fileName), at_(byteOrderMarkBytes(file)) {}

    /// Goes to the next line. False at the end of the file.
    bool next() {
        if (at_ >= text_.size())
            return false;
        const std::size_t end = std::min(text_.find_first_of(ends_, at_), text_.size());
        line_ = text_.substr(at_, end - at_);
        ++lineNumber_;
        // The first line says how lines end: a LF after the CR of the last one may belong to the data. Where lines
        // end with LF alone, a CR before it is a blank.
        if (lineNumber_ == 1) {
            isCrLf_ = text_.substr(end, 2) == "\r\n";
            if (text_.substr(end, 1) == "\n")
                ends_ = "\n";
        }
        at_ = std::min(end + (isCrLf_ && text_.substr(end, 2) == "\r\n" ? 2 : 1), text_.size());
        return true;
    }

    /// The next word in small letters. Empty at the end of the line.
    std::string small() { return lowerCase(word()); }

    /// The next word. Empty at the end of the line.
    std::string_view word() {
        line_.remove_prefix(std::min(line_.find_first_not_of(blanks), line_.size()));
        const std::string_view first = line_.substr(0, line_.find_first_of(blanks));
        line_.remove_prefix(first.size());
        return first;
    }

    /// The rest of the line, without blanks around it.
    std::string_view remainder() {
        line_.remove_prefix(std::min(line_.find_first_not_of(blanks), line_.size()));
        return line_.substr(0, line_.find_last_not_of(blanks) + 1);
    }

    PlyType type() {
        const std::string name = small();
        const auto *const type =
            std::ranges::find(typeNames, name, &std::pair<std::string_view, PlyType>::first);
        if (type == std::end(typeNames))
            fail(
                fmt::format("{} is no type of PLY; allowed are char, uchar, short, ushort, int, uint, float, "
                            "double, and int8 to float64",
                            quoteInput(name)));
        return type->second;
    }

    [[noreturn]] void fail(std::string_view message) const { failAtLine(fileName_, lineNumber_, message); }
    [[nodiscard]] std::size_t offset() const { return at_; }
    [[nodiscard]] std::size_t lineNumber() const { return lineNumber_; }

  private:
    static constexpr std::string_view blanks = " \t\r";
    std::string_view text_;
    const std::string &fileName_;
    std::string_view ends_ = "\r\n";
    std::size_t at_;
    std::string_view line_;
    std::size_t lineNumber_ = 0;
    bool isCrLf_ = false;
};

PlyFormat readFormat(HeaderReader &reader) {
    const std::string word = reader.small();
    if (word == "ascii")
        return PlyFormat::Text;
    if (word == "binary_little_endian")
        return PlyFormat::LittleEndian;
    if (word == "binary_big_endian")
        return PlyFormat::BigEndian;
    reader.fail(fmt::format("the format is {}; allowed are ascii, binary_little_endian and binary_big_endian",
                            quoteInput(word)));
}

PlyElement readElement(HeaderReader &reader, const std::vector<PlyElement> &before) {
    PlyElement element;
    element.name = reader.small();
    if (std::ranges::find(before, element.name, &PlyElement::name) != before.end())
        reader.fail(fmt::format("there are two elements {}", quoteInput(element.name)));
    const std::string_view count = reader.word();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
        reader.fail(fmt::format("element {} has the number {}; allowed is a whole number",
                                quoteInput(element.name), quoteInput(count)));
    return element;
}

PlyProperty readProperty(HeaderReader &reader) {
    PlyProperty property;
    HeaderReader ahead = reader;
    if (ahead.small() == "list") {
        reader.word();
        property.isList = true;
        property.countType = reader.type();
        if (!isWhole(property.countType))
            reader.fail("the length of a list is no whole number; allowed are char to uint");
    }
    property.type = reader.type();
    property.name = reader.small();
    return property;
}

} // namespace

PlyHeader readPlyHeader(std::span<const char> file, const std::string &fileName) {
    constexpr std::size_t maxElements = 256;
    HeaderReader reader(file, fileName);
    if (!reader.next() || reader.small() != "ply") {
        const std::string guess = guessContent(file.first(std::min(file.size(), guessedBytes)));
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: this is not PLY, which begins with the line \"ply\"{}{}", fileName,
                                guess.empty() ? "" : "; it looks like ", guess));
    }
    PlyHeader header;
    std::optional<PlyFormat> format;
    while (reader.next()) { // other lines are comments, and comments that were broken into lines
        const std::string keyword = reader.small();
        if (keyword == "format")
            format = readFormat(reader);
        else if (keyword == "element" && header.elements.size() < maxElements)
            header.elements.push_back(readElement(reader, header.elements));
        else if (keyword == "element")
            reader.fail(fmt::format("there are more than {} kinds of elements", maxElements));
        else if (keyword == "property" && header.elements.empty())
            reader.fail("a property comes before the first element");
        else if (keyword == "property")
            header.elements.back().properties.push_back(readProperty(reader));
        else if (keyword == "comment") {
            if (reader.small() == "texturefile" && header.textureFiles.size() < maxElements)
                header.textureFiles.emplace_back(reader.remainder());
        } else if (keyword == "end_header") {
            if (!format)
                reader.fail("the header names no format; allowed are ascii, binary_little_endian and "
                            "binary_big_endian");
            header.format = *format;
            header.bodyOffset = reader.offset();
            header.bodyLine = reader.lineNumber() + 1;
            return header;
        }
    }
    reader.fail("the header has no end_header: the file is cut short");
}

} // namespace hyalite::core
