#include "host/image/png_text.h"

#include "host/base/clean_text.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::size_t keywordBytesMax = 79;

std::uint32_t bigEndian32(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4))
        value = value << 8 | std::to_integer<std::uint32_t>(byte);
    return value;
}

/// Of the data of a chunk: name \0 text, or name \0 0 0 language \0 translated name \0 text.
std::optional<Attribute> textOf(std::string_view type, std::string_view data) {
    const auto cut = [&] { // the part up to the next zero
        const std::size_t end = std::min(data.find('\0'), data.size());
        const std::string_view part = data.substr(0, end);
        data.remove_prefix(std::min(end + 1, data.size()));
        return part;
    };
    const std::string name(cut());
    if (type == "iTXt") {
        if (data.size() < 2 || data[0] != '\0')
            return std::nullopt;
        data.remove_prefix(2);
        cut();
        cut();
    }
    return Attribute(name == "Software" ? "software" : name, std::string(data));
}

} // namespace

void appendBigEndian32(std::vector<std::byte> &bytes, std::uint64_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::byte>((value >> shift) & 0xffu));
}

void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data) {
    appendBigEndian32(file, data.size());
    const std::size_t begin = file.size();
    for (const char letter : type)
        file.push_back(static_cast<std::byte>(letter));
    file.insert(file.end(), data.begin(), data.end());
    const auto *const checked = reinterpret_cast<const unsigned char *>(file.data() + begin);
    appendBigEndian32(file, crc32_z(0, checked, file.size() - begin));
}

std::vector<std::byte> textChunks(std::span<const Attribute> attributes) {
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
    return chunks;
}

void insertTexts(std::vector<std::byte> &png, std::span<const Attribute> attributes) {
    assert(png.size() > pngHeaderEnd);
    const std::vector<std::byte> chunks = textChunks(attributes);
    png.insert(png.begin() + pngHeaderEnd, chunks.begin(), chunks.end());
}

std::vector<Attribute> readPngTexts(const InputFile &file) {
    constexpr std::size_t textBytesMax = std::size_t{1} << 20;
    std::vector<Attribute> attributes;
    std::size_t total = 0;
    // Length, type, data, checksum.
    for (std::uint64_t position = 8; position + 12 <= file.sizeBytes();) {
        std::array<std::byte, 8> head{};
        file.read(position, head);
        const std::uint64_t size = bigEndian32(head);
        const std::string_view type(reinterpret_cast<const char *>(head.data()) + 4, 4);
        if (type == "IDAT" || position + 12 + size > file.sizeBytes())
            break;
        if ((type == "iTXt" || type == "tEXt") && total + size <= textBytesMax) {
            std::string data(size, '\0');
            file.read(position + head.size(), std::as_writable_bytes(std::span(data)));
            if (std::optional<Attribute> attribute = textOf(type, data))
                attributes.push_back(std::move(*attribute));
            total += size;
        }
        position += 12 + size;
    }
    return attributes;
}

} // namespace hyalite::core
