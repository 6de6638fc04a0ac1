#include "host/import/ply_values.h"

#include "host/import/obj_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <system_error>

namespace hyalite::core {
namespace {

bool isBlankOfPly(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

} // namespace

// ---- Text

bool PlyTextValues::endRow() {
    bool hasMore = false;
    for (; at_ != end_ && !isLineEnd(*at_); ++at_)
        hasMore |= !isBlankOfPly(*at_);
    return hasMore;
}

void PlyTextValues::beginRow(const PlyElement &element) {
    element_ = &element;
    for (; at_ != end_ && (isBlankOfPly(*at_) || isLineEnd(*at_)); ++at_)
        if (*at_ == '\n' || (*at_ == '\r' && (at_ + 1 == end_ || at_[1] != '\n')))
            ++line_;
    if (at_ == end_)
        throw PlyCutShort(
            ErrorKind::BadInput,
            fmt::format("{}the file ends before all of its {} rows of the element {}: it is cut short",
                        placeText(fileName_, unit, line_), element.count, quoteInput(element.name)));
}

double PlyTextValues::next(PlyType type) {
    while (at_ != end_ && isBlankOfPly(*at_))
        ++at_;
    if (at_ == end_ || isLineEnd(*at_))
        fail(fmt::format("the line has fewer values than the element {} has; each row is a line",
                         quoteInput(element_->name)));
    const char *digits = *at_ == '+' ? at_ + 1 : at_;
    double value = 0.0;
    std::from_chars_result result{};
    if (isWhole(type)) {
        std::int64_t whole = 0;
        result = std::from_chars(digits, end_, whole);
        value = static_cast<double>(whole);
    }
    if (!isWhole(type) || (result.ptr != end_ && !isBlankOfPly(*result.ptr) && !isLineEnd(*result.ptr)))
        result = std::from_chars(digits, end_, value);
    const bool isOver = result.ptr == end_ || isBlankOfPly(*result.ptr) || isLineEnd(*result.ptr);
    if (result.ec == std::errc::result_out_of_range && isOver) { // with a negative exponent it is nearly 0
        const std::string_view word(at_, result.ptr);
        const bool isTiny =
            word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
        value = isTiny ? 0.0 : std::numeric_limits<double>::infinity();
    } else if (result.ec != std::errc() || !isOver) {
        const char *wordEnd = at_;
        while (wordEnd != end_ && !isBlankOfPly(*wordEnd) && !isLineEnd(*wordEnd))
            ++wordEnd;
        fail(fmt::format("the element {} has {}; allowed are decimal numbers", quoteInput(element_->name),
                         quoteInput({at_, wordEnd})));
    }
    at_ = result.ptr;
    return value;
}

// ---- Bytes

void PlyByteValues::failCut() const {
    throw PlyCutShort(
        ErrorKind::BadInput,
        fmt::format("{}the file ends within the element {}, or a list is longer than the file: it is "
                    "damaged or cut short",
                    placeText(fileName_, unit, place()), quoteInput(element_->name)));
}

template <class T> T PlyByteValues::load() {
    if (bytesLeft() < sizeof(T))
        failCut();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    if (isSwapped_)
        std::ranges::reverse(bytes);
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
}

double PlyByteValues::next(PlyType type) {
    switch (type) {
    case PlyType::Int8:
        return load<std::int8_t>();
    case PlyType::Uint8:
        return load<std::uint8_t>();
    case PlyType::Int16:
        return load<std::int16_t>();
    case PlyType::Uint16:
        return load<std::uint16_t>();
    case PlyType::Int32:
        return load<std::int32_t>();
    case PlyType::Uint32:
        return load<std::uint32_t>();
    case PlyType::Float32:
        return double{load<float>()};
    case PlyType::Float64:
        return load<double>();
    }
    return 0.0; // unreachable: the switch is complete
}

} // namespace hyalite::core
