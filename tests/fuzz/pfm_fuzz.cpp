// PFM pictures as `hyalite diff` reads them; small ones are compared as well, since their floats may be anything.
// HDR-FLIP takes its time, up to hundreds of exposures, and so is for tiny ones, and for one in 64 of these.
#include "host/base/hash.h"
#include "host/image/comparison.h"
#include "host/image/heat_map.h"
#include "host/image/ssim.h"
#include "host/image/tone_map.h"
#include "tests/fuzz/harness.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace hyalite::core::fuzz {
namespace {

/// The same numbers in other places.
Image upsideDown(const Image &image) {
    Image turned = image;
    std::reverse(turned.pixels().begin(), turned.pixels().end());
    return turned;
}

void compareTiny(const LoadedImage &loaded) {
    const ImageComparison comparison = compareImages(loaded.image, upsideDown(loaded.image), loaded.encoding);
    (void)comparison.pixels.psnrDecibels();
    for (const float error : comparison.flipMap.errors)
        require(error >= 0.0f && error <= 1.0f, "an error of FLIP out of range");
    (void)heatMap(comparison.flipMap);
    (void)toneMap(loaded.image, 0.0);
}

void run(std::string_view content) {
    constexpr std::size_t tinyPixelCount = 9;
    constexpr std::size_t smallPixelCount = 144; // SSIM looks at windows of 11 x 11
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.pfm", content);
    LoadedImage loaded;
    if (refusalOf([&] { loaded = readImage(file); }))
        return;
    const std::size_t pixelCount = loaded.image.pixels().size();
    const bool isChosen = hashBytes(std::as_bytes(std::span(content))) % 64 == 0; // whenever it comes again
    if (pixelCount <= tinyPixelCount && isChosen)
        compareTiny(loaded);
    if (pixelCount <= smallPixelCount)
        (void)meanSsim(loaded.image, upsideDown(loaded.image));
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
