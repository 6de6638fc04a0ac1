// PNG files as pictures and as textures. Nearly every mutation breaks a checksum, behind which nothing is read: so
// after most of them the checksums are made right again.
#include "host/image/image_file.h"
#include "host/image/texture_file.h"
#include "tests/fuzz/harness.h"

#include <algorithm>
#include <cstdint>
#include <span>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t sizeBytes, std::size_t maxBytes);

namespace hyalite::core::fuzz {
namespace {

/// CRC-32 of ISO 3309, bit by bit.
std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1u) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return crc ^ 0xffffffffu;
}

/// Of each chunk, up to the first that does not fit: length, type, data, checksum, of which the length leaves out all
/// the others.
void repairChecksums(std::span<std::uint8_t> png) {
    constexpr std::size_t signatureBytes = 8;
    constexpr std::size_t frameBytes = 12;
    std::size_t begin = signatureBytes;
    while (begin + frameBytes <= png.size()) {
        std::size_t dataBytes = 0;
        for (std::size_t i = 0; i < 4; ++i)
            dataBytes = (dataBytes << 8) | png[begin + i];
        if (dataBytes > png.size() - begin - frameBytes)
            return;
        const std::size_t end = begin + frameBytes + dataBytes;
        const std::uint32_t crc = crc32(png.subspan(begin + 4, 4 + dataBytes));
        for (std::size_t i = 0; i < 4; ++i)
            png[end - 4 + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
        begin = end;
    }
}

void run(std::string_view content) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.png", content);
    LoadedImage loaded;
    if (refusalOf([&] { loaded = readImage(file); }))
        return;
    if (loaded.encoding != Encoding::Display)
        return; // the first bytes have become those of a PFM
    require(!refusalOf([&] { (void)readTexture(file); }), "a picture that is no texture");
    require(!refusalOf([&] { (void)readAttributes(file); }), "a picture whose texts are refused");
    for (const glm::vec3 &pixel : loaded.image.pixels())
        for (glm::length_t channel = 0; channel < 3; ++channel)
            require(pixel[channel] >= 0.0f && pixel[channel] <= 1.0f, "a level out of range");
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t sizeBytes,
                                               std::size_t maxBytes, unsigned int seed) {
    const std::size_t mutatedBytes = LLVMFuzzerMutate(data, sizeBytes, maxBytes);
    if (seed % 16 != 0)
        hyalite::core::fuzz::repairChecksums({data, mutatedBytes});
    return mutatedBytes;
}
