#include "host/base/content_guess.h"

#include "host/base/letter_case.h"
#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace hyalite::core {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes;
    std::string_view meaning;
};

constexpr Signature signatures[] = {
    {"\x1f\x8b"sv, "gzip data: unpack it first (gunzip)"},
    {"PK\x03\x04"sv, "a ZIP archive: unpack it first"},
    {"BZh"sv, "bzip2 data: unpack it first (bunzip2)"},
    {"\xfd"
     "7zXZ"sv,
     "xz data: unpack it first (unxz)"},
    {"\x28\xb5\x2f\xfd"sv, "zstd data: unpack it first (unzstd)"},
    {"\xff\xfe"sv, "UTF-16 text: save it as UTF-8"},
    {"\xfe\xff"sv, "UTF-16 text: save it as UTF-8"},
    {"glTF"sv, "binary glTF: name it .glb"},
    {"ply\n"sv, "PLY: name it .ply"},
    {"ply\r"sv, "PLY: name it .ply"},
    {"\x89PNG"sv, "a PNG picture"},
    {"\xff\xd8\xff"sv, "a JPEG picture"},
    {"BLENDER"sv, "a Blender file: export it"},
    {"Kaydara FBX"sv, "FBX: export it as glTF or OBJ"},
    {"%PDF"sv, "a PDF document"},
    {"version https://git-lfs"sv, "a pointer of Git LFS: fetch the file itself (git lfs pull)"},
};

bool isWebPage(std::string_view text) {
    text.remove_prefix(byteOrderMarkBytes(text));
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const auto begins = [&](std::string_view tag) {
        return lowerCase(text.substr(0, tag.size())) == lowerCase(tag);
    };
    return begins("<!doctype html") || begins("<html");
}

} // namespace

std::size_t byteOrderMarkBytes(std::span<const char> head) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return std::string_view(head.data(), head.size()).starts_with(mark) ? mark.size() : 0;
}

std::string guessBySignature(std::span<const char> head) {
    const std::string_view text(head.data(), head.size());
    if (isWebPage(text))
        return "a web page: download the file itself";
    for (const auto &[bytes, meaning] : signatures)
        if (text.starts_with(bytes))
            return std::string(meaning);
    return {};
}

std::string guessContent(std::span<const char> head) {
    if (std::string known = guessBySignature(head); !known.empty())
        return known;
    const std::string_view text(head.data(), head.size());
    const auto isZero = [](char c) { return c == '\0'; };
    const auto isControl = [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v';
    };
    const auto zeroCount = std::ranges::count_if(text, isZero);
    // Text of two bytes a character, without its mark: every other byte of what is ASCII is zero.
    if (text.size() >= 8 && zeroCount * 5 >= static_cast<std::ptrdiff_t>(text.size()) * 2 &&
        std::ranges::none_of(text, [&](char c) { return isControl(c) && !isZero(c); }))
        return "UTF-16 text: save it as UTF-8";
    constexpr std::ptrdiff_t someBytes = 4; // a text may be damaged in places
    const auto controlCount = std::ranges::count_if(text, isControl);
    if (controlCount >= someBytes && controlCount * 10 > static_cast<std::ptrdiff_t>(text.size()))
        return "binary data";
    return {};
}

std::string foreignContent(const InputFile &file, const std::string &message) {
    const std::vector<std::byte> head = file.head(guessedBytes);
    if (head.empty())
        return "it is empty";
    const std::string guess = guessBySignature({reinterpret_cast<const char *>(head.data()), head.size()});
    return guess.empty() ? message : message + "; it looks like " + guess;
}

} // namespace hyalite::core
