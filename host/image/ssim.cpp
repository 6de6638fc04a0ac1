#include "host/image/ssim.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace hyalite::core {

namespace {

constexpr int radius = ssimWindowSide / 2;

/// Weighted means over a window: of both images, their squares and their product.
struct Moments {
    double a = 0.0;
    double b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;

    void add(double weight, const Moments &other) {
        a += weight * other.a;
        b += weight * other.b;
        aa += weight * other.aa;
        bb += weight * other.bb;
        ab += weight * other.ab;
    }
};

using Weights = std::array<double, ssimWindowSide>;

/// One dimension of the Gaussian, which sums to 1.
Weights gaussianWeights() {
    constexpr double sigma = 1.5;
    Weights weights{};
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double weight = std::exp(-0.5 * i * i / (sigma * sigma));
        weights[static_cast<std::size_t>(i + radius)] = weight;
        sum += weight;
    }
    for (double &weight : weights)
        weight /= sum;
    return weights;
}

/// The SSIM index of one window; Wang et al. 2004, equation 13.
double indexOf(const Moments &m) {
    constexpr double c1 = 0.01 * 0.01;
    constexpr double c2 = 0.03 * 0.03;
    const double varianceA = m.aa - m.a * m.a;
    const double varianceB = m.bb - m.b * m.b;
    const double covariance = m.ab - m.a * m.b;
    return ((2.0 * m.a * m.b + c1) * (2.0 * covariance + c2)) /
           ((m.a * m.a + m.b * m.b + c1) * (varianceA + varianceB + c2));
}

/// The moments of the horizontal windows of row y. The first window has its centre at x = radius.
void filterRow(const Image &a, const Image &b, const Mask &mask, int channel, int y, const Weights &weights,
               std::vector<Moments> &products, std::vector<Moments> &filtered) {
    for (int x = 0; x < a.width(); ++x) {
        const auto index =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width()) + static_cast<std::size_t>(x);
        const double valueA = static_cast<double>(a.pixels()[index][channel]);
        const double valueB =
            isCompared(mask, index) ? static_cast<double>(b.pixels()[index][channel]) : valueA;
        products[static_cast<std::size_t>(x)] = {valueA, valueB, valueA * valueA, valueB * valueB,
                                                 valueA * valueB};
    }
    for (std::size_t x = 0; x < filtered.size(); ++x) {
        Moments moments;
        for (std::size_t i = 0; i < weights.size(); ++i)
            moments.add(weights[i], products[x + i]);
        filtered[x] = moments;
    }
}

/// Calls visit(index of the pixel, SSIM index) for each window inside the image whose centre is compared, channel by
/// channel.
template <class Visit>
void forEachWindow(const Image &a, const Image &b, const Mask &mask, const Visit &visit) {
    assert(a.width() == b.width() && a.height() == b.height());
    assert(mask.empty() || mask.size() == a.pixels().size());
    if (a.width() < ssimWindowSide || a.height() < ssimWindowSide)
        return;
    const Weights weights = gaussianWeights();
    const auto windowsPerRow = static_cast<std::size_t>(a.width() - 2 * radius);
    std::vector<Moments> products(static_cast<std::size_t>(a.width()));
    // Only the rows under the window are kept: row y is at y % 11.
    std::vector<std::vector<Moments>> rows(ssimWindowSide, std::vector<Moments>(windowsPerRow));
    for (int channel = 0; channel < 3; ++channel) {
        for (int lastY = 0; lastY < a.height(); ++lastY) {
            filterRow(a, b, mask, channel, lastY, weights, products,
                      rows[static_cast<std::size_t>(lastY % ssimWindowSide)]);
            const int centreY = lastY - radius;
            if (centreY < radius)
                continue;
            for (std::size_t window = 0; window < windowsPerRow; ++window) {
                const std::size_t centreIndex =
                    static_cast<std::size_t>(centreY) * static_cast<std::size_t>(a.width()) + window +
                    static_cast<std::size_t>(radius);
                if (!isCompared(mask, centreIndex))
                    continue;
                Moments moments;
                for (int i = 0; i < ssimWindowSide; ++i) {
                    const int y = centreY - radius + i;
                    moments.add(weights[static_cast<std::size_t>(i)],
                                rows[static_cast<std::size_t>(y % ssimWindowSide)][window]);
                }
                visit(centreIndex, indexOf(moments));
            }
        }
    }
}

} // namespace

std::optional<double> meanSsim(const Image &a, const Image &b, const Mask &mask) {
    double sum = 0.0;
    std::uint64_t windowCount = 0;
    forEachWindow(a, b, mask, [&](std::size_t, double index) {
        sum += index;
        ++windowCount;
    });
    if (windowCount == 0 || !std::isfinite(sum))
        return std::nullopt;
    return sum / static_cast<double>(windowCount);
}

std::vector<float> ssimMap(const Image &a, const Image &b) {
    constexpr double channelCount = 3.0;
    std::vector<double> sums(a.pixels().size(), 0.0);
    std::vector<float> map(sums.size(), std::numeric_limits<float>::quiet_NaN());
    forEachWindow(a, b, {}, [&](std::size_t pixel, double index) {
        sums[pixel] += index;
        map[pixel] = static_cast<float>(sums[pixel] / channelCount); // of the last channel, all three
    });
    return map;
}

} // namespace hyalite::core
