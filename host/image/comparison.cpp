#include "host/image/comparison.h"

#include "host/image/ssim.h"

#include <cassert>
#include <vector>

namespace hyalite::core {

namespace {

Image equalOutsideOf(const Mask &mask, const Image &reference, const Image &test) {
    Image patched = test;
    for (std::size_t i = 0; i < patched.pixels().size(); ++i)
        if (!isCompared(mask, i))
            patched.pixels()[i] = reference.pixels()[i];
    return patched;
}

ErrorMap flipOf(const Image &reference, const Image &test, ImageComparison &comparison) {
    // Most compared images are meant to be equal, and FLIP is the slowest metric.
    if (comparison.pixels.identical())
        return {reference.width(), reference.height(), std::vector<float>(reference.pixels().size(), 0.0f)};
    if (comparison.encoding == Encoding::Display)
        return flipDisplay(reference, test);
    return flipLinear(reference, test, *comparison.flipExposures);
}

} // namespace

ImageComparison compareImages(const Image &reference, const Image &test, Encoding encoding,
                              double outlierThreshold, const Mask &mask) {
    ImageComparison comparison;
    comparison.encoding = encoding;
    comparison.pixels = comparePixels(reference, test, outlierThreshold, mask);
    comparison.ssim = meanSsim(reference, test, mask);
    if (encoding == Encoding::Linear)
        comparison.flipExposures = flipExposures(reference);

    comparison.flipMap = mask.empty() ? flipOf(reference, test, comparison)
                                      : flipOf(reference, equalOutsideOf(mask, reference, test), comparison);
    comparison.flip = summarizeFlip(comparison.flipMap, mask);
    // A difference also affects its neighbours; the map has only the compared pixels.
    for (std::size_t i = 0; i < comparison.flipMap.errors.size(); ++i)
        if (!isCompared(mask, i))
            comparison.flipMap.errors[i] = 0.0f;
    return comparison;
}

ImageComparison compareImages(const LoadedImage &reference, const LoadedImage &test, double outlierThreshold,
                              const Mask &mask) {
    assert(reference.encoding == test.encoding);
    ImageComparison comparison =
        compareImages(reference.composite(), test.composite(), reference.encoding, outlierThreshold, mask);
    if (!reference.alpha.empty() || !test.alpha.empty())
        comparison.alpha = compareAlpha(reference.alpha, test.alpha, reference.image.pixels().size(), mask);
    return comparison;
}

} // namespace hyalite::core
