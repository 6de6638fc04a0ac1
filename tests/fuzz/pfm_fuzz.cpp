// PFM pictures as `hyalite diff` reads them; small ones are compared as well, since their floats may be anything.
#include "host/image/comparison.h"
#include "host/image/heat_map.h"
#include "host/image/tone_map.h"
#include "tests/fuzz/harness.h"

#include <algorithm>
#include <cstdint>

namespace hyalite::fuzz {
namespace {

/// With the same image upside down: the same numbers, in other places.
void compareWithItself(const LoadedImage &loaded) {
    Image turned = loaded.image;
    std::reverse(turned.pixels().begin(), turned.pixels().end());
    const ImageComparison comparison = compareImages(loaded.image, turned, loaded.encoding);
    (void)comparison.pixels.psnrDecibels();
    for (const float error : comparison.flipMap.errors)
        require(error >= 0.0f && error <= 1.0f, "an error of FLIP out of range");
    (void)heatMap(comparison.flipMap);
    (void)toneMap(loaded.image, 0.0);
}

void run(std::string_view content) {
    constexpr std::size_t comparedPixelCount = 128; // FLIP takes its time
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.pfm", content);
    LoadedImage loaded;
    if (refusalOf([&] { loaded = readImage(file); }))
        return;
    if (loaded.image.pixels().size() <= comparedPixelCount)
        compareWithItself(loaded);
}

} // namespace
} // namespace hyalite::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::fuzz::run(hyalite::fuzz::textOf(data, sizeBytes));
    return 0;
}
