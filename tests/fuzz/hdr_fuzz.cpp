// Radiance pictures as `hyalite diff` and `hyalite tonemap` read them. What is read is written, and read again: that
// changes nothing.
#include "host/image/hdr.h"
#include "host/image/image_file.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace hyalite::core::fuzz {
namespace {

std::optional<Image> readBounded(const std::filesystem::path &path, std::size_t sizeBytes) {
    const HeapPeak peak;
    std::optional<Image> image;
    if (refusalOf([&] { image = readHdr(InputFile(path)); }))
        image.reset();
    require(peak.bytes() <= readingBytesMax(sizeBytes), "more memory than may be taken for such a file");
    return image;
}

void run(std::string_view content) {
    constexpr std::size_t smallPixelCount = 1000;
    static const TemporaryFolder folder;
    const std::optional<Image> image = readBounded(folder.write("input.hdr", content), content.size());
    if (!image || image->pixels().size() > smallPixelCount)
        return;
    const std::filesystem::path copy = folder.write("copy.hdr", "");
    AtomicFile file(copy);
    writeHdr(file, *image);
    file.commit();
    const Image again = readHdr(InputFile(copy));
    for (std::size_t i = 0; i < image->pixels().size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float before = image->pixels()[i][channel];
            require(before >= 0.0f && std::isfinite(before), "a value that the format does not have");
            // What is darker than the format's normalised values may become black.
            require(again.pixels()[i][channel] == before || before < 0x1p-120f,
                    "a value that changes when it is written");
        }
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
