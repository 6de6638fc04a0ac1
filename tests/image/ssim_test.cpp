#include "host/image/ssim.h"

#include "tests/fixtures/synthetic_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyalite::core {
namespace {

/// The definition, window by window, with two-dimensional weights and central moments.
double plainSsim(const Image &a, const Image &b) {
    double weights[11][11];
    double weightSum = 0.0;
    for (int j = 0; j < 11; ++j) {
        for (int i = 0; i < 11; ++i) {
            weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2.0 * 1.5 * 1.5));
            weightSum += weights[j][i];
        }
    }
    double sum = 0.0;
    int count = 0;
    for (int channel = 0; channel < 3; ++channel) {
        for (int top = 0; top + 11 <= a.height(); ++top) {
            for (int left = 0; left + 11 <= a.width(); ++left) {
                const auto average = [&](auto term) {
                    double total = 0.0;
                    for (int j = 0; j < 11; ++j)
                        for (int i = 0; i < 11; ++i)
                            total += weights[j][i] / weightSum *
                                     term(static_cast<double>(a.at(left + i, top + j)[channel]),
                                          static_cast<double>(b.at(left + i, top + j)[channel]));
                    return total;
                };
                const double meanA = average([](double va, double) { return va; });
                const double meanB = average([](double, double vb) { return vb; });
                const double varianceA =
                    average([&](double va, double) { return (va - meanA) * (va - meanA); });
                const double varianceB =
                    average([&](double, double vb) { return (vb - meanB) * (vb - meanB); });
                const double covariance =
                    average([&](double va, double vb) { return (va - meanA) * (vb - meanB); });
                sum += (2.0 * meanA * meanB + 1e-4) * (2.0 * covariance + 9e-4) /
                       ((meanA * meanA + meanB * meanB + 1e-4) * (varianceA + varianceB + 9e-4));
                ++count;
            }
        }
    }
    return sum / count;
}

TEST(Ssim, EqualImagesHaveOne) {
    const Image a = displayPicture(40, 30, 1);
    EXPECT_NEAR(meanSsim(a, a).value(), 1.0, 1e-12);
}

TEST(Ssim, AgreesWithThePlainDefinition) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const Image a = displayPicture(29, 23, 0);
        const Image b = displayPicture(29, 23, seed);
        EXPECT_NEAR(meanSsim(a, b).value(), plainSsim(a, b), 1e-10) << seed;
        EXPECT_NEAR(meanSsim(b, a).value(), meanSsim(a, b).value(), 1e-12);
    }
}

TEST(Ssim, AgreesWithScikitImage) {
    // structural_similarity(a, b, data_range=1, channel_axis=2, gaussian_weights=True, sigma=1.5,
    // use_sample_covariance=False) of the same pictures in double.
    EXPECT_NEAR(meanSsim(displayPicture(64, 48, 0), displayPicture(64, 48, 2)).value(), 0.8162369321021649,
                1e-6);
}

TEST(Ssim, ClosedFormOfConstantImages) {
    const Image a = constantPicture(11, 11, glm::vec3(0.25f));
    const Image b = constantPicture(11, 11, glm::vec3(0.75f));
    EXPECT_NEAR(meanSsim(a, b).value(), (2.0 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-9);
    EXPECT_NEAR(
        meanSsim(constantPicture(20, 20, glm::vec3(0.0f)), constantPicture(20, 20, glm::vec3(1.0f))).value(),
        1e-4 / (1.0 + 1e-4), 1e-9);
}

TEST(Ssim, AnInvertedPictureIsNegative) {
    const Image a = displayPicture(40, 30, 1);
    Image b = a;
    for (glm::vec3 &pixel : b.pixels())
        pixel = glm::vec3(1.0f) - pixel;
    EXPECT_LT(meanSsim(a, b).value(), 0.0);
}

TEST(Ssim, IsAbsentWhereItHasNoWindow) {
    EXPECT_FALSE(meanSsim(displayPicture(10, 40, 0), displayPicture(10, 40, 1)).has_value());
    EXPECT_FALSE(meanSsim(displayPicture(40, 10, 0), displayPicture(40, 10, 1)).has_value());
    const Mask corner = [] {
        Mask mask(20 * 20, 0);
        mask[0] = 1; // a window with its centre there would leave the image
        return mask;
    }();
    EXPECT_FALSE(meanSsim(displayPicture(20, 20, 0), displayPicture(20, 20, 1), corner).has_value());
    Image broken = displayPicture(20, 20, 0);
    broken.at(7, 7).x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(meanSsim(broken, displayPicture(20, 20, 0)).has_value());
}

TEST(Ssim, PixelsOutsideTheMaskDoNotCount) {
    const Image a = displayPicture(40, 30, 0);
    Image b = a;
    Mask mask(40 * 30, 1);
    for (int x = 10; x < 15; ++x) {
        b.at(x, 12) = glm::vec3(1.0f);
        mask[static_cast<std::size_t>(12 * 40 + x)] = 0;
    }
    EXPECT_LT(meanSsim(a, b).value(), 0.999);
    EXPECT_NEAR(meanSsim(a, b, mask).value(), 1.0, 1e-12);
}

} // namespace
} // namespace hyalite::core
