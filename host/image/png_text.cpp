#include "host/image/png_text.h"

#include "host/base/clean_text.h"
#include "host/image/png_chunks.h"

#include <cassert>
#include <string>

namespace hyalite {

namespace {

constexpr std::size_t headerEnd = 8 + 12 + 13; // signature, frame of IHDR, data of IHDR
constexpr std::size_t keywordBytesMax = 79;

} // namespace

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

} // namespace hyalite
