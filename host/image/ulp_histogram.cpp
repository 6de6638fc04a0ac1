#include "host/image/ulp_histogram.h"

#include "host/image/metrics.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace hyalite::core {

namespace {

void count(UlpHistogram &histogram, float a, float b) {
    ++histogram[static_cast<std::size_t>(std::bit_width(ulpDistance(a, b)))];
}

} // namespace

UlpHistogram ulpHistogram(const Image &a, const Image &b, const Mask &mask) {
    assert(a.pixels().size() == b.pixels().size());
    UlpHistogram histogram{};
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        if (isCompared(mask, i))
            for (int channel = 0; channel < 3; ++channel)
                count(histogram, a.pixels()[i][channel], b.pixels()[i][channel]);
    return histogram;
}

void addAlphaUlps(UlpHistogram &histogram, std::span<const float> a, std::span<const float> b,
                  const Mask &mask) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
        if (isCompared(mask, i))
            count(histogram, a.empty() ? 1.0f : a[i], b.empty() ? 1.0f : b[i]);
}

} // namespace hyalite::core
