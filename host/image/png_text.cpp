#include "host/image/png_text.h"

#include "host/base/clean_text.h"

#include <zlib.h>

#include <cassert>
#include <cstdint>
#include <string>

namespace hyalite::core {

namespace {

constexpr std::size_t headerEnd = 8 + 12 + 13; // signature, frame of IHDR, data of IHDR
constexpr std::size_t keywordBytesMax = 79;

void appendBigEndian32(std::vector<std::byte> &bytes, std::uint64_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::byte>((value >> shift) & 0xffu));
}

} // namespace

void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data) {
    appendBigEndian32(file, data.size());
    const std::size_t begin = file.size();
    for (const char letter : type)
        file.push_back(static_cast<std::byte>(letter));
    file.insert(file.end(), data.begin(), data.end());
    const auto *const checked = reinterpret_cast<const unsigned char *>(file.data() + begin);
    appendBigEndian32(file, crc32_z(0, checked, file.size() - begin));
}

void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes) {
    assert(png.size() > headerEnd);
    std::vector<std::byte> chunks;
    for (const auto &[name, text] : attributes) {
        assert(!name.empty() && name.size() <= keywordBytesMax);
        std::string data = name == "software" ? "Software" : name;
        data += '\0';
        data.append(2, '\0'); // not compressed
        data.append(2, '\0'); // empty language tag and translated keyword
        data += cleanText(text);
        appendChunk(chunks, "iTXt", std::as_bytes(std::span(data)));
    }
    png.insert(png.begin() + headerEnd, chunks.begin(), chunks.end());
}

} // namespace hyalite::core
